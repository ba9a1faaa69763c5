#!/usr/bin/env bash
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json
wrong_use treesim tree.json --frames 20
bad_input tree.json treesim

refused 1 "INPUT" treesim --frames 3
refused 1 "--frames" treesim tree.json --frames 0
refused 1 "--frames" treesim tree.json --frames 3 --seconds 1
refused 1 "--fps" treesim tree.json --fps 0
refused 1 "--fps" treesim tree.json --fps inf
refused 1 "--wind" treesim tree.json --wind typhoon
refused 2 "nowhere.json" treesim tree.json --wind ./nowhere.json
refused 1 "--solver" treesim tree.json --solver springs
refused 1 "--joint-limit" treesim tree.json --joint-limit 0
refused 1 "--joint-limit" treesim tree.json --joint-limit 181
refused 1 "--joint-limit" treesim tree.json --joint-limit 10 --solver articulated-implicit
refused 2 "joint_limit: body" treesim tree.json --joint-limit 1e-9
refused 1 "--precision" treesim tree.json --precision half
refused 1 "--gravity" treesim tree.json --gravity 1,2
refused 1 "--fields" treesim tree.json --fields pose,colour
refused 1 "--seed" treesim tree.json --seed 4
refused 1 "--sides" treesim tree.json --sides 5
refused 1 ".gltf" treesim tree.json -o x.gltf
refused 1 "--max-joints" treesim tree.json --max-joints 20
refused 1 "--key-tolerance" treesim tree.json --key-tolerance 1 -o x.json
refused 1 "--max-joints" treesim tree.json -o x.glb --max-joints 0
refused 1 "--max-joints" treesim tree.json -o x.glb --max-joints some
refused 1 "--key-tolerance" treesim tree.json -o x.glb --key-tolerance -1
refused 1 "--fields" treesim tree.json -o x.glb --fields pose
refused 1 "-o" treesim tree.json -o frames.obj
refused 1 "-o" treesim tree.json --format obj
refused 1 "--no-output" treesim tree.json --no-output -o x.json
refused 2 "state.json" treesim tree.json --resume ./state.json

# Frames: --frames N writes N, --seconds S round(S fps) + 1; a header line before them.
lines() { treesim tree.json "$@" | wc -l; }
[[ $(lines --frames 7) -eq 8 ]] || fail "--frames 7 wrote $(lines --frames 7) lines"
[[ $(lines --seconds 0.5 --fps 24) -eq 14 ]] || fail "--seconds 0.5 wrote $(lines --seconds 0.5 --fps 24) lines"
treesim tree.json --frames 2 --wind gusty | python3 -c '
import json, sys
head, *frames = [json.loads(line) for line in sys.stdin]
assert head["format"] == "bough-motion", head
assert [f["frame"] for f in frames] == [0, 1], frames
assert all(len(f["position"]) == 3 * head["bodies"] for f in frames)
assert all(len(f["rotation"]) == 4 * head["bodies"] for f in frames)' || fail "the motion is not as documented"

# Fields: only those asked for.
treesim tree.json --frames 2 --fields velocity,angles | tail -n 1 >frame
grep -q '"velocity"' frame && grep -q '"theta_dot"' frame || fail "a field is missing"
! grep -q '"position"' frame || fail "pose was not asked for"

# The hash does not depend on what is written, nor on where.
hash() { treesim "$@" --hash 2>&1 >/dev/null | grep '^hash [0-9a-f]\{16\}$'; }
one=$(hash tree.json --wind gusty --frames 20)
[[ $(hash tree.json --wind gusty --frames 20 --no-output) == "$one" ]] || fail "output changes the hash"
[[ $(hash tree.json --wind gusty --frames 20 -q -o m.safetensors --fields pose,velocity,torque,angles) == "$one" ]] ||
    fail "fields change the hash"
[[ $(hash tree.json --wind gusty --frames 20 -o "obj/../m_%03d.obj" 2>/dev/null || true) == "" ]] || fail "a missing folder"
mkdir frames
[[ $(hash tree.json --wind gusty --frames 20 -o frames/m_%03d.obj) == "$one" ]] || fail "meshes change the hash"
[[ $(find frames -name 'm_*.obj' | wc -l) -eq 20 && -s frames/m.mtl ]] || fail "20 frames gave $(ls frames)"
[[ $(grep -c '^v ' frames/m_000.obj) -eq $(grep -c '^v ' frames/m_019.obj) ]] || fail "the topology changes"
! cmp -s frames/m_000.obj frames/m_019.obj || fail "nothing moves in a gusty wind"
for option in "--wind storm" "--seed 5" "--gravity 0,-3,0" "--precision float" "--pose rest" "--stiffness-scale 2" \
    "--damping-scale 3" "--substeps 2" "--fps 60"; do
    # shellcheck disable=SC2086
    [[ $(hash tree.json --wind gusty --frames 20 $option) != "$one" ]] || fail "$option changes nothing"
done

# Solvers: each another motion, one motion however cut; what they do not take is refused. The help marks one as default.
treegen --bodies 60 --seed 3 | treeconvert - -o small.json
default=$(treesim --help | grep -o '[a-z-]* (default): ' | head -n 1)
default=${default% (default): }
[[ $(hash small.json --wind gusty --frames 8) == $(hash small.json --wind gusty --frames 8 --solver "$default") ]] ||
    fail "$default is not the default"
one=$(hash small.json --wind gusty --frames 8 --solver analytic)
[[ $(hash small.json --wind gusty --frames 8 --solver analytic --joint-inertia paper) != "$one" ]] ||
    fail "--joint-inertia paper changes nothing"
treesim small.json --wind gusty --frames 4 --solver analytic --no-output --save-state analytic.state

# Each precision and code its own motion, the same cut in two by a state of either form.
seen=
for precision in double float; do
    for simd in auto off; do
        run=(small.json --wind gusty --solver analytic --precision $precision --simd $simd)
        now=$(hash "${run[@]}" --frames 12)
        [[ -n $now && $seen != *" $now "* ]] || fail "analytic in $precision, $simd is the motion of another"
        seen+=" $now "
        for form in json safetensors; do
            treesim "${run[@]}" --frames 5 -q --no-output --save-state half.$form
            [[ $(hash "${run[@]}" --frames 7 --resume half.$form) == "$now" ]] ||
                fail "analytic in $precision, $simd does not go on as it was from a saved state in $form"
        done
    done
done

# The coupled solver: a motion for each scheme and precision, the same for any case of its name, cut in two or not.
seen=" $one "
for scheme in P12 P.25 P.5 P34 LIE; do
    for precision in double float; do
        plain=(small.json --wind gusty --solver coupled --precision $precision)
        run=("${plain[@]}" --scheme $scheme)
        one=$(hash "${run[@]}" --frames 8)
        [[ -n $one && $seen != *" $one "* ]] || fail "--scheme $scheme in $precision is the motion of another"
        seen+="$one "
        [[ $(hash "${plain[@]}" --frames 8 --scheme "${scheme,,}" --threads 1) == "$one" ]] || fail "${scheme,,} is not $scheme"
        for form in json safetensors; do
            treesim "${run[@]}" --frames 4 -q --no-output --save-state coupled.$form
            [[ $(hash "${run[@]}" --frames 4 --resume coupled.$form) == "$one" ]] ||
                fail "$scheme in $precision does not go on as it was from a saved state in $form"
        done
    done
done
[[ $(hash small.json --wind gusty --frames 8 --solver coupled) == $(hash small.json --wind gusty --frames 8 --solver coupled --scheme P12) ]] ||
    fail "P12 is not the default scheme"
! grep -q scaled_rate coupled.json && grep -q '"theta_dot_change"' coupled.json || fail "a coupled state holds other arrays"
! grep -q '_change' analytic.state && grep -q '"scaled_rate"' analytic.state || fail "an analytic state holds other arrays"
refused 2 "/scheme: is LIE, but this run has P12" treesim small.json --wind gusty --frames 4 --solver coupled --precision float --resume coupled.json
refused 2 "/solver: is coupled, but this run has analytic" treesim small.json --wind gusty --frames 4 --solver analytic --precision float --resume coupled.json
refused 2 "/solver: is analytic, but this run has coupled" treesim small.json --wind gusty --frames 4 --solver coupled --resume analytic.state
refused 2 "/fps" treesim small.json --wind gusty --frames 4 --solver coupled --scheme LIE --precision float --fps 60 --resume coupled.json
refused 1 "--scheme" treesim small.json --solver coupled --scheme P13
refused 1 "{P12,P.25,P.5,P34,LIE}" treesim small.json --solver coupled --scheme midpoint # damped nothing: withdrawn
refused 1 "--scheme: only with --solver coupled" treesim small.json --solver analytic --scheme P12
refused 1 "--joint-inertia" treesim small.json --solver coupled --joint-inertia paper
refused 1 "--tolerance" treesim small.json --solver coupled --tolerance 1e-4
expect 0 treesim small.json --solver coupled --joint-limit 20 --frames 3
treesim small.json --frames 3 --solver coupled --scheme LIE --no-output --explain 2>plan
grep -q '^plan: .* solver coupled, scheme LIE$' plan && grep -q '^array resolvent left out, .*: a scheme of a real pole$' plan &&
    grep -q '^calls resolvent 2$' plan && grep -q '^calls spring 0$' plan || fail "--explain does not tell the coupled step"

# The error that a run tells of itself: one line, also with -q, whatever is written; the run is none the wiser. What it is
# worth is tests/lib/simulation/error_estimate.cpp's and tests/goals' row i; here the line is held against two runs of small.json at the two steps.
run=(small.json --wind gusty --solver coupled)
reported() { treesim "${run[@]}" --report-error "$@" 2>&1 >/dev/null | grep '^error '; }
treesim "${run[@]}" --frames 16 --substeps 2 --fields pose -o coarse.jsonl
treesim "${run[@]}" --frames 16 --substeps 8 --fields pose -o fine.jsonl
one=$(reported --frames 16 --substeps 2 -q --no-output)
python3 - "$one" <<'END' || fail "the error is not the difference of two runs: $one"
import json, re, sys
percent, rms, worst = map(float, re.fullmatch(
    r"error up to about (\S+) % of the tips' RMS deflection \((\S+) mm; worst (\S+) mm\), "
    r"estimated from the same run at a quarter of the step", sys.argv[1]).groups())
tree = json.load(open("small.json"))
parent = tree["parent"]
tips = [i for i in range(len(parent)) if i not in parent]
def far_ends(frame):
    for i in tips:
        p, (x, y, z, w) = frame["position"][3 * i:3 * i + 3], frame["rotation"][4 * i:4 * i + 4]
        axis = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
        yield [a + b * length[i] for a, b in zip(p, axis)]
size = tree["size"]
length = size[0::3] if len(size) == 3 * len(parent) else [s[0] for s in size]
fine, coarse = ([json.loads(line) for line in list(open(name))[1:]] for name in ("fine.jsonl", "coarse.jsonl"))
square = lambda a, b: sum((x - y) ** 2 for x, y in zip(a, b))
off = [2.25 * square(a, b) for f in range(1, 16) for a, b in zip(far_ends(coarse[f]), far_ends(fine[f]))]
moved = [square(a, b) for f in range(1, 16) for a, b in zip(far_ends(coarse[f]), far_ends(coarse[0]))]
near = lambda a, b: abs(a / b - 1) < 0.06 # two digits
assert near(rms, 1000 * (sum(off) / len(off)) ** 0.5), (rms, 1000 * (sum(off) / len(off)) ** 0.5)
assert near(worst, 1000 * max(off) ** 0.5), (worst, 1000 * max(off) ** 0.5)
assert near(percent, 100 * (sum(off) / sum(moved)) ** 0.5), (percent, 100 * (sum(off) / sum(moved)) ** 0.5)
END
for also in "-o m.glb" "-o m.jsonl --threads 1" "--hash --explain"; do
    # shellcheck disable=SC2086
    [[ $(reported --frames 16 --substeps 2 $also) == "$one" ]] || fail "$also changes the error: $(reported --frames 16 --substeps 2 $also)"
done
for also in "" "--substeps 3" "--precision float" "--scheme LIE"; do
    # shellcheck disable=SC2086
    [[ $(hash "${run[@]}" --frames 8 $also --report-error) == $(hash "${run[@]}" --frames 8 $also) ]] ||
        fail "--report-error changes the motion, $also"
    # shellcheck disable=SC2086
    [[ $(reported --frames 8 -q --no-output $also | wc -l) -eq 1 ]] || fail "no error reported, $also"
done
treesim "${run[@]}" --frames 8 -q --no-output --save-state part.json
[[ $(hash "${run[@]}" --frames 9 --resume part.json --report-error) == $(hash "${run[@]}" --frames 9 --resume part.json) ]] ||
    fail "--report-error changes a motion that goes on"
[[ $(reported --frames 9 --resume part.json -q) == "error up to about "* ]] || fail "no error of a run that goes on"
[[ $(reported --frames 2) == "error up to about "* ]] || fail "one step: $(reported --frames 2)"
[[ $(reported --frames 1) == "error unknown: too few frames to compare" ]] || fail "no step: $(reported --frames 1)"
[[ $(treesim small.json --solver coupled --report-error --frames 9 --no-output 2>&1) == "error none: no tip moves" ]] || fail "an error at rest"
[[ $(treesim small.json --stiffness-scale 1e4 --pose rest --report-error --frames 30 --no-output -q 2>&1) == "error unknown: at a quarter of the step "* ]] ||
    fail "a tree 10 000 times as stiff is resolved"
refused 1 "--report-error: only with --solver coupled" treesim small.json --solver analytic --report-error
refused 1 "--report-error: only with --solver coupled" treesim small.json --solver articulated-implicit --report-error

for solver in articulated-implicit articulated-reference; do
    one=$(hash small.json --wind gusty --frames 8 --solver $solver)
    [[ -n $one && $seen != *" $one "* ]] || fail "--solver $solver changes nothing"
    [[ $(hash small.json --wind gusty --frames 8 --solver $solver --threads 1) == "$one" ]] || fail "threads change $solver"
    for form in json safetensors; do
        treesim small.json --wind gusty --frames 4 --solver $solver --no-output --save-state solver.$form
        [[ $(hash small.json --wind gusty --frames 4 --solver $solver --resume solver.$form) == "$one" ]] ||
            fail "$solver does not go on as it was from a saved state in $form"
    done
    refused 2 "/solver" treesim small.json --wind gusty --frames 4 --solver analytic --resume solver.json
    refused 1 "--precision float" treesim small.json --solver $solver --precision float
    refused 1 "--joint-inertia" treesim small.json --solver $solver --joint-inertia paper
    refused 1 "--joint-limit" treesim small.json --solver $solver --joint-limit 10
    treesim small.json --frames 3 --solver $solver --no-output --explain 2>&1 | grep -q "^stage articulated on: solver $solver" ||
        fail "--explain does not name $solver"
done
[[ $(hash small.json --wind gusty --frames 8 --solver articulated-reference --tolerance 1e-4) != "$one" ]] ||
    fail "--tolerance changes nothing"
refused 1 "--tolerance" treesim small.json --solver analytic --tolerance 1e-4
refused 1 "--tolerance" treesim small.json --solver articulated-implicit --tolerance 1e-4
refused 1 "--tolerance" treesim small.json --solver articulated-reference --tolerance 0
refused 3 "stage articulated (theta), body" treesim small.json --wind gusty --frames 300 --no-output --solver articulated-explicit
grep -q "substeps" err || fail "what to do about explicit steps is not said: $(cat err)"
# Joint limits: kept within, noted, part of what a saved state belongs to; none that is reached, none that is felt.
limited() { treesim tree.json --solver "${limits_of:-analytic}" --pose rest --wind storm --frames 20 "$@"; }
for limits_of in coupled analytic; do
    limited --joint-limit 3 --fields angles 2>err | python3 -c '
import json, math, sys
frames = [json.loads(line) for line in list(sys.stdin)[1:]]
most = max(abs(a) for f in frames for a in f["theta"])
assert abs(math.degrees(most) - 3) < 1e-9, math.degrees(most)' || fail "--joint-limit is not kept, $limits_of"
    grep -q 'times\? a joint was stopped at its limit' err || fail "stops at a limit are not noted, $limits_of"
done
limited --joint-limit 3 --no-output -q --save-state limited.state
refused 2 "limited.state" treesim tree.json --solver analytic --pose rest --wind storm --frames 20 --resume limited.state
# The fast path: one hash a target, said by --explain; what it does not hold runs the plain step.
for simd in auto off baseline; do
    [[ $(hash tree.json --frames 20 --simd $simd) == $(hash tree.json --frames 20 --simd $simd --threads 1) ]] || fail "--simd $simd: threads"
done
treesim tree.json --frames 3 --no-output --explain --simd baseline 2>err && grep -q '^stage lanes on: SIMD baseline' err || fail "--simd baseline"
treesim tree.json --frames 3 --no-output --explain --simd off 2>err && grep -q '^stage lanes left out: plain path' err || fail "--simd off"
treesim tree.json --frames 3 --no-output --explain --scheme LIE 2>err && grep -q '^stage lanes left out: plain path: scheme LIE' err || fail "LIE"
treesim tree.json --frames 3 --no-output --explain --solver analytic 2>err && grep -q '^stage lanes on: SIMD ' err || fail "analytic in lanes"
grep -q '^stage spring left out: in lanes' err || fail "the plain spring beside the lanes"
treesim tree.json --frames 3 --no-output --explain --solver analytic --simd off 2>err && grep -q '^stage spring on: ' err || fail "analytic, --simd off"
treesim tree.json --frames 3 --no-output --explain --solver analytic --joint-limit 170 2>err &&
    grep -q '^stage lanes left out: plain path: /joint_limit' err || fail "a joint limit in analytic lanes"
refused 1 "--simd" treesim tree.json --frames 3 --no-output --simd sse
simd=$(treesim --version | sed -n 's/^simd //p')
[[ $(hash tree.json --frames 20 --simd "$simd") == $(hash tree.json --frames 20) ]] || fail "--version says simd $simd"

# Sleep: a still tree is left out after a second, and from a saved state goes on sleeping; wrong rates are refused.
treesim tree.json --frames 90 --no-output --hash 2>err && grep -q ' steps of a body were left out: at rest below 1e-05 rad/s' err ||
    fail "nothing slept: $(cat err)"
whole=$(grep '^hash' err)
expect 0 treesim tree.json --frames 50 --no-output --save-state asleep.json
[[ $(hash tree.json --resume asleep.json --frames 40 --no-output) == "$whole" ]] || fail "asleep and cut is another run"
for how in "--sleep off" "--simd off"; do
    # shellcheck disable=SC2086
    expect 0 treesim tree.json --resume asleep.json --frames 40 --no-output $how
done
refused 1 "--sleep" treesim tree.json --frames 3 --no-output --sleep 1e-3 --solver analytic
refused 1 "--sleep" treeprofile error tree.json --wind gusty --sleep 1e-3
python3 -c 'import json; d = json.load(open("asleep.json")); d["sleep"][1] = 3; json.dump(d, open("wrong.json", "w"))'
refused 2 "/sleep" treesim tree.json --resume wrong.json --frames 40 --no-output
# Two trees, one asleep while the other is pulled: cut anywhere, the same.
cat >two.json <<'END'
{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}, {"file": "tree.json", "position": [9, 0, 0], "yaw": 40}],
 "pulls": [{"on": {"tree": 0, "body": 3}, "time": [1.8, 2.2, 2.4], "force": [[0, 0, 0], [300, 0, 0], [0, 0, 0]]}]}
END
one=$(hash two.json --frames 80 --no-output)
for cut in 10 34 50 55 70; do
    treesim two.json --frames $cut --no-output --save-state cut.safetensors -q
    [[ $(hash two.json --resume cut.safetensors --frames $((80 - cut)) --no-output) == "$one" ]] || fail "two trees, asleep and not, cut at $cut"
done
# A pull that comes and goes within one step is felt by sleepers too: the step is loaded with its middle.
cat >blip.json <<'END'
{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}],
 "pulls": [{"on": {"body": 0}, "time": [2.001, 2.016, 2.032], "force": [[0, 0, 0], [2000, 0, 0], [0, 0, 0]]}]}
END
treesim blip.json --frames 70 --fields pose >asleep.jsonl && treesim blip.json --frames 70 --fields pose --sleep off >awake.jsonl
python3 - <<'END' || fail "a pull within one step is slept through"
import json
def last(name): return [json.loads(line) for line in open(name)][-1]
a, b = last("asleep.jsonl")["position"], last("awake.jsonl")["position"]
moved = max(abs(x - y) for x, y in zip(b, [json.loads(line) for line in open("awake.jsonl")][1]["position"]))
assert moved > 1e-4, moved
assert max(abs(x - y) for x, y in zip(a, b)) < 1e-2 * moved
END
treesim tree.json --frames 90 --no-output --sleep off 2>err && ! grep -q 'left out' err || fail "--sleep off"
treesim tree.json --frames 3 --no-output --explain --sleep 1e-3 2>err && grep -q '^stage lanes on: .*; asleep below 0.001 rad/s' err || fail "--sleep 1e-3"
treesim tree.json --frames 3 --no-output --explain --wind gusty 2>err && grep -q '; no sleep: /wind/turbulence' err || fail "no sleep in gusts"
refused 1 "--sleep" treesim tree.json --frames 3 --no-output --sleep -1
for what in "--wind gusty" "--scheme LIE" "--joint-limit 170"; do
    # shellcheck disable=SC2086
    treesim tree.json --frames 3 --no-output --sleep 1e-3 $what 2>&1 | grep -q '^treesim: --sleep: nothing sleeps in this run: ' || fail "--sleep in vain with $what"
done
refused 1 "--sleep" treesim tree.json --frames 3 --no-output --sleep 1e-3 --simd off
[[ $(hash tree.json --frames 20 --joint-limit 170) == $(hash tree.json --frames 20 --simd off) ]] || fail "a limit far off is felt"

# One animated mesh: whole, from stdout the same bytes, with what merging and leaving out keys cost.
cat >glb.py <<'END'
import json, struct, sys
data = sys.stdin.buffer.read()
magic, version, size, length = struct.unpack("<4sIII", data[:16])
assert magic == b"glTF" and version == 2 and size == len(data), (magic, version, size, len(data))
doc = json.loads(data[20:20 + length])
channels = doc.get("animations", [{"channels": []}])[0]["channels"]
times = [doc["accessors"][s["input"]] for a in doc.get("animations", []) for s in a["samplers"]]
print(len(doc["skins"][0]["joints"]), len(channels), sum(t["count"] for t in times),
      max([round(t["max"][0], 4) for t in times], default="none"), "treesim" in doc["asset"]["extras"]["source"])
END
bodies=$(treesim tree.json --frames 1 -o one.jsonl && head -n 1 one.jsonl | python3 -c 'import json, sys; print(json.load(sys.stdin)["bodies"])')
one=$(hash tree.json --wind gusty --frames 20)
[[ $(hash tree.json --wind gusty --frames 20 -q -o m.glb) == "$one" ]] || fail "an animated mesh changes the hash"
read -r joints channels keys last source < <(python3 glb.py <m.glb)
[[ $joints -eq $bodies && $channels -le $bodies && $channels -gt 1 && $last == 0.6333 && $source == True ]] ||
    fail "20 frames of $bodies bodies gave $(python3 glb.py <m.glb)"
treesim tree.json --wind gusty --frames 20 -q --no-source --format glb >stdout.glb
treesim tree.json --wind gusty --frames 20 -q --no-source -o file.glb --threads 1
same stdout.glb file.glb
[[ $(treesim tree.json --wind gusty --frames 20 --format glb --key-tolerance 0 --rustle | python3 glb.py) == \
    "$bodies $((bodies + 1)) $((20 * (bodies + 1))) 0.6333 True" ]] || fail "--rustle adds no channel of its own"
[[ $(python3 glb.py <file.glb) == *False ]] || fail "--no-source leaves the command line"
[[ $(treesim tree.json --wind gusty --frames 20 --format glb --key-tolerance 0 | python3 glb.py) == \
    "$bodies $bodies $((20 * bodies)) 0.6333 True" ]] || fail "--key-tolerance 0 leaves out keys"
[[ $(treesim tree.json --wind gusty --frames 20 --format glb --key-tolerance 5 -q | python3 glb.py | cut -d' ' -f3) -lt $keys ]] ||
    fail "a larger --key-tolerance keeps as many keys"
expect 0 treesim tree.json --wind gusty --frames 20 -o few.glb --max-joints 40
read -r joints _ < <(python3 glb.py <few.glb)
[[ $joints -le 40 && $joints -gt 20 ]] || fail "--max-joints 40 gave $joints"
grep -q "merged to $joints joints (--max-joints): .* off by .* m RMS, .* m at most" err || fail "no error of merging: $(cat err)"
[[ $(treesim tree.json --frames 1 --format glb -q --max-joints all | python3 glb.py | cut -d' ' -f1) -eq $bodies ]] ||
    fail "--max-joints all merges"
closed_stdout treesim tree.json --frames 20 --format glb
refused 4 "No such file" treesim tree.json --frames 3 -o missing/x.glb
if mkdir -p small && mount -t tmpfs -o size=16k tmpfs small 2>/dev/null; then
    code=0
    treesim tree.json --frames 20 -o small/m.glb >out 2>err || code=$?
    left=$(ls -A small)
    umount small
    [[ $code -eq 4 && -z $left ]] || fail "an animated mesh on a full disk: exit $code, left: $left"
    one_line "space" treesim
fi


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
treesim place/moved.json --solver analytic --frames 2 --no-output --explain 2>&1 |
    grep -q '^stage root_motion on: /root_motion$' || fail "--explain says nothing of root motion"
treesim place/moved.json --solver coupled --frames 2 --no-output --explain 2>&1 |
    grep -q '^stage lanes on: SIMD [a-z0-9]*; roots moved by /root_motion; no sleep: /root_motion$' || fail "--explain says nothing of root motion"
treesim place/moved.json --solver coupled --simd off --frames 2 --no-output --explain 2>&1 |
    grep -q '^stage midpoint on: every scene; roots moved by /root_motion$' || fail "--explain says nothing of root motion"
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

# --explain says what is left out.
treesim tree.json --frames 3 --explain --no-output 2>still
treesim tree.json --frames 3 --explain --no-output --wind calm 2>windy
grep -q '^stage lanes on: SIMD [a-z0-9]*; asleep' still && grep -q '^stage lanes on: SIMD [a-z0-9]*; /wind; no sleep' windy ||
    fail "--explain says nothing of the wind in lanes"
grep -q '^calls lanes 2$' still && grep -q '^calls midpoint 0$' windy || fail "calls of lanes are not as explained"
for solver in coupled analytic; do
    treesim tree.json --frames 3 --explain --no-output --solver $solver 2>unread
    treesim tree.json --frames 3 --explain --solver $solver 2>read >/dev/null
    grep -q '^constants of bodies in document order left out' unread && grep -q '^constants of bodies in document order on' read &&
        ! grep -q '^array [a-zA-Z_]* on' unread && grep -q '^array R_wb on' read || fail "$solver keeps poses that nobody reads, or leaves out what is read"
    for explained in unread read; do
        [[ $(sed -n 's/^state: \([0-9]*\) bytes.*/\1/p' $explained) == $(sed -n 's/^allocated \([0-9]*\) bytes/\1/p' $explained) ]] ||
            fail "--explain, $solver, $explained: the state is not as large as planned"
    done
    treesim tree.json --frames 3 --no-output --solver $solver --save-state unread.state
    treesim tree.json --frames 3 --solver $solver --save-state read.state >/dev/null
    same_arrays() { python3 -c '
import json, sys
a, b = (json.load(open(f)) for f in sys.argv[1:])
del a["source"], b["source"]
sys.exit(a != b or len(a["theta"]) == 0)' "$@"; }
    same_arrays unread.state read.state || fail "$solver: a state saved without output is another one"
done
treesim tree.json --frames 3 --explain --no-output --simd off 2>still
treesim tree.json --frames 3 --explain --no-output --simd off --wind calm 2>windy
grep -q 'wind_field left out' still && grep -q 'wind_field on' windy || fail "--explain says nothing of the wind"
grep -q '^calls wind_field 0$' still && grep -q '^calls wind_field 2$' windy || fail "calls are not as explained"

# Sequences keep their finished frames; a full disk ends them with a count.
if mkdir -p small && mount -t tmpfs -o size=4m tmpfs small 2>/dev/null; then
    code=0
    treesim tree.json --frames 200 -o small/m_%03d.obj >out 2>err || code=$?
    whole=$(find small -name '*.obj' | wc -l)
    left=$(find small -name '.bough-*' | wc -l)
    sizes=$(for f in small/m_*.obj; do grep -c '^f ' "$f"; done | sort -u | wc -l)
    umount small
    [[ $code -eq 4 && $left -eq 0 && $sizes -le 1 ]] || fail "a sequence on a full disk: exit $code, $left unfinished"
    one_line "after $whole frames" treesim
fi
absent x.json x.glb
