#!/usr/bin/env bash
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 300 --seed 3 | treeconvert - -o tree.json
wrong_use treeprofile tree.json --frames 5 --repeat 1
bad_input tree.json treeprofile --frames 5
refused 1 "--frames" treeprofile tree.json --frames 2
refused 1 "compare" treeprofile compare a.json
refused 1 "nothing to read" treeprofile stages

# The report is that of treesim's run: the same hash; stages and "other" make the whole.
expect 0 treeprofile stages tree.json --wind gusty --frames 30 --report r.json
grep -q "^hash $(treesim tree.json --wind gusty --frames 30 --no-output --report hash 2>&1 | sed 's/hash //')$" out ||
    fail "the hash is not that of treesim"
python3 -c '
import json, math
r = json.load(open("r.json"))
for field in "tool version bodies frames threads simd precision hash total_ns_per_body_frame stages".split(): r[field]
assert r["tool"] == "treeprofile" and r["frames"] == 28
assert r["stages"][-1]["name"] == "other"
assert math.isclose(sum(s["share"] for s in r["stages"]), 1, rel_tol=1e-6)
assert math.isclose(sum(s["ns_per_body_frame"] for s in r["stages"]), r["total_ns_per_body_frame"], rel_tol=1e-6)
for s in r["stages"]:
    assert math.isclose(s["seconds"] * 1e9 / r["bodies"] / r["frames"], s["ns_per_body_frame"], rel_tol=1e-6)
    assert s["calls"] == r["frames"]' || fail "the report does not add up"
! treeprofile tree.json --frames 5 | grep -q wind_field || fail "a stage that did not run is in the table"
refused 1 "expected a name that ends in .json or .csv" treeprofile tree.json --frames 5 --report r.svg
expect 0 treeprofile tree.json --frames 5 --report r.csv
expect 0 treeprofile stages tree.json --frames 5 --repeat 1 --solver articulated-implicit
grep -q '^articulated ' out && ! grep -q '^spring ' out || fail "the articulated solver's stages are not in the table"
grep -q "^hash $(treesim tree.json --frames 5 --no-output --report hash --solver articulated-implicit 2>&1 | sed 's/hash //')$" out ||
    fail "the articulated solver's hash is not that of treesim"
expect 0 treeprofile stages tree.json --frames 5 --repeat 1 --solver coupled --scheme p34 --precision float --simd off --report p34.json
grep -q '^resolvent ' out && ! grep -q '^spring ' out || fail "the coupled solver's stages are not in the table"
grep -q ', coupled, P34, float$' out || fail "the scheme is not in the table"
grep -q "^hash $(treesim tree.json --frames 5 --no-output --report hash --solver coupled --scheme P34 --precision float --simd off 2>&1 | sed 's/hash //')$" out ||
    fail "the coupled solver's hash is not that of treesim"
expect 0 treeprofile stages tree.json --frames 5 --repeat 1 --solver coupled --precision float --report p12.json
refused 2 "/scheme" treeprofile compare p12.json p34.json
[[ $(head -n 1 r.csv) == name,calls,seconds,* ]] || fail "the CSV has no header"

# compare: a report against itself, against a slower one, against one of another kind.
expect 0 treeprofile compare r.json r.json
slower() { python3 -c 'import json, sys; r = json.load(open("r.json")); exec(sys.argv[1]); json.dump(r, open("n.json", "w"))' "$1"; }
slower 'r["total_ns_per_body_frame"] *= 1.2'
refused 3 "total" treeprofile compare r.json n.json
expect 0 treeprofile compare r.json n.json --fail-above 1.3
expect 0 treeprofile compare n.json r.json
slower 's = max(r["stages"], key=lambda s: s["share"]); s["ns_per_body_frame"] *= 1.5'
refused 3 "slower" treeprofile compare r.json n.json
slower 'r["bodies"] += 1'
refused 2 "/bodies" treeprofile compare r.json n.json
slower 'del r["stages"][0]["calls"]'
refused 2 "/stages/0/calls" treeprofile compare r.json n.json
echo '{"tool":' >n.json
refused 2 "n.json" treeprofile compare r.json n.json
absent
