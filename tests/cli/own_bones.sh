# A skinned model's own mesh as USD, and in scenes as every kind of mesh: read by numpy (played.py) against the OBJ frames of the same run, and these
# against runs of each tree alone; with materials and images; what is refused. Its OBJ frames themselves: skin_frames.sh.
. "$(dirname "$0")/common.sh" "$@"

python=$(python_with_numpy)
[[ -n $python ]] || { echo "no Python with numpy, which reads what is written"; exit 77; }
# plays KIND FILE PREFIX MOST [MOVES]: PREFIX_N.obj has its vertices, MOST metres apart, and they move by MOVES (0.05) or more.
plays() {
    local found
    found=$("$python" "$top/tests/cli/played.py" "$1" "$2" "$fps" "$3"_?.obj) || fail "$2 cannot be played"
    awk -v most="$4" -v moves="${5:-0.05}" '{ exit !($1 <= most && $2 >= moves) }' <<<"$found" || fail "$2: off and moves $found m, expected at most $4 and at least ${5:-0.05}"
}
fps=5
soft=(--set stiffness_scale=0.003 --frames 4 --fps $fps --settle 0)

# twig.gltf: the fixture with a picture on its bark, roughness and occlusion; bent.gltf: drawn with its side branch bent, which its skin was not bound in;
# leaf.gltf: another model, whose material is called as the twig's is, with a leaf that hangs on a bone, and a pot that no bone moves.
mkdir models
cp "$top/data/fixtures/twig_bark.bin" models
python3 - "$top/data/fixtures/twig_armature.gltf" <<'P'
import copy, json, math, struct, sys, zlib
model = json.load(open(sys.argv[1]))
def png(name, color):
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    open("models/" + name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(b"\0" + bytes(color))) + chunk(b"IEND", b""))
png("bark.png", (90, 70, 50)), png("rough.png", (0, 200, 0)), png("leaf.png", (20, 160, 30))
def painted(model, image):
    model["images"], model["textures"] = [{"uri": image}, {"uri": "rough.png"}], [{"source": 0}, {"source": 1}]
    model["materials"][0].update({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}, "metallicFactor": 0}, "occlusionTexture": {"index": 1}})
    model["materials"][0].pop("extensions")
    model.pop("extensionsUsed")
twig = copy.deepcopy(model)
painted(twig, "bark.png")
json.dump(twig, open("models/twig.gltf", "w"))
bent = copy.deepcopy(twig)
side = bent["nodes"][5]
mirrored = copy.deepcopy(twig)
next(node for node in mirrored["nodes"] if node.get("name") == "trunk")["scale"] = [-1, 1, 1]
json.dump(mirrored, open("models/mirrored.gltf", "w"))
listed = copy.deepcopy(twig)
del listed["scene"], listed["scenes"]
named = copy.deepcopy(listed["materials"][0])
named["name"] = "bark_2"
named["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 2}
listed["materials"].append(named)
listed["images"].append({"uri": "leaf.png"})
listed["textures"].append({"source": 2})
other = copy.deepcopy(listed["meshes"][0]["primitives"][0])
other["material"] = 1
listed["meshes"][0]["primitives"].append(other)
json.dump(listed, open("models/listed.gltf", "w"))
side["rotation"] = [0, 0, math.sin(0.05), math.cos(0.05)]
json.dump(bent, open("models/bent.gltf", "w"))
leaf = copy.deepcopy(model)
painted(leaf, "leaf.png")
n = len(leaf["nodes"])
leaf["meshes"].append({"primitives": [{"attributes": {"POSITION": leaf["meshes"][0]["primitives"][0]["attributes"]["POSITION"]}, "indices": leaf["meshes"][0]["primitives"][0]["indices"], "material": 0}]})
leaf["nodes"] += [{"mesh": 1, "scale": [0.1, 0.2, 0.1], "translation": [0, 0.3, 0]}, {"name": "pot", "mesh": 1, "translation": [-1, 0, 0], "scale": [0.3, 0.1, 0.3]}]
leaf["nodes"][5].setdefault("children", []).append(n)
leaf["scenes"][0]["nodes"].append(n + 1)
leaf["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] = leaf["meshes"][1]["primitives"][0]["attributes"]["POSITION"]
leaf["accessors"].append({**leaf["accessors"][leaf["meshes"][0]["primitives"][0]["attributes"]["POSITION"]], "type": "VEC2"})
for bound in "min", "max":
    leaf["accessors"][-1].pop(bound, None)
leaf["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_1"] = len(leaf["accessors"]) - 1
leaf["materials"][0].update({"emissiveFactor": [0, 0, 0.5], "alphaMode": "BLEND"})
leaf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = [1, 1, 1, 0.5]
leaf["asset"]["copyright"] = "of the leaf"
json.dump(leaf, open("models/leaf.gltf", "w"))
P

# USD: the model's own mesh, bones, materials and pictures.
for model in twig bent leaf; do
    expect 0 treesim models/$model.gltf --wind storm "${soft[@]}" -o $model.usda
    grep -q "4 bones of the model moved" err || fail "nothing is said of $model's bones: $(cat err)"
    grep -q '1 animation of its own is not shown: the tree moves it' err || fail "the model's own animation is not told of: $(cat err)"
    expect 0 treesim models/$model.gltf --wind storm "${soft[@]}" -o ${model}_%d.obj
    plays usda $model.usda $model 1e-5
done
expect 0 treesim models/mirrored.gltf --wind storm "${soft[@]}" -o mirrored_%d.obj
expect 0 treesim models/mirrored.gltf --wind storm "${soft[@]}" --key-tolerance 0 -o mirrored.glb
plays glb mirrored.glb mirrored 1e-5
expect 0 treesim models/leaf.gltf --frames 1 -o leaf.pc2
for lost in "colours of vertices are not shown" "of several sets of texture coordinates" '"bark" emits light, which is not shown' '"bark" is see-through all over'; do
    grep -q "leaf.gltf: $lost" err || fail "not told of: $lost: $(cat err)"
done
[[ $(grep -c "uniform token\[\] joints = .*\"trunk\", \"trunk/trunk_001\"" twig.usda) -eq 2 ]] || fail "joints are not the model's bones: $(grep joints twig.usda)"
grep -q "_bound" bent.usda && fail "one skin needs two joints of a bone"
grep -q '/still"' leaf.usda || fail "nothing holds the pot"
same models/bark.png twig_textures/bark.png
same models/rough.png twig_textures/bark_roughness.png
grep -q "float inputs:roughness.connect = </twig/materials/bark/roughness.outputs:g>" twig.usda || fail "no roughness"
grep -q "float inputs:occlusion.connect" twig.usda || fail "no occlusion"
expect 0 treeconvert models/twig.gltf -q -o twig.json
expect 0 treesim twig.json --skin models/twig.gltf --wind storm "${soft[@]}" -o skin.usda
plays usda skin.usda twig 1e-5
expect 0 treesim models/twig.gltf --mesh own --frames 2 -o own.usda
refused 1 "images, which stand beside a file: expected one" treesim models/twig.gltf --frames 2 --format usda

# A scene: one file three times over two places, another file, a SpeedTree XML with its mesh, one without, a ball.
cp "$top/data/fixtures/meshed_tree.xml" models/maple.xml
cp "$top/data/fixtures/two_trunks_spines.xml" models/bare.xml
models='{"file": "models/twig.gltf"}, {"file": "models/leaf.gltf", "position": [4, 0, 1]}, {"file": "models/twig.gltf", "position": [5, 0.5, -2], "yaw": 90}'
others='{"file": "models/maple.xml", "position": [-6, 0, 0]}, {"file": "models/bare.xml", "position": [0, 0, -8]}'
scene() { echo "{\"format\": \"bough-scene\", \"version\": 1, \"wind\": \"storm\", \"trees\": [$1]${2:-}}"; }
scene "$models" >models.json
scene "$others, $models" ', "balls": [{"radius": 0.1, "mass": 0.1, "position": [0, 3, 3]}]' >all.json
firm=(--set stiffness_scale=0.05 --frames 4 --fps $fps --settle 0)
for run in models all; do
    of=("$run.json" "${firm[@]}")
    expect 0 treesim "${of[@]}" -o ${run}_%d.obj
    grep -q "12 bones of the models moved" err || fail "nothing is said of the bones of $run: $(cat err)"
    joints=()
    [[ $run == models ]] || joints=(--max-joints all)
    expect 0 treesim "${of[@]}" "${joints[@]}" -o $run.usda
    plays usda $run.usda $run 1e-5 0.01
    # Programs exist that look for a joint by the last name of its path.
    [[ -z $(grep -m 1 "uniform token\[\] joints" $run.usda | grep -o '[^/"]*"[],]' | sort | uniq -d) ]] || fail "two joints of one name in $run.usda"
    expect 0 treesim "${of[@]}" "${joints[@]}" --key-tolerance 0 -o $run.glb
    grep -q "12 bones of the model moved" err || fail "nothing is said of the bones of $run.glb: $(cat err)"
    plays glb $run.glb $run 5e-5 0.01 # weights of the made mesh are shorts
    expect 0 treesim "${of[@]}" -o $run.pc2
    grep -q "the files' own meshes" err || fail "what the cache moves is not told: $(cat err)"
    expect 0 treesim "${of[@]}" -o ${run}_vat/ --vat-image png
    convert ${run}_vat/${run}_vat.png -depth 16 -endian LSB rgb:$run.places
    most=$(($(grep -c "^v " ${run}_0.obj) * 2 / 3))
    expect 0 treesim "${of[@]}" -o few_${run}_vat/ --vat-image png --vat-vertices $most
    grep -q "vertices are left: wood is off by" err || fail "nothing is said of fewer vertices: $(cat err)"
    convert few_${run}_vat/few_${run}_vat.png -depth 16 -endian LSB rgb:few_$run.places
done
python3 - <<'P' || fail "a scene's meshes as caches, textures and materials"
import json, struct
def vertices(name): return [[float(x) for x in line.split()[1:4]] for line in open(name) if line.startswith("v ")]
def apart(p, q): return max(abs(a - b) for a, b in zip(p, q))
for run in "models", "all":
    cache = open(run + ".pc2", "rb").read()
    count, = struct.unpack_from("<i", cache, 16)
    info = json.load(open(f"{run}_vat/{run}-remap_info.json"))["os-remap"]
    glb = open(f"{run}_vat/{run}.glb", "rb").read()
    size = struct.unpack_from("<I", glb, 12)[0]
    g, binary = json.loads(glb[20:20 + size]), glb[28 + size:]
    rest = []
    for primitive in g["meshes"][0]["primitives"]:
        accessor = g["accessors"][primitive["attributes"]["POSITION"]]
        start = g["bufferViews"][accessor["bufferView"]]["byteOffset"] + accessor.get("byteOffset", 0)
        rest += [struct.unpack_from("<3f", binary, start + 12 * k) for k in range(accessor["count"])]
    places = open(run + ".places", "rb").read()
    for f in range(4):
        true = vertices(f"{run}_{f}.obj")
        assert len(true) == count == len(rest), (len(true), count, len(rest))
        for v, p in enumerate(true):
            assert apart(p, struct.unpack_from("<3f", cache, 32 + 12 * (f * count + v))) < 1e-5, (run, f, v)
            b = [low + (high - low) * n / 65535 for low, high, n in zip(info["Min"], info["Max"], struct.unpack_from("<3H", places, 6 * (f * count + v)))]
            assert apart(p, (rest[v][0] + b[0], rest[v][1] + b[2], rest[v][2] - b[1])) < 3e-4, (run, f, v)
    # Each file's pictures once (the maple has found the leaf's), and both materials, though they are called alike.
    g = json.loads(open(run + ".glb", "rb").read()[20:].split(b"\0", 1)[0][:struct.unpack_from("<I", open(run + ".glb", "rb").read(), 12)[0]])
    assert len(g["images"]) == (4 if run == "models" else 5), g["images"]
    assert sorted(m["name"] for m in g["materials"]).count("bark") == (2 if run == "models" else 3), g["materials"]
    assert g["asset"]["copyright"] == "of the leaf" and len(g["animations"]) == 1, (g["asset"], len(g["animations"]))
    named = [line.split()[1] for line in open(run + ".mtl") if line.startswith("newmtl")]
    assert {"bark", "bark_2"} <= set(named) and ("bark_3" in named) == (run == "all"), named
    maps = {line.split()[1] for line in open(run + ".mtl") if line.startswith("map_Kd")}
    assert len(maps) == (2 if run == "models" else 3) and {open(m, "rb").read() for m in maps} == {open("models/bark.png", "rb").read(), open("models/leaf.png", "rb").read()}, maps
P

# Each tree of a scene moves as it does alone, put where the scene puts it: three runs, and the scene of the three, in which each has its own wind's place.
scene '{"file": "models/twig.gltf"}, {"file": "models/leaf.gltf"}, {"file": "models/twig.gltf"}' | sed 's/"storm"/{"velocity": [6, 0, 0], "turbulence": 0}/' >steady.json
python3 - <<'P'
import json
scene = json.load(open("steady.json"))
places = [([0, 0, 0], 0), ([4, 0, 1], 0), ([5, 0, -2], 0)]
for k, (tree, (position, yaw)) in enumerate(zip(scene["trees"], places)):
    tree.update({"position": position, "yaw": yaw})
    json.dump({**scene, "trees": [{"file": tree["file"]}]}, open(f"alone{k}.json", "w"))
json.dump(scene, open("steady.json", "w"))
P
expect 0 treesim steady.json "${soft[@]}" -o steady_%d.obj
for k in 0 1 2; do expect 0 treesim alone$k.json "${soft[@]}" -o alone${k}_%d.obj; done
python3 - <<'P' || fail "a tree of a scene moves otherwise than alone"
def vertices(name): return [[float(x) for x in line.split()[1:4]] for line in open(name) if line.startswith("v ")]
most = 0
for f in range(4):
    alone = [vertices(f"alone{k}_{f}.obj") for k in range(3)]
    # The twigs first, as a file's trees stand together.
    wanted = alone[0] + [[x + 5, y, z - 2] for x, y, z in alone[2]] + [[x + 4, y, z + 1] for x, y, z in alone[1]]
    found = vertices(f"steady_{f}.obj")
    assert len(found) == len(wanted), (len(found), len(wanted))
    most = max(most, max(abs(a - b) for p, q in zip(found, wanted) for a, b in zip(p, q)))
    moved = max(abs(a - b) for p, q in zip(vertices(f"alone0_{f}.obj"), vertices("alone0_0.obj")) for a, b in zip(p, q))
assert most < 3e-6, most
assert moved > 0.01, moved
P

# A file without a list of scenes, and with a name for a material that another file's would have got; from stdin.
scene '{"file": "models/twig.gltf"}, {"file": "models/listed.gltf", "position": [3, 0, 0]}' >names.json
treesim - "${soft[@]}" -q -o names_%d.obj <names.json || fail "a scene from stdin"
[[ $(grep -c "^newmtl" names.mtl) -eq 3 && $(grep "^newmtl" names.mtl | sort -u | wc -l) -eq 3 ]] || fail "materials of names.mtl: $(grep newmtl names.mtl)"
expect 0 treesim names.json "${soft[@]}" --key-tolerance 0 -o names.glb
plays glb names.glb names 1e-5

# Held joints; a scene whose only tree is turned.
scene "$others, $models" >still.json
expect 0 treesim still.json --set simulate.last_level=0 "${firm[@]}" -o held_%d.obj
expect 0 treesim still.json --set simulate.last_level=0 "${firm[@]}" --max-joints all -o held.usda
plays usda held.usda held 1e-5 0.001
scene '{"file": "models/bent.gltf", "position": [3, 0, 2], "yaw": 130}' >one.json
expect 0 treesim one.json "${soft[@]}" -o one_%d.obj
expect 0 treesim one.json "${soft[@]}" -o one.usda
plays usda one.usda one 1e-5
expect 0 treesim one.json "${soft[@]}" --key-tolerance 0 -o one.glb
plays glb one.glb one 1e-5
# A .glb whose arrays are compressed is put beside others, as it is; what is far away keeps its shape.
cp "$top/data/fixtures/twig_meshopt.glb" models/small.glb
scene '{"file": "models/small.glb"}, {"file": "models/small.glb", "position": [2, 0, 0]}, {"file": "models/twig.gltf", "position": [4, 0, 0]}' >packed.json
expect 0 treesim packed.json "${soft[@]}" -o packed.glb
grep -aq '"extensionsRequired":\["KHR_mesh_quantization","EXT_meshopt_compression"\]' packed.glb || fail "a compressed model is compressed no more"
expect 0 treesim packed.json "${soft[@]}" -o packed_%d.obj
expect 0 treesim packed.json "${soft[@]}" -o packed.usda
plays usda packed.usda packed 1e-5

# A user's own, of Blender as FBX and .glb. (Keys of a .glb are left out where a bone leaves its place by less than 1e-5 of the bones' size.)
if [[ -n ${BOUGH_CASES_DIR:-} ]]; then
    cp "$BOUGH_CASES_DIR"/sapling/sapling_quaking_aspen_s0_skin.{fbx,glb} models
    aspen=models/sapling_quaking_aspen_s0_skin
    scene "{\"file\": \"$aspen.fbx\"}, {\"file\": \"$aspen.glb\", \"position\": [9, 0, 1]}, {\"file\": \"$aspen.fbx\", \"position\": [-9, 1, 2], \"yaw\": 70}" >aspens.json
    expect 0 treesim aspens.json --frames 2 --fps $fps --settle 0 -o aspens_%d.obj
    expect 0 treesim aspens.json --frames 2 --fps $fps --settle 0 --key-tolerance 0 -o aspens.glb
    plays glb aspens.glb aspens 5e-4 0.01
else
    echo "notice: BOUGH_CASES_DIR is not set, no model of another program's is put into a scene"
fi

# Refused, or made and told of.
refused 1 "--max-joints: only with --mesh made, as all of the scene's trees show bones of their own" treesim models.json --frames 2 --max-joints 9 -o x.glb
refused 1 "--sides: only with --mesh made" treesim models.json --frames 2 --sides 9 -o x.usda
expect 0 treesim all.json --set stiffness_scale=0.05 --frames 1 --sides 5 -o coarse_%d.obj # of the tree that has no mesh
[[ $(grep -c '^v ' coarse_0.obj) -lt $(grep -c '^v ' all_0.obj) ]] || fail "--sides 5 changes nothing"
expect 0 treesim models.json --mesh made --frames 2 -o made.glb
grep -aq "trunk.001" made.glb && fail "--mesh made shows the model"
expect 0 treesim models.json --mesh own --frames 2 -o own.glb
echo "{" >models/torn.gltf
scene '{"file": "models/torn.gltf"}' >torn.json
refused 2 "torn.gltf" treesim torn.json --frames 2 -o x.glb
python3 - <<'P'
import json
model = json.load(open("models/twig.gltf"))
model["extensionsUsed"] = ["ACME_bones"]
json.dump(model, open("models/odd.gltf", "w"))
for node in model["nodes"]: node.pop("skin", None)
model.pop("extensionsUsed")
json.dump(model, open("models/skinless.gltf", "w"))
P
scene '{"file": "models/odd.gltf"}, {"file": "models/twig.gltf", "position": [3, 0, 0]}' >odd.json
refused 2 'odd.gltf: uses "ACME_bones", which cannot be put into a scene'"'s .glb" treesim odd.json --seconds 100000 -o x.glb
expect 0 treesim odd.json --frames 2 -o odd.usda
scene '{"file": "models/skinless.gltf"}' >skinless.json
expect 0 treesim skinless.json --frames 2 -o skinless.glb
grep -q "no bones move its mesh" err || fail "a mesh without a skin is not told of: $(cat err)"
refused 1 "has no mesh that could be moved" treesim skinless.json --mesh own --frames 2 -o x.glb
absent x.glb x.usda
