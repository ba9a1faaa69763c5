#!/usr/bin/env bash
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

small=(--bodies 200,400 --threads 1,2 --frames 3 --repeat 2 --array 4)

if grep -qs '^BOUGH_COUNTING:BOOL=OFF' "$build/CMakeCache.txt"; then
    refused 1 "make it with -DBOUGH_COUNTING=ON" treeprofile scaling "${small[@]}"
    echo "skipped: this build cannot count what a step computes"
    exit 77
fi

# What is wrong is said in one line, before the work.
refused 1 "--bodies" treeprofile scaling --bodies 0
refused 1 "--bodies" treeprofile scaling --bodies 200,1.5
refused 1 "--bodies" treeprofile scaling --bodies many
refused 1 "--bodies" treeprofile scaling --bodies 3e9
refused 1 "--threads" treeprofile scaling --threads 0
refused 1 "--threads" treeprofile scaling --threads 1,two
refused 1 "--precision" treeprofile scaling --precision half
refused 1 "--solver" treeprofile scaling --solver coupled,magic
refused 1 "--precision float" treeprofile scaling --solver articulated-implicit
refused 1 "--simd" treeprofile scaling --simd counted
refused 1 "--shape" treeprofile scaling --shape bushy,bonsai
refused 1 "--wind" treeprofile scaling --wind sideways
refused 1 "--frames" treeprofile scaling --frames 0
refused 1 "--repeat" treeprofile scaling --repeat 0
refused 1 "--array" treeprofile scaling --array none
refused 1 ".html" treeprofile scaling --report r.txt
refused 1 "same file" treeprofile scaling --report r.json -o r.json
refused 1 "one argument too many" treeprofile scaling tree.json
refused 1 "--no-such-option" treeprofile scaling --no-such-option
refused 1 "--bodies" treeprofile scaling --bodies 200 --tree tree.json
refused 2 "missing.json" treeprofile scaling "${small[@]:2}" --tree missing.json
refused 4 "No such file" treeprofile scaling --bodies 200 --frames 1 --repeat 1 --array 1 -o missing/folder/x
absent r.txt r.json
expect 0 treeprofile scaling --help
grep -q -- '--shape' out || fail "the help does not know --shape"

# Both grown shapes and a chain, every form; the hash is treesim's.
expect 0 treeprofile scaling "${small[@]}" --shape bushy,willow,chain --wind gusty --report r.json --no-source
expect 0 treeprofile scaling "${small[@]}" --report r.csv
[[ $(head -n 1 r.csv) == shape,bodies,solver,* && $(wc -l <r.csv) -eq 9 ]] || fail "the CSV: $(cat r.csv)"
if command -v gnuplot >/dev/null; then
    expect 0 treeprofile scaling "${small[@]}" --report r.svg
    grep -q '<svg' r.svg || fail "the picture is none"
    expect 0 treeprofile scaling "${small[@]}" --report r.html
    grep -q '</html>' r.html || fail "the page is none"
fi
hash_of() { treesim "$@" --frames 5 --no-output --report hash 2>&1 | sed -n 's/^hash //p'; }
for size in 200 400; do
    treegen --species willow --bodies $size --seed 1 | treeconvert - -o willow_$size.json
done
python3 - "$(hash_of willow_400.json --wind gusty --precision float)" "$(hash_of willow_200.json --wind gusty)" <<'END' || fail "the report does not add up"
import json, math, sys
r = json.load(open("r.json"))
assert r["format"] == "bough-scaling-report" and r["wind"] == "gusty" and r["repeat"] == 2 and "source" not in r
assert [(l["threads"]) for l in r["limits"]] == [1, 2]
for l in r["limits"]:
    assert min(l[k] for k in ("read", "write", "copy", "peak_float", "peak_double")) > 0
runs = r["runs"]
assert len(runs) == 3 * 2 * 2 * 2
for run in runs:
    near = [n for n in (200, 400) if abs(run["bodies"] - n) <= 0.1 * n]
    assert near and run["frames"] == 3 and run["solver"] == "coupled" and run["scheme"] == "P12"
    assert run["ns_least"] <= run["ns_per_body_frame"] <= run["ns_most"]
    assert run["shape"] != "chain" or run["bodies"] in (200, 400)
    same = [o["hash"] for o in runs if all(o[k] == run[k] for k in ("shape", "bodies", "precision"))]
    assert len(same) == 2 and len(set(same)) == 1 # both numbers of threads
def run_of(size, precision):
    return [o for o in runs if o["shape"] == "willow" and o["precision"] == precision and abs(o["bodies"] - size) < 50][0]
assert run_of(400, "float")["hash"] == sys.argv[1]
assert run_of(200, "double")["hash"] == sys.argv[2]
assert len(r["costs"]) == 3 * 2 * 2
for c in r["costs"]:
    assert c["slots"] >= 1 and c["multiplications"] > c["divisions"] > 0 and c["additions"] > 0
    assert math.isclose(c["operations"], sum(c[k] for k in ("additions", "multiplications", "divisions", "roots")))
    assert math.isclose(c["constants_in"], c["slots"] * 28 * (4 if c["precision"] == "float" else 8))
    assert c["shape"] != "chain" or math.isclose(c["slots"], 16 if c["precision"] == "float" else 8) # one lane is used
for run in runs:
    cost = [c for c in r["costs"] if all(c[k] == run[k] for k in ("shape", "bodies", "precision"))][0]
    limit = [l for l in r["limits"] if l["threads"] == run["threads"]][0]
    memory = cost["bytes"] / max(limit["read"], limit["write"], limit["copy"])
    if cost["tables"] <= r["core_cache"] * run["threads"]: memory = 0
    arithmetic = cost["operations"] / limit["peak_" + run["precision"]]
    assert math.isclose(run["limit_ns"], 1e9 * max(memory, arithmetic), rel_tol=1e-9)
    assert math.isclose(run["over_limit"], run["ns_per_body_frame"] / run["limit_ns"], rel_tol=1e-9)
END

# One's own trees, other ways of stepping; what is not counted is said to be unknown.
expect 0 treeprofile scaling "${small[@]:2}" --tree willow_200.json --tree willow_400.json --solver coupled,analytic --simd off --precision double --report own.json
python3 -c '
import json
r = json.load(open("own.json"))
assert {run["shape"] for run in r["runs"]} == {"willow_200.json", "willow_400.json"}
assert {run["solver"] for run in r["runs"]} == {"coupled", "analytic"} and {run["simd"] for run in r["runs"]} == {"none"}
assert all(run["limit_ns"] is None and run["over_limit"] is None for run in r["runs"])
assert all(c["operations"] is None and c["bytes"] is None for c in r["costs"])
assert r["source"].count("treegen --species willow") == 2' || fail "trees of one's own"
expect 0 treeprofile scaling "${small[@]}" --solver analytic --simd off
expect 0 treeprofile scaling "${small[@]}" --simd baseline,off --precision float
