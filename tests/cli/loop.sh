#!/usr/bin/env bash
# --loop: one period of a motion that repeats, held against a closed form and against the run that goes on; its ends; what is refused.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# A stiff pole of one body in a grid's sinusoidal wind, so weak that the pole's own speed is nothing beside it:
#   I th'' + beta K th' + K th = c u(t)^2,  u = V (1 + sin w t),  c = kappa rho A / 2 at the middle, kappa 0.6, A = 2 r l
# u^2 = V^2 (3/2 + 2 sin w t - cos(2 w t) / 2): three harmonics, each with its own response.
cat >pole.json <<'END'
{"format": "bough-tree", "version": 1, "name": "pole", "parent": [-1], "mass": [1], "com": [0, 0, 0.5],
 "inertia": [0.0834, 0.0834, 0.0002, 0, 0, 0], "joint_position": [0, 0, 0], "joint_rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
 "stiffness": [19, 19, 10], "damping": [0.026], "size": [1, 0.02, 0.02], "branch": [0], "level": [0], "s": [0]}
END
wind() { echo "{\"format\": \"bough-wind\", \"version\": 1, \"velocity\": [0.01, 0, 0], \"profile\": 0$2, \"grid\": {\"origin\": [-5, -5], \"cell\": 10, \"columns\": 1, \"rows\": 1, \"octaves\": 1, \"frequency\": 0.3}}" >"$1"; }
wind wind.json ""
wind periodic.json ', "period": 3'
pole=(pole.json --wind wind.json --gravity 0,0,0 --substeps 8 --fields pose,angles --loop-tolerance 1e-12 --loop-periods 40)
cat >closed.py <<'END'
import cmath, json, math, re, sys
head, *frames = [json.loads(line) for line in open("loop.jsonl")]
assert [f["frame"] for f in frames] == list(range(90)) and frames[1]["time"] == 1 / 30, len(frames)
V, w, I, K, beta, c = 0.01, 2 * math.pi / 3, 0.0834 + 0.25, 19, 0.026, 0.6 * 1.2 * 0.04 / 2   # 0.3 Hz: a whole turn in 3 s
H = lambda s: 1 / (K + 1j * s * beta * K - I * s * s)
exact = lambda t: c * V * V * (1.5 / K + 2 * (H(w) * cmath.exp(1j * w * t)).imag - 0.5 * (H(2 * w) * cmath.exp(2j * w * t)).real)
swing = max(abs(exact(k / 30)) for k in range(90))
off = max(abs(f["theta"][1] - exact(f["time"])) for f in frames)
print(f"swing {swing:.3g} rad, off by {off / swing:.2g} of it", file=sys.stderr)
assert off < float(sys.argv[1]) * swing, off / swing
assert max(abs(f["theta"][k]) for f in frames for k in (0, 2)) < 1e-6 * swing
END
for solver in coupled analytic articulated-implicit articulated-reference; do
    allowed=2e-3
    [[ $solver != articulated-implicit ]] || allowed=0.05 # first order
    treesim "${pole[@]}" --loop 3 --solver $solver >loop.jsonl 2>note || fail "--loop with $solver: $(cat note)"
    python3 closed.py $allowed || fail "the loop of $solver is not the periodic solution"
    grep -q 'treesim: loop closed to [0-9.e-]* m ([0-9.e-]* of the height) after [0-9]* periods$' note || fail "note: $(cat note)"
    # The run that just goes on has the same frames, and again a period later.
    periods=$(sed -n 's/.*after \([0-9]*\) periods$/\1/p' note)
    treesim pole.json --wind periodic.json --gravity 0,0,0 --substeps 8 --fields pose,angles --solver $solver \
        --frames $((90 * (periods + 2))) >on.jsonl
    python3 - "$periods" <<'END' || fail "the loop of $solver is not what the run goes on with"
import json, sys
k = 90 * int(sys.argv[1])
loop = [json.loads(line) for line in open("loop.jsonl")][1:]
on = [json.loads(line) for line in open("on.jsonl")][1:]
assert len(on) == k + 180
for f in range(90):
    assert loop[f]["theta"] == on[k + f]["theta"] and loop[f]["rotation"] == on[k + f]["rotation"], f
    assert max(abs(a - b) for a, b in zip(loop[f]["theta"], on[k + 90 + f]["theta"])) < 2e-12, f
END
done

# A tree, plain and in lanes, float and double: it closes, and one hash for any threads and output.
treegen --age 12 --bodies 300 --seed 3 | treeconvert - -o tree.json
hash() { treesim tree.json --wind gusty --loop 4 "$@" --report hash 2>&1 >/dev/null | grep '^hash [0-9a-f]\{16\}$'; }
for run in "" "--simd off" "--precision float --loop-tolerance 1e-3" "--solver analytic --substeps 2"; do
    # shellcheck disable=SC2086
    one=$(hash $run --threads 1) || fail "no loop with $run"
    # shellcheck disable=SC2086
    [[ $(hash $run --threads 2 --no-output) == "$one" && $(hash $run -o loop.glb) == "$one" ]] || fail "hash of the loop with $run"
done

# Meshes: N frames; a .glb has the first once more at the end, so that its last key is its first.
mkdir frames
expect 0 treesim tree.json --wind gusty --loop 2 --fps 12 -o frames/t_%04d.obj
[[ $(find frames -name 't_*.obj' | wc -l) -eq 24 ]] || fail "2 s at 12 frames a second gave $(ls frames)"
expect 0 treesim tree.json --wind gusty --loop 4 -o loop.glb
cat >ends.py <<'END'
import json, struct
data = open("loop.glb", "rb").read()
n = struct.unpack("<I", data[12:16])[0]
doc, blob = json.loads(data[20:20 + n]), data[28 + n:]
def read(k):
    a = doc["accessors"][k]; v = doc["bufferViews"][a["bufferView"]]
    m = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[a["type"]]
    at = v.get("byteOffset", 0) + a.get("byteOffset", 0)
    kind, most = {5126: ("f", 1), 5122: ("h", 32767)}[a["componentType"]]
    flat = [x / most for x in struct.unpack_from(f"<{a['count'] * m}{kind}", blob, at)]
    return [tuple(flat[i:i + m]) for i in range(0, len(flat), m)]
moving = 0
for s in doc["animations"][0]["samplers"]:
    time, value = read(s["input"]), read(s["output"])
    if len(time) < 2: continue
    per = len(value) // len(time) # 4 for the weights of morph targets
    value = [sum(value[i:i + per], ()) for i in range(0, len(value), per)]
    moving += 1
    assert time[0] == (0.0,) and time[-1] == (4.0,), time
    sign = 1 if sum(a * b for a, b in zip(value[0], value[-1])) > 0 else -1
    assert max(abs(a - sign * b) for a, b in zip(value[0], value[-1])) < 2e-7, (value[0], value[-1])
assert moving > 10, moving
END
python3 ends.py || fail "the .glb does not end as it begins"

# What does not repeat: nothing is written; with --loop-blend the ends meet.
treegen --age 12 --bodies 300 --seed 8 --leaves | treeconvert - -o leafy.json
storm=(leafy.json --wind storm --loop 2 --loop-periods 2 --loop-tolerance 1e-9)
refused 3 "the motion does not repeat after 2 periods" treesim "${storm[@]}" -o never.glb
absent never.glb
refused 3 "the motion does not repeat after 5 periods" treesim pole.json --wind wind.json --gravity 0,0,0 --loop 3 --loop-tolerance 1e-12 \
    --loop-periods 5 --set damping_scale=0 --scheme P34 -o never.json
absent never.json
expect 0 treesim "${storm[@]}" --loop-blend -o blend.jsonl
grep -q "loop's ends were apart by .* after 2 periods: blended (--loop-blend)" err || fail "what was blended is not said: $(cat err)"
sed -i 's/time\[-1\] == (4.0,)/time[-1] == (2.0,)/' ends.py
expect 0 treesim "${storm[@]}" --loop-blend --max-joints all --key-tolerance 0 -o loop.glb
python3 ends.py || fail "the blended .glb does not end as it begins"
# The blended frames against the run that just goes on: from 40 on each joint passes from what it is to what it was a period before.
treesim leafy.json --wind storm --set wind.period=2 --frames 181 -q >on.jsonl
python3 - <<'END' || fail "the blended frames"
import json, math
tree = json.load(open("leafy.json"))
loop = [json.loads(line) for line in open("blend.jsonl")][1:]
on = [json.loads(line) for line in open("on.jsonl")][1:]
assert len(loop) == 60 and len(on) == 181
times = lambda a, b: [a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                      a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]]
back = lambda a: [-a[0], -a[1], -a[2], a[3]]
turn = lambda q, v: times(times(q, [*v, 0]), back(q))[:3]
def part(q, share):  # that share of a turn, the shorter way
    if q[3] < 0: q = [-x for x in q]
    s = math.sqrt(sum(x * x for x in q[:3]))
    half = math.atan2(s, q[3]) * share
    return [math.sin(half) * x / s if s else 0 for x in q[:3]] + [math.cos(half)]
rotation = lambda f, i: f["rotation"][4 * i:4 * i + 4]
own = lambda f, i: times(back(rotation(f, p)), rotation(f, i)) if (p := tree["parent"][i]) >= 0 else rotation(f, i)
most = 0
for k in (0, 1, 39, 40, 41, 50, 59):
    x = max(0, k / 60 - 2 / 3) * 3
    q, at = [], []
    for i, p in enumerate(tree["parent"]):
        is_, was = own(on[120 + k], i), own(on[60 + k], i)
        way = times(back(is_), was)
        most = max(most, 2 * math.acos(min(1, abs(way[3]))))
        now = times(is_, part(way, 3 * x ** 2 - 2 * x ** 3))
        q.append(now if p < 0 else times(q[p], now))
        d = tree["joint_position"][3 * i:3 * i + 3]
        at.append(d if p < 0 else [a + b for a, b in zip(at[p], turn(q[p], d))])
        sign = 1 if sum(a * b for a, b in zip(q[i], rotation(loop[k], i))) > 0 else -1
        assert max(abs(a - sign * b) for a, b in zip(q[i], rotation(loop[k], i))) < 1e-8, (k, i)
        assert math.dist(at[i], loop[k]["position"][3 * i:3 * i + 3]) < 1e-8, (k, i)
assert most > 0.1, most
END

# Refused, with the reason.
scene() { echo "{\"format\": \"bough-scene\", \"version\": 1, \"trees\": [{\"file\": \"tree.json\"}], \"wind\": \"gusty\"$1}" >scene.json; }
refused 1 "--loop is 1.01 s, which at 30 frames a second is 30.3 frames; the nearest whole number is 30, --loop 1" \
    treesim tree.json --wind gusty --loop 1.01
refused 1 "--loop: the scene has no /wind" treesim tree.json --loop 2
for option in "--seconds 2" "--frames 3" "--save-state s.json" "--resume s.json" "--report error" "--shard 1/2"; do
    # shellcheck disable=SC2086
    refused 1 "--loop: not with ${option%% *}" treesim tree.json --wind gusty --loop 2 $option
done
refused 1 "--loop-tolerance: only with --loop" treesim tree.json --loop-tolerance 1e-3
refused 1 "--loop-blend: only with --fields pose" treesim tree.json --wind gusty --loop 2 --loop-blend --fields pose,velocity
for part in 'pulls": [{"on": {"body": 0}, "time": [0, 1], "force": [[0, 0, 0], [1, 0, 0]]}]' 'fracture": {"branch": 1}' \
    'balls": [{"position": [0, 9, 0], "radius": 0.1, "mass": 1}]' 'root_motion": [{"time": [0, 1], "position": [[0, 0, 0], [1, 0, 0]]}]'; do
    scene ", \"$part"
    refused 1 "--loop: not with the scene's /${part%%\"*}, which passes" treesim scene.json --loop 2
done
scene ""
refused 1 "/wind/period is 1.5 s" treesim scene.json --loop 2 --set wind.period=1.5
expect 0 treesim scene.json --loop 3 --set wind.period=1.5 --no-output
