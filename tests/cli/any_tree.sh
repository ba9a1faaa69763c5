# Any tree file is an input of treesim and treeprofile: converted as treeconvert converts it, and a note says how to do it by hand.
. "$(dirname "$0")/common.sh" "$@"

fixtures=$top/data/fixtures
for file in "$maple" "$fixtures/cylinder_small.txt" "$fixtures/shrub.mtg" "$fixtures/eztree_list.json" "$fixtures/two_trees.txt" "$fixtures/twig_armature.gltf"; do
    expect 0 treesim "$file" --wind gusty --frames 5 --no-output --report hash
    by_hand=$(sed -n 's/.*by hand: //p' err)
    [[ $by_hand == "treeconvert $file -o "* ]] || fail "$file: no line that does it by hand: $(cat err)"
    moved=$(grep '^hash' err)
    expect 0 $by_hand -q
    expect 0 treesim "${by_hand##* }" --wind gusty --frames 5 --no-output --report hash -q
    [[ $moved == "$(cat err)" ]] || fail "$file moves otherwise than converted by hand: $moved, $(cat err)"
done
# Splines are one of them, from a pipe too; what treegen makes moves without a step between.
treegen --age 12 --bodies 300 --seed 3 -q -o splines.json
expect 0 treesim splines.json --wind gusty --frames 5 --no-output --report hash -q
hash=$(cat err)
[[ $(treesim - --wind gusty --frames 5 --no-output --report hash -q <splines.json 2>&1) == "$hash" ]] || fail "splines from a pipe move otherwise"
grep -q "by hand: treeconvert - -o" <(treesim - --frames 2 --no-output <"$maple" 2>&1) || fail "a pipe's note"
cp "$fixtures/shrub.mtg" "a 'shrub.mtg"
treesim "a 'shrub.mtg" --frames 2 --no-output 2>err
eval "$(sed -n 's/.*by hand: //p' err) -q"
[[ -s "a 'shrub.tree.json" ]] || fail "the line by hand is no shell command: $(cat err)"

# treeprofile, scenes with several such files, --watch's list of files.
expect 0 treeprofile "$maple" --frames 4
grep -q "by hand: treeconvert" err || fail "treeprofile says nothing: $(cat err)"
[[ -n $sanitizers ]] || expect 0 treeprofile stability "$fixtures/shrub.mtg" --frames 4 --only chain
cp "$maple" maple.xml
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "maple.xml"}, {"file": "a '"'"'shrub.mtg", "position": [8, 0, 0]}, {"file": "maple.xml", "position": [0, 0, 9]}], "wind": "breeze"}' >scene.json
expect 0 treesim scene.json --frames 4 --no-output --report hash
[[ $(grep -c "by hand" err) -eq 2 ]] || fail "a scene's trees are not each named once: $(cat err)"

# Nothing of the user's is written over.
refused 1 "which INPUT reads" treesim maple.xml --frames 3 --no-output --save-tree maple.xml
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "maple.xml"}]}' >one.json
refused 1 "which INPUT reads" treesim one.json --frames 3 --no-output --save-tree maple.xml
refused 1 "would replace" treesim one.json --frames 3 -o maple.xml
same maple.xml "$maple"

# What is wrong with a file is said in a line, with its place.
head -c 3000 "$maple" >half.xml
refused 2 "half.xml:" treesim half.xml
echo "nothing here" >nothing.txt
refused 2 "nothing.txt: is of an unknown format" treesim nothing.txt
refused 2 "nothing.txt: is of an unknown format" treeprofile nothing.txt
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "half.xml"}]}' >broken.json
refused 2 "half.xml:" treesim broken.json
: >empty.json
refused 2 "empty.json: is empty" treesim empty.json
refused 2 "is a directory" treesim "$fixtures"
refused 2 "missing.xml" treesim missing.xml
