#!/usr/bin/env bash
# What is baked for engines and film pipelines: vertex animation textures (OpenVAT), USD text, influences fitted for Unreal's wind.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --species apple --age 6 --bodies 120 --seed 2 --leaves -q -o splines.json
treeconvert splines.json -q -o tree.json
gusty=(treesim tree.json --wind gusty --settle 0 --look none --sides 4)
run=("${gusty[@]}" --frames 6)

# A folder of three files, with or without a slash; the same again in the folder that is there, in which others stay.
expect 0 "${run[@]}" --no-source -o oak_vat/
[[ $(ls -A oak_vat | tr '\n' ' ') == "oak-remap_info.json oak.glb oak_vat.exr " ]] || fail "in oak_vat: $(ls -A oak_vat)"
cp -r oak_vat before
echo mine >oak_vat/notes.txt
expect 0 "${run[@]}" --no-source -o oak_vat
for file in oak.glb oak_vat.exr oak-remap_info.json; do same before/$file oak_vat/$file; done
[[ $(cat oak_vat/notes.txt) == mine ]] || fail "another file in the folder is gone"
expect 0 "${run[@]}" -o oak_vat/ --vat-image png
grep -q "oak_vat.exr of an earlier run stays" err || fail "nothing is said of the older texture: $(cat err)"
[[ -s oak_vat/oak_vnrm.png && -s oak_vat/oak_vat.png ]] || fail "no PNG: $(ls oak_vat)"
expect 0 "${run[@]}" --format vat -o named_vat/
expect 0 treesim tree.json --wind breeze --loop 0.4 --loop-blend --look none --sides 4 -o loop_vat/
python3 - <<'END'
import json
info = json.load(open("oak_vat/oak-remap_info.json"))
assert info["os-remap"]["Frames"] == 6 and info["animations"]["Sway"]["looping"] is False, info
info = json.load(open("loop_vat/loop-remap_info.json"))
assert info["os-remap"]["Frames"] == 12 and info["animations"]["Sway"] == {"startFrame": 1, "endFrame": 12, "framerate": 30, "looping": True}, info
END

# What does not fit is told of, with what helps; nothing is left.
treegen --species oak --age 20 --bodies 1500 --seed 2 --leaves -q | treeconvert - -q -o large.tree.json
refused 1 "--vat-vertices 8192 simplifies it" treesim large.tree.json --wind gusty --frames 2 --settle 0 -o large_vat/ --look none
absent large_vat
expect 0 treesim large.tree.json --wind gusty --frames 2 --settle 0 -o large_vat/ --look none --vat-vertices 8000
grep -q "vertices are left: wood is off by .* leaves are kept" err || fail "nothing is said of what was left out: $(cat err)"
refused 1 "; --mesh made --sides 3 (and no --skin) shows one" treesim "$top/data/fixtures/meshed_tree.xml" --frames 2 -o few_vat/ --vat-vertices 4
expect 0 treesim large.tree.json --wind gusty --frames 2 --settle 0 -o few_vat/ --look none --vat-vertices 100
grep -q "the largest .* pieces of wood are kept" err || fail "nothing is said of the wood that was left out: $(cat err)"
rm -r few_vat
refused 1 "of the largest piece of wood alone" treesim large.tree.json --wind gusty --frames 2 --settle 0 -o few_vat/ --look none --vat-vertices 4
refused 1 "a texture holds 4096" "${gusty[@]}" --frames 5000 -o long_vat/
refused 1 "--frames" "${gusty[@]}" --frames 0 -o x_vat/
refused 1 "is only written as NAME_vat/" "${run[@]}" -o folder/
refused 1 "NAME_vat/" "${run[@]}" -o _vat/
refused 1 "an OpenVAT is a folder" "${run[@]}" --format vat
refused 1 "only with -o NAME_vat/" "${run[@]}" --vat-vertices 100 -o x.glb
refused 1 "only with -o NAME_vat/" "${run[@]}" --vat-image png -o x.usda
refused 1 "--vat-vertices" "${run[@]}" --vat-vertices 9000 -o x_vat/
refused 1 "--leaves-as" "${run[@]}" --leaves-as instances -o x_vat/
refused 1 "--max-joints" "${run[@]}" --max-joints 20 -o x_vat/
refused 4 "No such file" "${run[@]}" -o missing/x_vat/
: >file_vat
refused 4 "Not a directory" "${run[@]}" -o file_vat/
cp tree.json oak_vat/oak-remap_info.json
refused 1 "which INPUT" treesim oak_vat/oak-remap_info.json --wind gusty --frames 2 -o oak_vat/
absent few_vat long_vat x_vat folder x.glb x.usda

# USD: text, whole, with pictures beside it; to stdout without them.
expect 0 treesim tree.json --wind gusty --frames 6 --settle 0 -o apple.usda --textures 256
[[ $(head -c 9 apple.usda) == "#usda 1.0" && $(tail -n 1 apple.usda) == "}" ]] || fail "apple.usda is not whole"
grep -o '@[^@]*@' apple.usda | tr -d @ >images
[[ $(wc -l <images) -ge 3 ]] || fail "images: $(cat images)"
while read -r image; do [[ $(head -c 4 "$image" | tail -c 3) == PNG ]] || fail "$image is no picture"; done <images
expect 0 treesim tree.json --wind gusty --frames 2 --settle 0 -o a@b.usda --textures 256 # USD quotes a path that has an @ by three of them
grep -o '@@@[^ ]*@@@' a@b.usda | sed 's/@@@//g' >images
[[ $(wc -l <images) -ge 3 ]] || fail "images: $(cat images)"
while read -r image; do [[ -s $image ]] || fail "$image is not there"; done <images
expect 0 treesim tree.json --wind gusty --frames 1 --settle 0 -o a@@@b.usda --textures 256
grep -qF '@@@./a\@@@b_textures/' a@@@b.usda || fail "a path with @@@: $(grep -F asset a@@@b.usda)"
"${run[@]}" -q --no-source -o plain.usda
"${run[@]}" -q --no-source --format usda >stdout.usda
same plain.usda stdout.usda
closed_stdout "${run[@]}" --format usda
refused 1 "images, which stand beside a file" treesim tree.json --wind gusty --frames 2 --settle 0 --format usda
refused 1 "--rustle" "${run[@]}" --rustle -o x.usda
refused 1 "--key-tolerance" "${run[@]}" --key-tolerance 1 -o x.usda
refused 1 "takes no number" "${run[@]}" -o x_%d.usda
refused 1 ".usdz is not written" "${run[@]}" -o x.usdz
refused 1 ".bvh is not written" "${run[@]}" -o x.bvh
expect 0 "${run[@]}" --max-joints 20 -o joints.usda
grep -q "bodies merged to 20 joints" err || fail "nothing is said of merged joints: $(cat err)"
absent x.usda x.usdz

# Influences for Unreal's wind are fitted, and how well is said.
expect 0 treeconvert splines.json -o /dev/null --mesh unreal.glb --max-joints 100 --wind-groups unreal.json --seconds 2
grep -q "fit 2 s of gusty wind.* of the turns' variance" err || fail "nothing is said of the fit: $(cat err)"
python3 - <<'END'
import json
groups = json.load(open("unreal.json"))["SimulationGroups"]
numbers = [g[name] for g in groups for name in ("Influence", "MinInfluence", "MaxInfluence", "ShiftTop")]
assert all(0 <= x <= 1 for x in numbers) and max(numbers) == 1, groups
trunk, *others = groups
assert max(trunk["Influence"], trunk["MaxInfluence"]) < max(g["Influence"] for g in others), groups
END
refused 1 "only with --merge-below or --wind-groups" treeconvert splines.json -o x.json --seconds 2
