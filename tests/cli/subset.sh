#!/usr/bin/env bash
# Parts of a tree: a scene's /simulate, a tree's /rigid, treeconvert --merge-below: what is written, what it costs, what is refused.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --species apple --age 12 --bodies 600 --seed 3 --leaves -q >apple.splines
treeconvert apple.splines -q -o apple.json
scene() { printf '{"format": "bough-scene", "version": 1, "trees": [{"file": "apple.json"}], "wind": "gusty", %s}' "$1" >"${2:-part.json}"; }
hash() { treesim "$@" --no-output --report hash 2>&1 | grep '^hash '; }

# One hash for any number of threads and for a run cut in two, with output and without.
scene '"simulate": {"last_level": 1}'
for run in "coupled" "analytic" "coupled --precision float" "coupled --simd off"; do
    read -ra by <<<"--solver $run"
    one=$(hash part.json "${by[@]}" --threads 1 --frames 30)
    [[ $(hash part.json "${by[@]}" --threads 3 --frames 30) == "$one" ]] || fail "3 threads give another hash with $run"
    hash part.json "${by[@]}" --frames 13 --save-state half.json >/dev/null
    [[ $(hash part.json "${by[@]}" --frames 17 --resume half.json) == "$one" ]] || fail "a run cut in two: another hash with $run"
done
one=$(hash part.json --frames 30)
for kind in jsonl safetensors glb; do
    [[ $(treesim part.json --frames 30 --report hash -o "motion.$kind" 2>&1 | grep '^hash ') == "$one" ]] || fail "output changes the hash: $kind"
done
# What holds no joint changes nothing.
scene '"simulate": {"last_level": 99}' all.json
scene '"air_density": 1.2' none.json
[[ $(hash all.json --frames 20) == $(hash none.json --frames 20) ]] || fail "holding no joint changes the hash"
[[ $one != $(hash none.json --frames 30) ]] || fail "holding joints changes nothing"

# Frames hold all bodies: those held stand on their parents as drawn, and the joints that move are at the branches named.
treesim part.json --frames 12 --fields pose,velocity,torque,angles -q -o motion.jsonl
python3 - <<'END' || fail "the motion's held bodies are wrong"
import json
tree = json.load(open("apple.json"))
lines = [json.loads(line) for line in open("motion.jsonl")]
n = len(tree["mass"])
assert lines[0]["bodies"] == n
def turn(q, v):
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]
moved = 0
for f in lines[1:]:
    assert len(f["position"]) == 3 * n and len(f["velocity"]) == 3 * n and len(f["torque"]) == 3 * n
    for i, p in enumerate(tree["parent"]):
        held = tree["level"][i] > 1
        theta = f["theta"][3 * i:3 * i + 3]
        if held:
            assert theta == [0, 0, 0] and f["torque"][3 * i:3 * i + 3] == [0, 0, 0]
        if p < 0:
            continue
        d = turn(f["rotation"][4 * p:4 * p + 4], tree["joint_position"][3 * i:3 * i + 3])
        off = max(abs(f["position"][3 * p + k] + d[k] - f["position"][3 * i + k]) for k in range(3))
        assert off < 1e-12, (i, off)
        moved = max(moved, max(map(abs, theta)))
assert moved > 1e-3
END

# --report plan counts; --report rigid reports; fewer joints are fewer bodies of the plan.
treesim part.json --no-output --frames 20 --report plan --report rigid --report cost 2>plan
grep -q '^tree changed by /simulate: [0-9]* of [0-9]* joints move; held: [0-9]* by /simulate/first_level, last_level$' plan || fail "not explained: $(head -3 plan)"
left=$(sed -n 's/^tree changed by \/simulate: \([0-9]*\) of.*/\1/p' plan)
grep -q "^plan: $left bodies" plan || fail "the plan has other bodies than the $left that move: $(head -1 plan)"
grep -q "^cost $left bodies" plan || fail "cost: $(grep ^cost plan)"
grep -Eq "^rigid $left of [0-9]+ joints move; tips off by [0-9.e-]+ m RMS, [0-9.e-]+ m at most \([0-9.e-]+ and [0-9.e-]+ % of the height\)" plan || fail "no report: $(grep ^rigid plan)"
for by in '"radius": 0.02' '"subtrees": [{"branch": 1, "at": 0}]' '"box": {"least": [-9, 0, -9], "most": [0, 9, 9]}' '"error": 0.05' \
    '"error": 5, "view": {"from": [0, 2, 30]}'; do
    scene "\"simulate\": {$by}"
    treesim part.json --no-output --frames 5 --report plan 2>plan
    grep -Eq '^tree changed by /simulate: [0-9]+ of [0-9]+ joints move; held: ' plan || fail "$by holds nothing: $(head -2 plan)"
done
scene '"simulate": {"radius": 0.02}, "pulls": [{"on": {"level": 1}, "time": [0, 1], "force": [[0, 0, 1], [0, 0, 2]]}]'
treesim part.json --no-output --frames 5

# treeprofile runs them too.
treeprofile part.json --frames 6 --repeat 2 -q >profile
treesim part.json --no-output --frames 2 --report plan 2>plan
left=$(sed -n 's/^tree changed by \/simulate: \([0-9]*\) of.*/\1/p' plan)
grep -q "^bodies $left," profile || fail "treeprofile has not the $left bodies that move: $(grep ^bodies profile)"

# Merged by a trial run: less than the error, fewer joints for more of it, the same again; a second run sees the same error.
before=99999
for error in 0.002 0.02 0.2; do
    treeconvert apple.splines --merge-below $error --seconds 3 --stats -q -o merged.json 2>stats
    line=$(grep '^rigid ' stats) || fail "--stats says nothing of the merging"
    left=$(sed -n 's/.* joints, \([0-9]*\) left to move.*/\1/p' <<<"$line")
    [[ $left -le $before ]] || fail "more joints are left for a larger error: $line"
    before=$left
done
found=$(sed -n 's/.*tips off by \([0-9.e-]*\) m at most.*/\1/p' <<<"$line")
treeconvert apple.splines --merge-below 0.2 --seconds 3 --threads 1 -q -o again.json
sed 's/"source":.*//' merged.json >a
sed 's/"source":.*//' again.json >b
same a b
treesim merged.json --wind gusty --seconds 3 --no-output --report rigid 2>report
python3 - "$found" "$left" <<'END' || fail "the trial's error is not the run's: $found, $(cat report)"
import json, re, sys
line = open("report").read()
moving, worst = re.search(r"rigid (\d+) of .*RMS, ([0-9.e-]+) m at most", line).groups()
assert moving == sys.argv[2] == str(json.load(open("merged.json"))["rigid"].count(0))
assert float(worst) <= 0.2 and abs(float(worst) / float(sys.argv[1]) - 1) < 0.02, (worst, sys.argv[1])
END
treeconvert apple.splines --merge-below 0.2 --seconds 1 --wind storm -q -o merged.safetensors
[[ $(hash merged.safetensors --frames 10) == "hash "* ]] || fail "a merged tree in binary does not run"
treeconvert apple.splines -q -o plain.json
if grep -q '"rigid"' plain.json; then fail "a tree that is not merged has rigid"; fi
mkdir frames
treesim merged.json --wind gusty --frames 3 -q -o frames/a_%04d.obj
[[ $(grep -c '^v ' frames/a_0000.obj) -eq $(grep -c '^v ' frames/a_0002.obj) ]] || fail "the mesh changes"

# Refused, and why.
refused 1 "--merge-below" treeconvert apple.splines --wind gusty -o x.json
refused 1 "--merge-below" treeconvert apple.splines --seconds 3 -o x.json
refused 1 "--merge-below" treeconvert apple.splines --merge-below 0 -o x.json
refused 1 "--wind" treeconvert apple.splines --merge-below 0.1 --wind gale -o x.json
refused 1 "--seconds" treeconvert apple.splines --merge-below 0.1 --seconds 0.001 -o x.json
absent x.json
scene '"simulate": {"last_level": 1}, "balls": [{"position": [0, 3, 0], "radius": 0.1, "mass": 1}]'
refused 2 "/simulate" treesim part.json --frames 2
printf '{"format": "bough-scene", "version": 1, "trees": [{"file": "merged.json"}], "fracture": {"leaf": 1e-4}}' >bad.json
refused 2 "/fracture" treesim bad.json --frames 2
scene '"simulate": {"subtrees": [{"body": 99999}]}'
refused 2 "99999" treesim part.json --frames 2
scene '"simulate": {"first_level": 50}'
refused 2 "nothing is left that moves" treesim part.json --frames 2
printf '{"format": "bough-scene", "version": 1, "trees": [{"file": "apple.json"}], "simulate": {"error": 0.01}}' >bad.json
refused 2 "/simulate/error" treesim bad.json --frames 2
refused 1 "--report rigid" treesim apple.json --wind gusty --frames 2 --no-output --report rigid
scene '"simulate": {"last_level": 1}'
hash part.json --frames 3 --save-state half.json >/dev/null
refused 1 "--report rigid" treesim part.json --frames 2 --no-output --report rigid --resume half.json
scene '"simulate": {"last_level": 0}' other.json
refused 2 "theta" treesim other.json --frames 2 --no-output --resume half.json
