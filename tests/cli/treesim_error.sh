#!/usr/bin/env bash
# treesim --report error: what a run tells of its own error.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 60 --seed 3 | treeconvert - -o small.json

# The error that a run tells of itself: one line, also with -q, whatever is written; the run is none the wiser. What it is
# worth is tests/lib/simulation/error_estimate.cpp's and tests/goals' row i; here the line is held against two runs of small.json at the two steps.
run=(small.json --wind gusty --solver coupled)
reported() { treesim "${run[@]}" --report error "$@" 2>&1 >/dev/null | grep '^error '; }
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
for also in "-o m.glb" "-o m.jsonl --threads 1" "--report hash --report plan"; do
    # shellcheck disable=SC2086
    [[ $(reported --frames 16 --substeps 2 $also) == "$one" ]] || fail "$also changes the error: $(reported --frames 16 --substeps 2 $also)"
done
for also in "" "--substeps 3" "--precision float" "--scheme LIE"; do
    # shellcheck disable=SC2086
    [[ $(hash "${run[@]}" --frames 8 $also --report error) == $(hash "${run[@]}" --frames 8 $also) ]] ||
        fail "--report error changes the motion, $also"
    # shellcheck disable=SC2086
    [[ $(reported --frames 8 -q --no-output $also | wc -l) -eq 1 ]] || fail "no error reported, $also"
done
treesim "${run[@]}" --frames 8 -q --no-output --save-state part.json
[[ $(hash "${run[@]}" --frames 9 --resume part.json --report error) == $(hash "${run[@]}" --frames 9 --resume part.json) ]] ||
    fail "--report error changes a motion that goes on"
[[ $(reported --frames 9 --resume part.json -q) == "error up to about "* ]] || fail "no error of a run that goes on"
[[ $(reported --frames 2) == "error up to about "* ]] || fail "one step: $(reported --frames 2)"
[[ $(reported --frames 1) == "error unknown: too few frames to compare" ]] || fail "no step: $(reported --frames 1)"
[[ $(treesim small.json --solver coupled --report error --frames 9 --no-output -q 2>&1) == "error none: no tip moves" ]] || fail "an error at rest"
[[ $(treesim small.json --set stiffness_scale=1e4 --set pose=rest --report error --frames 30 --no-output -q 2>&1) == "error unknown: at a quarter of the step "* ]] ||
    fail "a tree 10 000 times as stiff is resolved"
refused 1 "--report error: only with --solver coupled" treesim small.json --solver analytic --report error
refused 1 "--report error: only with --solver coupled" treesim small.json --solver articulated-implicit --report error
