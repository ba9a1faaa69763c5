#!/usr/bin/env bash
# treesim --report plan: what runs, and what is left out.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json

# --report plan says what is left out.
treesim tree.json --frames 3 --report plan --no-output 2>still
treesim tree.json --frames 3 --report plan --no-output --wind calm 2>windy
grep -q '^stage lanes on: SIMD [a-z0-9]*; asleep' still && grep -q '^stage lanes on: SIMD [a-z0-9]*; /wind; no sleep' windy ||
    fail "--report plan says nothing of the wind in lanes"
grep -q '^calls lanes 2$' still && grep -q '^calls midpoint 0$' windy || fail "calls of lanes are not as explained"
for solver in coupled analytic; do
    treesim tree.json --frames 3 --report plan --no-output --solver $solver 2>unread
    treesim tree.json --frames 3 --report plan --solver $solver 2>read >/dev/null
    grep -q '^constants of bodies in document order left out' unread && grep -q '^constants of bodies in document order on' read &&
        ! grep -q '^array [a-zA-Z_]* on' unread && grep -q '^array R_wb on' read || fail "$solver keeps poses that nobody reads, or leaves out what is read"
    for explained in unread read; do
        [[ $(sed -n 's/^state: \([0-9]*\) bytes.*/\1/p' $explained) == $(sed -n 's/^allocated \([0-9]*\) bytes/\1/p' $explained) ]] ||
            fail "--report plan, $solver, $explained: the state is not as large as planned"
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
treesim tree.json --frames 3 --report plan --no-output --simd off 2>still
treesim tree.json --frames 3 --report plan --no-output --simd off --wind calm 2>windy
grep -q 'wind_field left out' still && grep -q 'wind_field on' windy || fail "--report plan says nothing of the wind"
grep -q '^calls wind_field 0$' still && grep -q '^calls wind_field 2$' windy || fail "calls are not as explained"

# Reasons are those of the scene, whichever solver and path; of the solver alone what only others have.
treesim tree.json --frames 2 --report plan --no-output --wind calm --solver analytic 2>lanes
treesim tree.json --frames 2 --report plan --no-output --wind calm --solver analytic --simd off 2>plain
for reason in "stage root_motion left out: no root motion" "stage fictitious left out: no lagged fictitious terms" "stage attachments left out: no attachments" \
    "stage midpoint left out: solver analytic"; do
    grep -q "^$reason$" lanes && grep -q "^$reason$" plain || fail "not said of the analytic solver in lanes and plain: $reason"
done
treesim tree.json --frames 2 --report plan --wind calm 2>windy >/dev/null
grep -q "^array omega_w left out, .*: no output field velocity$" windy || fail "why no velocities are kept in a wind: $(grep omega_w windy)"
treesim tree.json --frames 2 --report plan --no-output --wind calm --solver articulated-implicit 2>other
grep -q "^stage articulated on: solver articulated-implicit; /wind$" other || fail "what the articulated solver takes: $(grep articulated other)"
