#!/usr/bin/env bash
# treesim --simd: the fast path.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json

# The fast path: one hash a target, said by --report plan; what it does not hold runs the plain step.
for simd in auto off baseline; do
    [[ $(hash tree.json --frames 20 --simd $simd) == $(hash tree.json --frames 20 --simd $simd --threads 1) ]] || fail "--simd $simd: threads"
done
treesim tree.json --frames 3 --no-output --report plan --simd baseline 2>err && grep -q '^stage lanes on: SIMD baseline' err || fail "--simd baseline"
grep -q '^threads [0-9]* of at most [0-9]*: ' err || fail "--report plan does not say how many threads"
treesim tree.json --frames 3 --no-output --report plan --simd off 2>err && grep -q '^stage lanes left out: plain path' err || fail "--simd off"
treesim tree.json --frames 3 --no-output --report plan --scheme LIE 2>err && grep -q '^stage lanes left out: plain path: scheme LIE' err || fail "LIE"
treesim tree.json --frames 3 --no-output --report plan --solver analytic 2>err && grep -q '^stage lanes on: SIMD ' err || fail "analytic in lanes"
grep -q '^stage spring left out: in lanes' err || fail "the plain spring beside the lanes"
treesim tree.json --frames 3 --no-output --report plan --solver analytic --simd off 2>err && grep -q '^stage spring on: ' err || fail "analytic, --simd off"
treesim tree.json --frames 3 --no-output --report plan --solver analytic --set joint_limit=170 2>err &&
    grep -q '^stage lanes left out: plain path: /joint_limit' err || fail "a joint limit in analytic lanes"
refused 1 "--simd" treesim tree.json --frames 3 --no-output --simd sse
simd=$(treesim --version | sed -n 's/^simd //p')
[[ $(hash tree.json --frames 20 --simd "$simd") == $(hash tree.json --frames 20) ]] || fail "--version says simd $simd"
