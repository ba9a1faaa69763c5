#!/usr/bin/env bash
# treesim --sleep: what rests is left out.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json

# Sleep: a still tree is left out after a second, and from a saved state goes on sleeping; wrong rates are refused.
treesim tree.json --frames 90 --no-output --report hash,guards 2>err && grep -q '^guards asleep [1-9][0-9]* left out at rest below 1e-05 rad/s$' err ||
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
treesim tree.json --frames 3 --no-output --report plan --sleep 1e-3 2>err && grep -q '^stage lanes on: .*; asleep below 0.001 rad/s' err || fail "--sleep 1e-3"
treesim tree.json --frames 3 --no-output --report plan --wind gusty 2>err && grep -q '; no sleep: /wind/turbulence' err || fail "no sleep in gusts"
refused 1 "--sleep" treesim tree.json --frames 3 --no-output --sleep -1
for what in "--wind gusty" "--scheme LIE" "--set joint_limit=170"; do
    # shellcheck disable=SC2086
    treesim tree.json --frames 3 --no-output --sleep 1e-3 $what 2>&1 | grep -q '^treesim: --sleep: nothing sleeps in this run: ' || fail "--sleep in vain with $what"
done
refused 1 "--sleep" treesim tree.json --frames 3 --no-output --sleep 1e-3 --simd off
