#!/usr/bin/env bash
# treeprofile error and stability: what they write adds up, and wrong use is said.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 100 --seed 3 | treeconvert - -q -o small.json
refused 1 "--steps" treeprofile error small.json --wind gusty --steps 3
refused 1 "--steps" treeprofile error small.json --wind gusty --steps 1/0
refused 1 "--frames: is 3, expected at least 9" treeprofile error small.json --wind gusty --frames 3
refused 1 "--substeps" treeprofile error small.json --substeps 2
refused 1 "articulated-reference" treeprofile error small.json --solver articulated-reference
refused 1 "--set pose=drawn" treeprofile error small.json --set pose=drawn
refused 1 "--frames" treeprofile error small.json --frames 3
refused 1 ".html" treeprofile error small.json --report r.pdf
refused 2 "absent.json" treeprofile error absent.json
refused 2 "moves" treeprofile error small.json --gravity 0,0,0 --set pose=rest

expect 0 treeprofile error small.json --wind gusty --seconds 0.5 --steps 1,2,4 --report r.json
python3 -c '
import json, math
r = json.load(open("r.json"))
runs = r["runs"]
keys = """solver scheme steps_per_frame precision seconds_per_simulated_second error_rms error_max error_rms_peak
error_max_peak error_rms_height error_step error_model error_arithmetic""".split()
assert all(k in run for run in runs for k in keys)
assert 0 <= r["reference_error"] < 1e-3
series = [(x["solver"], x["scheme"], x["precision"]) for x in runs]
assert series[0] == ("coupled", "P12", "double")
assert ("articulated-implicit", "euler", "double") in series
for solver, scheme in ("coupled", "P12"), ("analytic", "inertia-branch"), ("analytic", "inertia-paper"):
    assert (solver, scheme, "double") in series and (solver, scheme, "float") in series
assert {s for solver, s, _ in series if solver == "coupled"} == {"P12", "P34", "P.5", "LIE"}
one = {(x["scheme"], x["precision"]): x["error_rms"] for x in runs if x["solver"] == "coupled" and x["steps_per_frame"] == 1}
assert 3 * one["P12", "double"] < one["LIE", "double"], one
implicit = [x["error_rms"] for x in runs if x["solver"] == "articulated-implicit"]
assert implicit[0] > 1.3 * implicit[1] > 1.69 * implicit[2], implicit
assert all(x["error_rms"] is None for x in runs if x["solver"] == "articulated-explicit")
assert all((x["error_arithmetic"] is not None) == (x["precision"] == "float") for x in runs)' || fail "the report does not add up"
expect 0 treeprofile error small.json --seconds 0.5 --steps 1 --solver analytic --precision float
grep -q "float" out && ! grep -q "double" out || fail "--precision float shows other runs"
grep -q "gravity is switched on" err || fail "what moves a tree without wind is not said"
series() { treeprofile error small.json --wind gusty --seconds 0.3 --steps 1 "$@" | grep -oE '^[a-z-]+, .*(double|float)$' | awk '!seen[$0]++'; }
[[ $(series --scheme p.25) == $'coupled, P.25, double\ncoupled, P.25, float' ]] || fail "--scheme gave $(series --scheme P.25)"
[[ $(series --scheme P12 --precision double) == "coupled, P12, double" ]] || fail "--precision is passed over with --scheme"
[[ $(series --joint-inertia paper --precision double) == "analytic, inertia-paper, double" ]] ||
    fail "--joint-inertia gave $(series --joint-inertia paper --precision double)"
[[ $(series --solver coupled | grep -c .) -eq 5 ]] || fail "--solver coupled gave $(series --solver coupled)"
refused 1 "--scheme" treeprofile error small.json --wind gusty --solver analytic --scheme P12

# With leaves: statistics beside the truth's, and another truth, which agrees.
treegen --age 12 --bodies 150 --leaves --seed 3 | treeconvert - -q -o leaf.json
refused 1 "--tolerance" treeprofile error leaf.json --wind breeze --truth fine --tolerance 1e-6
refused 1 "--truth" treeprofile error leaf.json --wind breeze --truth finest
for truth in reference fine; do
    expect 0 treeprofile error leaf.json --wind breeze --seconds 1 --steps 1,16 --scheme P12 --precision double --truth $truth --report $truth.json
done
python3 -c '
import json
a, b = (json.load(open(t + ".json")) for t in ("reference", "fine"))
assert a["truth"] == "articulated-reference" and b["truth"] == "coupled, 64 steps a frame"
for key in "top_lean top_std top_peak level0_std level1_std leaf_flap_std leaf_sway_std leaf_twist_std leaf_turn".split():
    for other in b["truth_" + key], a["runs"][1][key]:
        assert abs(other / a["truth_" + key] - 1) < 0.03, (key, other, a["truth_" + key])
run = b["runs"][1]
assert 0 < run["error_level0_rms"] <= run["error_level0_max"] and run["error_wood_rms_peak"] < run["error_wood_rms"] < 0.2
assert sum(a["truth_leaf_spectrum%d" % k] for k in range(15)) > 0 and 0 < run["error_spectrum"] < 0.3' || fail "the statistics do not add up"

expect 0 treeprofile stability small.json --frames 12 --only shape --report s.json
python3 -c '
import json
r = json.load(open("s.json"))
keys = "case solver precision finite bounded energy_drift ringing max_angle guards promised".split()
assert r["cells"] and all(k in c for c in r["cells"] for k in keys)
assert all(c["finite"] and c["bounded"] for c in r["cells"] if c["promised"])
assert {(c["solver"], c["precision"]) for c in r["cells"] if c["promised"]} == {
    (s, p) for s in ("coupled", "analytic") for p in ("float", "double")}' || fail "the grid does not add up"
expect 0 treeprofile stability small.json --frames 12 --only "wind and stiffness"
# In wind coupled is held against 64 steps a frame.
treeprofile stability small.json --frames 30 --only "gusty" --report w.json >out
python3 -c '
import json
cells = {(c["solver"], c["precision"]): c for c in json.load(open("w.json"))["cells"]}
for precision in "double", "float":
    c = cells["coupled", precision]
    assert c["compared"] and c["moves"] and abs(c["lean_error"]) < 0.05 and abs(c["std_error"]) < 0.05 and c["still_frames"] == 0, c
c = cells["analytic", "double"]
assert not c["compared"] and c["moves"] and c["lean_error"] is None' || fail "the cells of wind are not compared"
refused 1 "--only" treeprofile stability small.json --only nothing-like-it
refused 1 "--frames" treeprofile stability small.json --frames 2
refused 2 "absent.json" treeprofile stability absent.json
