#!/usr/bin/env bash
# treesim with a scene: its trees, and their roots moved.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# A tree that cannot be read is named with its scene; a message stays short whatever a file names.
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "gone.json", "position": [1, 0, 0]}]}' >gone_scene.json
refused 2 "gone_scene.json: /trees: gone.json: cannot be opened: No such file" treesim gone_scene.json --frames 2
printf '{"format": "bough-scene", "version": 1, "trees": [{"file": "%s"}]}' "$(head -c 100000 /dev/zero | tr '\0' x)" >long_scene.json
refused 2 " ... " treesim long_scene.json --frames 2
[[ $(wc -c <err) -lt 7000 ]] || fail "a message of $(wc -c <err) bytes"

treegen --age 12 --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json

# A scene beside its tree, run from elsewhere.
mkdir -p place/trees
cp tree.json place/trees/oak.json
cat >place/scene.json <<'END'
{"format": "bough-scene", "version": 1,
 "trees": [{"file": "trees/oak.json"}, {"file": "trees/oak.json", "position": [5, 0, 0], "yaw": 90}]}
END
[[ $(treesim place/scene.json --frames 2 | head -n 1 | python3 -c 'import json, sys; print(json.loads(sys.stdin.readline())["bodies"])') \
    -eq $((2 * $(treesim tree.json --frames 1 | python3 -c 'import json, sys; print(json.loads(sys.stdin.readline())["bodies"])'))) ]] ||
    fail "two trees are not twice one"
sed 's,trees/oak,trees/elm,' place/scene.json >place/lost.json
refused 2 "trees/elm.json" treesim place/lost.json
# Small files that ask for more bodies than there are numbers are refused before the trees stand.
treegen --bodies 100000 --seed 1 -q | treeconvert - -q -o place/trees/large.safetensors
python3 -c 'import json; print(json.dumps({"format": "bough-scene", "version": 1, "trees": [{"file": "trees/large.safetensors"}] * 30000}))' >place/forest.json
refused 2 "bodies, expected at most 2147483647" treesim place/forest.json --frames 2 --no-output
sed 's,trees/oak,trees/oak.json\\u0000,' place/scene.json >place/nul.json
refused 2 "place/nul.json: /trees: names a file by a text with a NUL in it" treesim place/nul.json --frames 2 --no-output
sed 's,"trees",/"trees",' place/scene.json >place/broken.json
refused 2 "place/broken.json" treesim place/broken.json

# A scene that moves its tree's root: it starts at the first key, ends at the last, and goes on from a saved state.
cat >place/moved.json <<'END'
{"format": "bough-scene", "version": 1, "trees": [{"file": "trees/oak.json", "position": [2, 0, 1]}],
 "root_motion": [{"time": [0, 0.5, 1], "position": [[0.1, 0.2, 0.3], [0.5, 0, 0], [-1, 0, 2]],
                  "rotation": [[0, 0, 0, 1], [0, 0.6, 0, 0.8], [0, 1, 0, 0]]}]}
END
treesim place/moved.json --seconds 1.2 | python3 -c '
import json, sys
head, *frames = [json.loads(line) for line in sys.stdin]
place = [f["position"][:3] for f in frames]
near = lambda a, b: max(abs(x - y) for x, y in zip(a, b)) < 1e-12
assert near(place[0], [2.1, 0.2, 1.3]), place[0]
assert near(place[15], [2.5, 0, 1]), place[15]
assert near(place[30], [1, 0, 3]) and near(place[36], [1, 0, 3]), place[30]' || fail "the root does not follow its keys"
for solver in analytic coupled; do
    run=(place/moved.json --solver $solver --wind breeze)
    one=$(hash "${run[@]}" --frames 40)
    [[ $(hash "${run[@]}" --frames 40 --threads 1) == "$one" ]] || fail "threads change the hash of a moved root, $solver"
    treesim "${run[@]}" --frames 18 --no-output --save-state moved.state
    [[ $(hash "${run[@]}" --frames 22 --resume moved.state) == "$one" ]] ||
        fail "a moved root does not go on as it was, $solver"
done
expect 0 treesim place/moved.json --frames 20 -q --wind breeze -o moved.glb
treesim place/moved.json --solver analytic --frames 2 --no-output --report plan 2>&1 |
    grep -q '^stage root_motion on: /root_motion$' || fail "--report plan says nothing of root motion"
treesim place/moved.json --solver coupled --frames 2 --no-output --report plan 2>&1 |
    grep -q '^stage lanes on: SIMD [a-z0-9]*; roots moved by /root_motion; no sleep: /root_motion$' || fail "--report plan says nothing of root motion"
treesim place/moved.json --solver coupled --simd off --frames 2 --no-output --report plan 2>&1 |
    grep -q '^stage midpoint on: every scene; roots moved by /root_motion$' || fail "--report plan says nothing of root motion"
broken() { # sed script, pointer
    sed "$1" place/moved.json >place/broken.json
    ! cmp -s place/broken.json place/moved.json || fail "$1 changes nothing"
    refused 2 "place/broken.json: $2" treesim place/broken.json --frames 2
}
broken 's/0.5, 1\], "pos/0.5, 0.5], "pos/' /root_motion/0/time/2
broken 's/, \[-1, 0, 2\]//' /root_motion/0/position
broken 's/0.6, 0, 0.8/0.6, 0, 0.9/' /root_motion/0/rotation/1
broken 's/\[0, 1, 0, 0\]/[0, 1, 0]/' /root_motion/0/rotation/2
broken 's/{"time"/{"tree": 1, "time"/' /root_motion/0/tree
broken 's/"rotation"/"turn"/' /root_motion/0/turn
