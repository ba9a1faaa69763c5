#!/usr/bin/env bash
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

wrong_use treegen --bodies 300 --seed 1
bad_input "$maple" treegen --import

refused 1 "--seed" treegen --import "$maple" --seed 3
refused 1 "--bodies" treegen --import "$maple" --bodies 300
refused 1 "--species" treegen --import "$maple" --species broadleaf
refused 1 "--units" treegen --units cm --seed 1
refused 1 "--up" treegen --up z --seed 1
refused 1 "--species" treegen --species baobab
refused 1 "--units" treegen --import "$maple" --units furlong
refused 1 "--bodies" treegen --bodies 0
refused 1 "--bodies" treegen --bodies 1e3
refused 1 "--bodies: is 1, but this tree has at least" treegen --bodies 1 --leaves
refused 1 "--format" treegen --seed 1 --format xml
refused 1 "one argument too many, expected options alone" treegen --seed 1 tree.json

# Every listed name grows; the same seed gives the same bytes, another seed does not.
expect 0 treegen --list-species
while read -r name; do expect 0 treegen --species "$name" --age 6 --bodies 200 -o "$name.json"; done < <(treegen --list-species)
expect 0 treegen --list-species -o species
treegen --list-species | cmp - species || fail "treegen --list-species -o"
expect 0 treegen --species willow --age 8 --bodies 500 --seed 7 --no-source --threads 1 -o a.json
expect 0 treegen --species willow --age 8 --bodies 500 --seed 7 --no-source --threads 3 -o b.json
same a.json b.json

# Ages and seasons: a young tree is lower, winter is bare, an item that the season lacks is said.
top() { treeconvert "$1" --stats -q -o /dev/null 2>&1 | awk '$1 == "height" { print $2 }'; }
expect 0 treegen --species oak --age 10 -o young.json
expect 0 treegen --species oak --age 40 -o old.json
awk -v young="$(top young.json)" -v old="$(top old.json)" 'BEGIN { exit !(young < old / 2) }' || fail "an oak of 10 years is not lower"
expect 0 treegen --species cherry --age 8 --season spring --bodies 2000 -o spring.json
grep -q '"leaf_kind"' spring.json || fail "a cherry without petals in spring"
expect 0 treegen --species cherry --season winter --leaves --bodies 500 -o winter.json
grep -q 'cherry has no leaves in winter' err || fail "no word on the leaves that winter lacks"
refused 1 "--season" treegen --species cherry --season monsoon
refused 1 "--age" treegen --species cherry --age 0
refused 1 "--age" treegen --species cherry --age 1e-300
refused 1 "--age: is 0.05, expected 0.1 years or more" treegen --params "$(dirname "$maple")/species/oak.json" --age 0.05
refused 1 "-o is 'tree.GLB'" treegen --species cherry -o tree.GLB
refused 1 "-o is 'tree.glb'" treeconvert "$maple" -o tree.glb
refused 1 "--age" treegen --import "$maple" --age 5
refused 1 "--season" treegen --import "$maple" --season winter
refused 1 "--petals" treegen --import "$maple" --petals
# The species' wood goes on to the tree, unless told otherwise; a wood nobody knows is refused.
treeconvert a.json -o wood.json
grep -q '"black-willow"' wood.json || fail "a willow of other wood"
treeconvert a.json --material apple -o wood.json
grep -q '"apple"' wood.json || fail "--material was not taken"
sed 's/black-willow/plywood/' a.json >plywood.json
refused 2 "plywood" treeconvert plywood.json

expect 0 treegen --bodies 500 --seed 7 --no-source -o a.json
expect 0 treegen --bodies 500 --seed 7 --no-source --threads 3 -o b.json
expect 0 treegen --bodies 500 --seed 8 --no-source -o c.json
same a.json b.json
! cmp -s a.json c.json || fail "two seeds gave one tree"

# A number of bodies changes no branch and no leaf, and few of them hold leaves too.
treegen --seed 7 --leaves --no-source -o whole.json
treegen --seed 7 --leaves --no-source --bodies 60 -o few.json
same <(sed 's/"bodies": *60,//' few.json | tr -d ' \n') <(tr -d ' \n' <whole.json)
treeconvert few.json -q --stats -o few.tree.json 2>err
grep -Eq '^bodies +[1-6][0-9]: [0-9]+ of branches, [1-9][0-9]* leaves' err || fail "60 bodies are more, or hold no leaves: $(cat err)"

# The command line is recorded, and is not with --no-source.
treegen --bodies 300 --seed 7 | grep 'treegen --bodies 300 --seed 7' >grepped || fail "the command line is not in the output"
! grep -q 'treegen --bodies' a.json || fail "--no-source left the command line in"

# stdout, -o and both forms say the same; stdin is a file like another.
treegen --bodies 300 --seed 2 --no-source >stdout.json
treegen --bodies 300 --seed 2 --no-source -o file.json
same stdout.json file.json
treegen --bodies 300 --seed 2 --no-source -o file.safetensors
treegen --import file.safetensors --no-source >back.json
same back.json file.json
treegen --import - --no-source <file.json >back.json
same back.json file.json

# Leaves only when asked for, and what is left out is said, but not with -q.
expect 0 treegen --import "$maple" -o bare.json
grep -q 'leaves left out' err || fail "leaves left out in silence"
expect 0 treegen --import "$maple" -q -o bare.json
[[ ! -s err ]] || fail "-q is not quiet: $(cat err)"
expect 0 treegen --import "$maple" --leaves -q -o leafy.json
[[ $(wc -c <leafy.json) -gt $(wc -c <bare.json) ]] || fail "--leaves kept none"

# Other programs' parameters: by file or stdin, with what is not honoured said; their own numbers, or --bodies.
fixtures=$(dirname "$maple")/fixtures
refused 1 "--species" treegen --params "$fixtures/arbaro_small.xml" --species oak
refused 1 "--params" treegen --import "$maple" --params "$fixtures/arbaro_small.xml"
refused 1 "--age" treegen --params "$fixtures/arbaro_small.xml" --age 20
refused 1 "--season" treegen --params "$fixtures/tree_gen_small.py" --season winter
refused 2 "nosuch.xml" treegen --params nosuch.xml
printf '{"g_scale": 5, "ratio": "thick"}' >thick.json
refused 2 'ratio: is "thick", expected a number' treegen --params thick.json
for file in arbaro_small.xml tree_gen_small.py sapling_old.json; do
    expect 0 treegen --params "$fixtures/$file" --leaves --seed 3 --no-source -o params.json
    expect 0 treegen --params "$fixtures/$file" --leaves --seed 3 --no-source --threads 2 -o again.json
    same params.json again.json
    expect 0 treegen --params "$fixtures/$file" --leaves --bodies 2000 -q -o params.json
    expect 0 treeconvert params.json -q -o params.tree.json
done
# What a preset draws too thin is made thick enough to move, unless its own radii are asked for.
treegen --params "$fixtures/arbaro_small.xml" --leaves -q -o params.json
treeconvert params.json -q -o params.tree.json
expect 0 treesim params.tree.json --frames 3 --no-output
treegen --params "$fixtures/arbaro_small.xml" --leaves --radii file -q -o thin.json
! cmp -s params.json thin.json || fail "--radii file changed nothing"
refused 1 "--radii" treegen --species oak --radii file
refused 1 "--radii" treegen --params "$(dirname "$maple")/species/oak.json" --radii file
expect 0 treegen --params "$fixtures/arbaro_small.xml" -o params.json
grep -q 'not honoured: Lobes, LobeDepth' err || fail "lobes left out in silence"
treegen --params "$fixtures/arbaro_small.xml" --seed 3 --no-source -q -o file.json
treegen --params - --seed 3 --no-source -q <"$fixtures/arbaro_small.xml" >stdin.json
same file.json stdin.json
[[ -f $(dirname "$maple")/species/oak.json ]] && expect 0 treegen --params "$(dirname "$maple")/species/oak.json" --bodies 500 -o oak.json

# Its own input may be its output.
cp leafy.json own.json
expect 0 treegen --import own.json --leaves -o own.json
expect 0 treegen --import own.json --leaves -o own.json
absent
