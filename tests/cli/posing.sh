#!/usr/bin/env bash
# What a scene makes of its trees, and a pose made the tree's own.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 150 --seed 3 | treeconvert - -q -o tree.json
hash() { treesim "$@" --no-output -q --report hash 2>&1 | grep '^hash [0-9a-f]\{16\}$'; }
scene() { # NAME FIELDS
    echo "{\"format\": \"bough-scene\", \"version\": 1, \"trees\": [{\"file\": \"tree.json\"}]${2:+, $2}}" >"$1.json"
}

# The scene of figure 12 as it is; what it changed is said, and counted by python from the documents alone.
expect 0 treesim "$top/data/scenes/splines.json" --frames 20 --no-output --report hash --report plan
grep -q '^tree changed by /wood: stiffness of 285 joints, damping of 285, mass of 0 bodies; [0-9]* joints near [0-9]* forks$' err ||
    fail "what the curves changed is not said: $(grep changed err)"
one=$(grep '^hash' err)
[[ $one == $(hash "$top/data/scenes/splines.json" --frames 20 --threads 1) ]] || fail "threads change the scene of splines"
sed 's/"wood".*/"gravity": [0, -9.81, 0]}/; /"damping"/d; /"stiffness"/d; /"radius"/d; /{"on"/d; /"fork"/d' \
    "$top/data/scenes/splines.json" | sed "s#trees/#$top/data/scenes/trees/#" >plain.json
[[ $one != $(hash plain.json --frames 20) ]] || fail "the curves change nothing"

# Factors on every kind are the scale of all.
scene wind '"wind": "gusty"'
two='{"stiffness": 2, "damping": 0.5}'
scene doubled "\"wind\": \"gusty\", \"wood\": {\"branch\": $two, \"leaf\": $two, \"petal\": $two, \"fruit\": $two}"
[[ $(hash doubled.json --frames 20) == $(hash wind.json --frames 20 --set stiffness_scale=2 --set damping_scale=0.5) ]] ||
    fail "factors of 2 and 1/2 are not those scales"
scene none '"wind": "gusty", "wood": {}, "load": {}'
[[ $(hash none.json --frames 20) == $(hash wind.json --frames 20) ]] || fail "an empty wood and load change the motion"
expect 0 treesim none.json --frames 1 --no-output --report plan
grep -q '^tree changed by /wood: stiffness of 0 joints, damping of 0, mass of 0 bodies$' err || fail "no line for an empty wood"
grep -q '^tree changed by /load: 0 kg on 0 bodies$' err || fail "no line for an empty load"
expect 0 treesim wind.json --frames 1 --no-output --report plan
! grep -q '^tree changed' err || fail "a scene without wood changes its tree"
scene wrong '"wood": {"curves": [{"on": {"body": 100000}, "radius": [0], "stiffness": [1]}]}'
refused 2 "/wood/curves/0/on: body 100000, but tree 0 has" treesim wrong.json
scene wrong '"wood": {"fork": {"factor": 2}}'
refused 2 "/wood/fork/length: is missing" treesim wrong.json

# Snow: a state goes on with the same snow only.
scene snow '"load": {"branch": 4}'
expect 0 treesim snow.json --frames 4 --no-output --report plan --save-state snow.state
grep -q '^tree changed by /load: [0-9.]* kg on [0-9]* bodies$' err || fail "what lies on the tree is not said"
[[ $(hash snow.json --frames 3 --resume snow.state) == $(hash snow.json --frames 7) ]] || fail "snow does not go on as it was"
scene more '"load": {"branch": 4.5}'
refused 2 "/fingerprint" treesim more.json --frames 3 --resume snow.state
expect 0 treeprofile stages snow.json --frames 3

# A pose reached under a pull, made rest: the tree of the document stays there for 5 s, in either form, for either solver.
scene pulled '"load": {"branch": 1}, "pulls": [{"on": {"level": 1}, "time": [0, 60], "force": [[0.4, -0.2, 0.3], [0.4, -0.2, 0.3]]}]'
for solver in coupled analytic; do
    for form in json safetensors; do
        treesim pulled.json --solver $solver --frames 40 -q -o reached.json --save-tree posed.$form
        treesim posed.$form --solver $solver --seconds 5 -q -o after.json
        treesim tree.json --frames 1 -q -o before.json
        python3 - <<'END' || fail "the pose reached with $solver does not stay ($form)"
import json
reached, after, before = (json.load(open(n + ".json"))["frames"] for n in ("reached", "after", "before"))
last = reached[-1]
def off(a, b, what):
    return max(abs(x - y) for x, y in zip(a[what], b[what], strict=True))
assert off(before[0], last, "position") > 0.01, "nothing was bent"
for frame in after:
    assert off(frame, last, "position") < 1e-9, (frame["frame"], off(frame, last, "position"))
    assert min(off(frame, last, "rotation"), 1) < 1e-9, (frame["frame"], off(frame, last, "rotation"))
END
    done
done
python3 - <<'END' || fail "the posed tree's document is not the tree's"
import json
a, b = (json.load(open(n)) for n in ("tree.json", "posed.json"))
for field in ("parent", "kind", "com", "joint_position", "stiffness", "damping", "size", "branch", "level", "s"):
    assert a[field] == b[field], field
assert sum(b["mass"]) > sum(a["mass"]), "the load is not in the mass"
assert b["source"].startswith(a["source"]) and "--save-tree" in b["source"], b["source"]
END
[[ $(hash wind.json --frames 9 --save-tree x.json) == $(hash wind.json --frames 9) ]] || fail "--save-tree changes the motion"
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}, {"file": "tree.json", "position": [9, 0, 0]}]}' >both.json
refused 1 "--save-tree: the scene has 2 trees" treesim both.json --frames 2 --no-output --save-tree x2.json
refused 1 "--save-tree -" treesim tree.json --frames 2 --save-tree -
refused 1 "--save-tree -" treesim tree.json --frames 2 --no-output --save-tree - --save-state -
refused 4 "No such file" treesim tree.json --frames 2 --no-output --save-tree missing/x2.json
scene broken '"wind": "storm", "fracture": {"branch": 1e-6}'
refused 4 "joints broke in this run, expected a whole tree" treesim broken.json --frames 9 --no-output --save-tree x2.json
absent x2.json
treesim tree.json --frames 2 --no-output -q --save-tree - | treesim - --frames 1 --no-output || fail "a tree from stdout does not run"

# Lagged terms: of the analytic solver; another motion, one however cut.
scene lagged '"wind": "gusty", "fictitious": {"acceleration": 0.05, "turning": 0.05, "gyroscopic": 0.05}'
refused 2 "fictitious: only for solver analytic; solver coupled has these terms by nature" treesim lagged.json
run=(lagged.json --solver analytic)
one=$(hash "${run[@]}" --frames 12)
[[ -n $one && $one != $(hash wind.json --solver analytic --frames 12) ]] || fail "the lagged terms change nothing"
[[ $one == $(hash "${run[@]}" --frames 12 --threads 1) ]] || fail "threads change the lagged terms"
for form in json safetensors; do
    treesim "${run[@]}" --frames 5 -q --no-output --save-state lagged.state.$form
    [[ $(hash "${run[@]}" --frames 7 --resume lagged.state.$form) == "$one" ]] || fail "lagged terms do not go on from $form"
done
python3 -c 'import json; d = json.load(open("lagged.state.json")); del d["spin_dot"]; json.dump(d, open("cut.json", "w"))'
refused 2 "/spin_dot: is 0 bodies, but this run has" treesim "${run[@]}" --frames 5 --resume cut.json
expect 0 treesim "${run[@]}" --frames 3 --no-output --report plan
grep -q '^stage lanes left out: plain path: /fictitious$' err || fail "why it runs on the plain path is not said"
grep -q '^calls fictitious 2$' err || fail "the terms were not worked out in each step"
expect 0 treeprofile error "${run[@]}" --steps 1,2,4 --frames 5 --precision double --joint-inertia paper
