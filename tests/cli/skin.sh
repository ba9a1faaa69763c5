# treesim --skin: the user's own model moved; armatures from the command line; what is refused. Its vertices: skin_frames.sh.
. "$(dirname "$0")/common.sh" "$@"

twig=$top/data/fixtures/twig_armature.gltf
expect 0 treeconvert "$twig" -o twig.json --stats
grep -q "^splines     2 branches, 6 points" err || fail "--stats of an armature: $(cat err)"
grep -q "(control)" err || fail "a bone left out is not noted: $(cat err)"
refused 2 "(--strict)" treeconvert "$twig" -o strict.json --strict
run=(treesim twig.json --wind storm --seconds 1)
expect 0 "${run[@]}" --skin "$twig" -o a.glb
grep -q "4 bones of the model moved" err || fail "--skin says nothing: $(cat err)"
grep -q 'animations of the same bones left out for the new one: "sway"' err || fail "the model's animation: $(cat err)"
expect 0 "${run[@]}" --skin "$twig" -o b.glb --threads 1 -q
[[ ! -s err ]] || fail "-q says $(cat err)"
"${run[@]}" --skin - -o c.glb -q <"$twig" 2>err && fail "a .gltf from a pipe has no buffers"
one_line "read from a pipe" treesim
# The output is a model again: the same tree comes of it.
expect 0 treegen --import "$twig" --no-source -o before.json
expect 0 treegen --import a.glb --no-source -o after.json
same <(sed 1,4d before.json | grep -v '"name"\|"source"') <(sed 1,4d after.json | grep -v '"name"\|"source"')
cat a.glb | treesim twig.json --frames 3 --skin - -q -o e.glb || fail "a .glb from a pipe"

# Arrays that were quantized and compressed (gltfpack) move the same bones and stay as they are.
small=$top/data/fixtures/twig_meshopt.glb
expect 0 treesim "$small" --frames 3 -o small.glb
grep -q "4 bones of the model moved" err || fail "a compressed model: $(cat err)"
grep -aq '"extensionsRequired":\["KHR_mesh_quantization","EXT_meshopt_compression"\]' small.glb || fail "the model is compressed no more"
expect 0 treegen --import "$small" --no-source -o before.json
expect 0 treegen --import small.glb --no-source -o after.json
same <(sed 1,4d before.json | grep -v '"name"\|"source"') <(sed 1,4d after.json | grep -v '"name"\|"source"')

# In a scene the model stays at its own origin.
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "twig.json", "position": [30, 0, 5], "yaw": 40}], "wind": "storm"}' >one.json
expect 0 treesim one.json --frames 5 --skin "$twig" -o scene.glb
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "twig.json"}, {"file": "twig.json", "position": [3, 0, 0]}]}' >two.json
refused 1 "expected one" treesim two.json --frames 5 --skin "$twig" -o two.glb

refused 1 "--skin: only with a mesh" "${run[@]}" --skin "$twig" -o x.jsonl
refused 1 "--sides: not with --skin" "${run[@]}" --skin "$twig" --sides 8 -o x.glb
refused 1 "--max-joints: not with --skin" "${run[@]}" --skin "$twig" --max-joints 8 -o x.glb
cp a.glb own.glb
refused 1 "which --skin reads" "${run[@]}" --skin own.glb -o ./own.glb
refused 2 "has no mesh of its own" "${run[@]}" --skin "$maple" -o x.glb
refused 2 "is no model that can be moved" "${run[@]}" --skin "$top/data/fixtures/shrub.mtg" -o x.glb
refused 2 "has no armature" "${run[@]}" --skin "$top/data/fixtures/lines.gltf" -o x.glb
refused 2 "none.glb" "${run[@]}" --skin none.glb -o x.glb
head -c 900 a.glb >cut.glb
refused 2 "cut off" "${run[@]}" --skin cut.glb -o x.glb
refused 2 "cut off" treegen --import cut.glb
treegen --age 12 --bodies 300 -q | treeconvert - -q -o other.json
refused 2 "expected the model that the tree was made from" treesim other.json --frames 3 --skin "$twig" -o x.glb
# A texture beside the model that is no image.
python3 - "$twig" <<'END'
import json, sys
model = json.load(open(sys.argv[1]))
model["images"], model["textures"] = [{"uri": "bark.png"}], [{"source": 0}]
model["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
json.dump(model, open("painted.gltf", "w"))
END
cp "$(dirname "$twig")/twig_bark.bin" .
expect 0 treesim painted.gltf --frames 2 -o painted.glb
grep -q 'image "bark.png" not put into the file' err || fail "a missing texture is not named: $(cat err)"
echo hello >bark.png
refused 2 'image "bark.png" is no image that can be read' treesim painted.gltf --frames 2 -o x.glb

# INPUT's own mesh is shown, or it is said why another is.
armatures=$top/data/fixtures/two_armatures.dae
refused 2 "its own mesh: two of its nodes are called" treesim "$armatures" --frames 2 -o x.glb
refused 2 "--mesh made shows one that is made from the tree" treesim "$armatures" --frames 2 -o x.glb
expect 0 treesim "$armatures" --frames 2 --mesh made -o made.glb
expect 0 treesim "$top/data/fixtures/twig_joints.dae" --frames 2 -o joints.glb
grep -q 'its bones move no mesh of faces.*: a mesh made from the tree is shown' err || fail "a made mesh is not told of: $(cat err)"
python3 - "$twig" <<'END'
import json, sys
model = json.load(open(sys.argv[1]))
for node in model["nodes"]:
    node.pop("skin", None)
json.dump(model, open("skinless.gltf", "w"))
END
expect 0 treesim skinless.gltf --frames 2 -o skinless.glb
grep -q 'no bones move its mesh' err || fail "a mesh without skin is not told of: $(cat err)"
absent x.glb x.jsonl two.glb strict.json
