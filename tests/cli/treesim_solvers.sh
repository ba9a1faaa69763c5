#!/usr/bin/env bash
# treesim --solver: solvers, their schemes, precisions and saved states, joint limits.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json
treegen --age 12 --bodies 60 --seed 3 | treeconvert - -o small.json

# Solvers: each another motion, one motion however cut; what they do not take is refused. The help marks one as default.
default=$(treesim --help | grep -o '[a-z-]* (default): ' | head -n 1)
default=${default% (default): }
[[ $(hash small.json --wind gusty --frames 8) == $(hash small.json --wind gusty --frames 8 --solver "$default") ]] ||
    fail "$default is not the default"
one=$(hash small.json --wind gusty --frames 8 --solver analytic)
[[ $(hash small.json --wind gusty --frames 8 --solver analytic --set joint_inertia=paper) != "$one" ]] ||
    fail "joint_inertia paper changes nothing"
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
refused 1 "joint_inertia" treesim small.json --solver coupled --set joint_inertia=paper
refused 1 "--tolerance" treesim small.json --solver coupled --tolerance 1e-4
expect 0 treesim small.json --solver coupled --set joint_limit=20 --frames 3
treesim small.json --frames 3 --solver coupled --scheme LIE --no-output --report plan 2>plan
grep -q '^plan: .* solver coupled, scheme LIE$' plan && grep -q '^array resolvent left out, .*: a scheme of a real pole$' plan &&
    grep -q '^calls resolvent 2$' plan && grep -q '^calls spring 0$' plan || fail "--report plan does not tell the coupled step"

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
    refused 1 "joint_inertia" treesim small.json --solver $solver --set joint_inertia=paper
    refused 1 "joint_limit" treesim small.json --solver $solver --set joint_limit=10
    treesim small.json --frames 3 --solver $solver --no-output --report plan 2>&1 | grep -q "^stage articulated on: solver $solver" ||
        fail "--report plan does not name $solver"
done
[[ $(hash small.json --wind gusty --frames 8 --solver articulated-reference --tolerance 1e-4) != "$one" ]] ||
    fail "--tolerance changes nothing"
refused 1 "--tolerance" treesim small.json --solver analytic --tolerance 1e-4
refused 1 "--tolerance" treesim small.json --solver articulated-implicit --tolerance 1e-4
refused 1 "--tolerance" treesim small.json --solver articulated-reference --tolerance 0
refused 3 "stage articulated (theta), body" treesim small.json --wind gusty --frames 300 --no-output --solver articulated-explicit
grep -q "substeps" err || fail "what to do about explicit steps is not said: $(cat err)"

# Joint limits: kept within, noted, part of what a saved state belongs to; none that is reached, none that is felt.
limited() { treesim tree.json --solver "${limits_of:-analytic}" --set pose=rest --wind storm --frames 20 "$@"; }
for limits_of in coupled analytic; do
    limited --set joint_limit=3 --fields angles --report guards 2>err | python3 -c '
import json, math, sys
frames = [json.loads(line) for line in list(sys.stdin)[1:]]
most = max(abs(a) for f in frames for a in f["theta"])
assert abs(math.degrees(most) - 3) < 1e-9, math.degrees(most)' || fail "joint_limit is not kept, $limits_of"
    grep -q '^guards limits [1-9]' err || fail "stops at a limit are not counted, $limits_of"
done
limited --set joint_limit=3 --no-output -q --save-state limited.state
refused 2 "limited.state" treesim tree.json --solver analytic --set pose=rest --wind storm --frames 20 --resume limited.state
[[ $(hash tree.json --frames 20 --set joint_limit=170) == $(hash tree.json --frames 20 --simd off) ]] || fail "a limit far off is felt"
