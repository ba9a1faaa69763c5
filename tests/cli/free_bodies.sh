#!/usr/bin/env bash
# Scenes with balls and fracture through treesim: what is written, what is refused, and one hash however it is run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --species apple --bodies 400 --seed 2 --leaves --fruit -q | treeconvert - -q -o apple.json
cat >scene.json <<'END'
{"format": "bough-scene", "version": 1, "trees": [{"file": "apple.json"}],
 "wind": {"velocity": [8, 0, 0], "turbulence": 0.2, "gust_factor": 1.7, "swirl": {"angle": 20, "period": 3, "wavelength": 5},
          "grid": {"origin": [-4, -4], "cell": 2, "columns": 4, "rows": 4, "velocity": [8, 0, 1], "octaves": 2, "frequency": 0.5}},
 "leaves": {"air_resistance": 3, "drag_ratio": 6},
 "fracture": {"fruit": 0.05, "leaf": 0.0005, "spread": 0.4},
 "balls": [{"position": [0.3, 6, 0.1], "velocity": [0, -6, 0], "radius": 0.1, "mass": 1},
           {"position": [-0.5, 7, 0.4], "velocity": [0, -8, 0], "radius": 0.05, "mass": 0.3}]}
END
hash() { treesim scene.json --no-output --report hash "$@" 2>&1 | grep '^hash '; }

for run in "coupled" "analytic" "coupled --precision float" "coupled --simd off" "coupled --scheme P34"; do
    read -ra by <<<"--solver $run"
    one=$(hash "${by[@]}" --threads 1 --frames 40)
    [[ $(hash "${by[@]}" --threads 3 --frames 40) == "$one" ]] || fail "3 threads give another hash with $run"
    hash "${by[@]}" --frames 17 --save-state half.json >/dev/null
    [[ $(hash "${by[@]}" --frames 23 --resume half.json) == "$one" ]] || fail "a run cut in two gives another hash with $run"
    hash "${by[@]}" --frames 17 --save-state half.safetensors >/dev/null
    [[ $(hash "${by[@]}" --frames 23 --resume half.safetensors) == "$one" ]] || fail "... its state in binary, with $run"
done

# With output the same, in every form; frames list what happened.
one=$(hash --frames 40)
for kind in jsonl json safetensors glb; do
    [[ $(treesim scene.json --frames 40 --report hash -o "motion.$kind" 2>&1 | grep '^hash ') == "$one" ]] || fail "output changes the hash: $kind"
done
bodies=$(head -n 1 motion.jsonl | sed 's/.*"bodies": \([0-9]*\).*/\1/')
python3 - "$bodies" <<'END' || fail "the motion's events are wrong"
import json, struct, sys
lines = [json.loads(line) for line in open("motion.jsonl")]
head, frames = lines[0], lines[1:]
tree = json.load(open("apple.json"))
assert head["balls"] == 2 and head["bodies"] == len(tree["mass"]) + 2
events = [(f["frame"], *e) for f in frames if "event" in f
          for e in zip(f["event"], f["event_body"], f["event_on"], f["event_value"])]
broke = {e[2]: e[0] for e in events if e[1] == "broke"}
assert broke and all(tree["kind"][b] in (1, 2) for b in broke), broke
hits = [e for e in events if e[1] == "hit"]
assert any(e[2] >= len(tree["mass"]) for e in hits), "no ball hit anything"
# A ball falls freely up to its first hit: velocity then places, by hand.
first = min(e[0] for e in hits if e[2] == len(tree["mass"]))
y = [f["position"][3 * len(tree["mass"]) + 1] for f in frames]
for k in range(1, min(first, 8)):
    fall = y[k - 1] - y[k]
    assert 0.9 * 6 / 30 < fall < (6 + 9.81 * k / 30) / 30 + 1e-9, (k, fall)
# What broke leaves its place for good.
fruit = [b for b in broke if tree["kind"][b] == 2]
for b in fruit:
    after = [f["position"][3 * b:3 * b + 3] for f in frames[broke[b]:]]
    moved = sum((p - q) ** 2 for p, q in zip(after[0], after[-1])) ** 0.5
    assert moved > 0.2 or len(after) < 8, (b, after[0], after[-1])
data = open("motion.safetensors", "rb").read()
n = struct.unpack("<Q", data[:8])[0]
header = json.loads(data[8:8 + n])
assert header["event"]["shape"] == [len(events)]
def column(name, code):
    a, b = header[name]["data_offsets"]
    return struct.unpack(f"<{(b - a) // 8}{code}", data[8 + n + a:8 + n + b])
assert list(column("event_body", "q")) == [e[2] for e in events]
assert list(column("event_frame", "q")) == [e[0] for e in events]
assert list(column("event_value", "d")) == [e[4] for e in events]
END

# Meshes: what falls has a mesh of its own; the same vertices in every frame.
mkdir frames
treesim scene.json --frames 12 -q -o frames/a_%04d.obj
[[ $(grep -c '^v ' frames/a_0000.obj) -eq $(grep -c '^v ' frames/a_0011.obj) ]] || fail "the mesh changes its vertices"

# Costs and plan say so; a scene without has none of it.
treesim scene.json --no-output --frames 3 --report plan --report cost 2>plan
grep -q '^stage fracture on: /fracture' plan || fail "the plan does not name fracture"
grep -q '^cost [0-9]* bodies, 1 step a frame, [0-9.]* ms a frame$' plan || fail "no cost: $(grep ^cost plan)"
treesim apple.json --wind gusty --no-output --frames 3 --report plan 2>plan
grep -q '^stage contacts left out: no balls, no fracture' plan || fail "the plan of a tree alone has contacts"
grep -q '^calls fracture 0' plan || fail "fracture was called"
if grep -q '^free bodies' plan; then fail "free bodies take memory"; fi

# Refused, and why.
scene() { printf '{"format": "bough-scene", "version": 1, "trees": [{"file": "apple.json"}], %s}' "$1" >bad.json; }
scene '"balls": [{"position": [0, 1, 0], "radius": 0, "mass": 1}]'
refused 2 "/balls/0/radius" treesim bad.json --frames 2
scene '"balls": [{"radius": 0.1, "mass": 1}]'
refused 2 "position" treesim bad.json --frames 2
scene '"fracture": {"leaf": -1}'
refused 2 "/fracture/leaf" treesim bad.json --frames 2
scene '"fracture": {"twig": 1}'
refused 2 "twig" treesim bad.json --frames 2
scene '"fracture": {"joints": [{"on": {"body": 99999}, "torque": 1}]}'
refused 2 "99999" treesim bad.json --frames 2
scene '"contact": {"restitution": 2}'
refused 2 "/contact/restitution" treesim bad.json --frames 2
scene '"contact": {"ground": "yes"}'
refused 2 "true or false" treesim bad.json --frames 2
scene '"fracture": {}'
refused 2 "fracture" treesim bad.json --frames 2 --solver articulated-implicit
refused 1 "--report error" treesim scene.json --frames 2 --report error
refused 2 "/fracture" treeprofile error scene.json --frames 5
hash --frames 5 --save-state half.json >/dev/null
python3 -c 'import json; s = json.load(open("half.json")); s["free_bodies"] = [3]; json.dump(s, open("cut.json", "w"))'
refused 2 "/free_bodies" treesim scene.json --frames 2 --resume cut.json
treeprofile scene.json --frames 6 --repeat 2 -q >profile
grep -q '^fracture ' profile || fail "treeprofile does not list fracture"

# What no float can say is read nowhere: as data it would be infinite.
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "apple.json"}], "balls": [{"position": [1e39, 0, 0], "radius": 0.2, "mass": 1}]}' >far.json
for file in far.jsonl far.glb far.usda far_%d.obj; do
    refused 2 "/balls/0/position: holds 1e+39, expected at most 1e+15 either way" treesim far.json --frames 2 --precision float -o $file
done
sed 's/"position": \[1e39, 0, 0\]/"position": [9, 9, 0], "velocity": [0, -1e39, 0]/' far.json >fast.json
refused 2 "/balls/0/velocity: holds -1e+39" treesim fast.json --frames 2 --precision float --fields pose,velocity -o far.jsonl
absent far.jsonl far.glb far.usda far_0.obj
