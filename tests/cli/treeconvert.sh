#!/usr/bin/env bash
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 400 --seed 3 --leaves --no-source -o splines.json
wrong_use treeconvert splines.json
bad_input splines.json treeconvert
bad_input "$maple" treeconvert

refused 1 "INPUT" treeconvert --strict
refused 1 "--segment-length" treeconvert splines.json --segment-length -1
refused 1 "--segment-length" treeconvert splines.json --segment-length nan
refused 1 "--max-bend: is 1e-323, expected degrees that are more than 0 in radians too" treeconvert splines.json --max-bend 1e-323
refused 1 "--max-bodies" treeconvert splines.json --max-bodies 1
sed 's/"bodies": *400/"bodies": 1/' splines.json >one.json
refused 2 "/bodies: is 1, but this tree has at least" treeconvert one.json
refused 1 "--sides" treeconvert splines.json --sides 8
refused 1 "--sides" treeconvert splines.json --mesh x.obj --sides 2
refused 1 "--mesh" treeconvert splines.json --mesh x.stl
refused 1 "--material" treeconvert splines.json --material plywood
refused 2 "nowhere.json" treeconvert splines.json --material ./nowhere.json
refused 1 "--split" treeconvert splines.json --split
refused 1 "--units" treeconvert splines.json --units cm
absent x.obj x.mtl

# A pipe and a file give the same; both forms hold the same tree; a tree is not an input.
treegen --age 12 --bodies 400 --seed 3 --leaves --no-source | treeconvert - --no-source >pipe.json
treeconvert splines.json --no-source -o file.json
same pipe.json file.json
treeconvert splines.json --no-source -o file.safetensors
treesim file.json --frames 3 --no-output --report hash 2>a
treesim file.safetensors --frames 3 --no-output --report hash 2>b
same a b
refused 2 "file.json" treeconvert file.json
refused 2 "a tree that was converted already; convert what it was made of again" treeconvert file.json --max-bodies 50

# Importing here is importing in treegen.
treegen --import "$maple" --leaves -q --no-source | treeconvert - -q --no-source >a.json
treeconvert "$maple" -q --no-source >b.json
same a.json b.json

# Options that change the tree do change it.
treegen --seed 3 --leaves --no-source -o whole.json
bodies() { treeconvert whole.json -q --stats "$@" 2>&1 >/dev/null | sed -n 's/^bodies *\([0-9]*\):.*/\1/p'; }
[[ $(bodies --segment-length 0.02) -gt $(bodies) ]] || fail "--segment-length changed nothing"
[[ $(bodies --max-bend 2) -gt $(bodies --max-bend 80) ]] || fail "--max-bend changed nothing"
[[ $(bodies --max-bodies 300) -le 300 ]] || fail "--max-bodies was passed over"
while IFS=$'\t' read -r name _; do
    [[ $name == name ]] || expect 0 treeconvert splines.json --material "$name" -o "wood_$name.json"
done < <(treeconvert --list-materials)
expect 0 treeconvert --list-materials -o materials
treeconvert --list-materials | cmp - materials || fail "treeconvert --list-materials -o"
[[ $(for f in wood_*.json; do sed 's/"\(material\|source\)"[^,]*,//g' "$f" | cksum; done | sort -u | wc -l) -gt 1 ]] ||
    fail "all materials are one"

# A mesh beside the tree, whole or not at all.
expect 0 treeconvert splines.json --mesh rest.obj -o tree.json
grep -q '^mtllib rest.mtl' rest.obj && grep -q '^newmtl' rest.mtl || fail "the mesh has no materials"
refused 4 "missing/rest" treeconvert splines.json --mesh missing/rest.obj -o other.json
absent other.json

expect 0 treeconvert splines.json --mesh rest.glb --max-joints 50 -o tree2.json --no-source
grep -q "merged to 50 joints" err || fail "nothing is said of merging: $(cat err)"
head -c 4 rest.glb | grep -q glTF && grep -aq '"skins"' rest.glb && ! grep -aq '"animations"' rest.glb ||
    fail "the .glb is no skinned mesh at rest"
refused 1 "--max-joints" treeconvert splines.json --mesh x.obj --max-joints 50
refused 1 "--max-joints" treeconvert splines.json --mesh x.glb --max-joints -5
refused 4 "missing/rest" treeconvert splines.json --mesh missing/rest.glb -o other.json
absent other.json x.glb

# One file a root.
roots=$top/data/fixtures/two_trunks_spines.xml
expect 0 treeconvert "$roots" -q --split -o trunk_%d.json --mesh trunk_%d.obj
[[ -s trunk_0.json && -s trunk_1.json && -s trunk_1.obj && ! -e trunk_2.json ]] || fail "two trunks gave $(ls trunk_*)"
expect 0 treesim trunk_1.json --frames 2

# On a slope each is set on the ground of its own file, unless its place is kept.
cat >slope.csv <<'END'
parent,sx,sy,sz,ex,ey,ez,radius
0,0,0,0,0,0,9,0.2
0,30,0,4,30,0,13,0.2
END
bases() {
    local k
    for k in 0 1; do tr -d '\n' <slope_$k.json | sed 's/.*"joint_position": *\[\([^,]*,[^,]*\),.*/\1/'; echo -n ' '; done
}
expect 0 treeconvert slope.csv --split -o slope_%d.json
grep -q -- '--split: 1 of 2 trees set on the ground, over up to 4 m' err || fail "$(cat err)"
grep -q 'the highest of its 2 trunks begins 4 m above the lowest' err || fail "$(cat err)"
[[ $(bases) == '-15,0 15,0 ' ]] || fail "the trees of a slope do not stand on their bases: $(bases)"
expect 0 treeconvert slope.csv --split --keep-place -o slope_%d.json
[[ $(bases) == '0,0 30,4 ' ]] || fail "--keep-place did not keep $(bases)"

# What --stats counts as raised is what the note of --radii carry does not count.
expect 0 treeconvert slope.csv --stats -o slope.json
grep -q 'radii raised to have a mass 0$' err || fail "$(cat err)"

# --strict makes an error of a guess; the same with the unit stated is none about the unit.
expect 0 treeconvert "$maple" -o maple.json
if [[ -s err ]]; then
    refused 2 "--strict" treeconvert "$maple" --strict -o strict.json
    absent strict.json
fi

# A round pole that goes over under its weight leans any way: what frequency rounding makes of that is none.
printf 'spline,point,x,y,z,radius\n0,0,0,0,0,0.0112\n0,1,0,15,0,0.0112\n' >pole.csv
expect 0 treeconvert pole.csv --stats -o pole.json
grep -q "^sway  *none: branch 0 buckles under what it carries, and leans any way" err || fail "a pole that cannot stand sways: $(grep sway err)"
