#!/usr/bin/env bash
# --set: a field of the scene replaced gives the run of the scene that says so itself, and comes after all other options.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 120 --seed 3 --leaves | treeconvert - -o tree.json
hash() { treesim "$@" --frames 8 --no-output --report hash 2>&1 | grep '^hash [0-9a-f]\{16\}$'; }
scene() { echo "{\"format\": \"bough-scene\", \"version\": 1, \"trees\": [{\"file\": \"tree.json\"}], $1}" >"$2"; }

scene '"wind": "gusty"' gusty.json
scene '"wind": {"velocity": [3, 0, 4], "turbulence": 0.2, "gust_factor": 1.7, "gust_period": 6}, "pose": "settled"' turned.json
one=$(hash turned.json)
[[ -n $one && $(hash gusty.json) != "$one" ]] || fail "two scenes have one motion"
[[ $(hash gusty.json --set 'wind.velocity=[3,0,4]' --set pose=settled) == "$one" ]] || fail "--set is not the scene that says so"
[[ $(hash tree.json --wind gusty --set 'wind.velocity=[3,0,4]' --set pose=settled) == "$one" ]] || fail "... on a tree and --wind"
[[ $(hash gusty.json --wind storm --set pose=rest --seed 7 --set wind=gusty --set 'wind.velocity=[3,0,4]' --set pose=settled) == "$one" ]] ||
    fail "--set does not come last"
[[ $(hash gusty.json --gravity 0,0,0 --set 'gravity=[0,-9.81,0]') == $(hash gusty.json) ]] || fail "--set comes before --gravity"
[[ $(hash gusty.json --seed 7 --set wind.seed=1) == $(hash gusty.json) ]] || fail "--set comes before --seed"
[[ $(hash gusty.json --seed 7 --set wind.gust_period=6) == $(hash gusty.json --seed 7) ]] || fail "--set takes --seed back"
# An entry of /trees that stands in many places stays one entry.
park() { echo "{\"format\": \"bough-scene\", \"version\": 1, \"trees\": [{\"file\": \"tree.json\", \"places\": [{}, {\"position\": [5, 0, 0]}]}, {\"file\": \"tree.json\", \"position\": [9, 0, 0]$1}], \"wind\": \"gusty\"}" >park.json; }
park ', "yaw": 30'
one=$(hash park.json --seed 5)
park ''
[[ -n $one && $(hash park.json --seed 5 --set trees.1.yaw=30 --set wind.gust_period=6) == "$one" ]] || fail "--set of an entry of many places"
treeprofile gusty.json --frames 4 --repeat 1 --set wind=calm --report a.json -q >/dev/null
treeprofile tree.json --frames 4 --repeat 1 --wind calm --report b.json -q >/dev/null
[[ $(grep -o '"hash": *"[^"]*"' a.json) == $(grep -o '"hash": *"[^"]*"' b.json) ]] || fail "treeprofile --set is another run"

# The material is that of the trees: as if they had been cut with it (to rounding), and named as the reason where it cannot be.
cat >stiff.json <<'END'
{"format": "bough-material", "version": 1, "like": "apple", "youngs_modulus": 2e10, "shear_modulus": 1.3333333333333333e9, "damping_ratio": 0.1}
END
young=(treegen --species apple --age 1 --seed 3 --leaves) # whole: on fewer bodies than it has, a tree is matched to its material
"${young[@]}" | treeconvert - --material stiff.json -o stiff.tree.json
"${young[@]}" | treeconvert - --material apple -o young.json
last() { treesim "$@" --wind gusty --frames 40 | tail -n 1; }
last stiff.tree.json >last_1
last young.json --set material.E=2e10 --set material.damping_ratio=0.1 >last_2
last young.json >last_3
python3 -c '
import json
wanted, got, before = [json.load(open(f"last_{k}"))["position"] for k in (1, 2, 3)]
off = max(abs(a - b) for a, b in zip(wanted, got))
moved = max(abs(a - b) for a, b in zip(wanted, before))
assert off < 1e-9 < 1e-3 < moved, (off, moved)' || fail "--set material.E is not the tree of that material"
refused 2 'stiff.tree.json: /material: is "stiff.json", so that its numbers are not known' treesim stiff.tree.json --set material.E=1e9
refused 2 "--set material.E=0: /material/E: is 0, expected more than 0" treesim tree.json --set material.E=0

# What is wrong is told with the option and the place.
refused 2 '--set wind.velocty=[1,0,0]: /wind/velocty: is an unknown field, did you mean "velocity"?' \
    treesim gusty.json --set 'wind.velocty=[1,0,0]'
refused 2 "--set trees.4.yaw=3: /trees/4: is no element of a list of 1" treesim gusty.json --set trees.4.yaw=3
refused 1 "--set is 'wind', expected PATH=VALUE" treesim gusty.json --set wind
refused 1 "--set" treesim gusty.json --set
refused 1 "--set trees: INPUT is a tree" treesim tree.json --set trees.0.file=tree.json
refused 2 "--set pose=upright: /pose: is \"upright\", expected one of drawn, settled, rest" treesim tree.json --set pose=upright
