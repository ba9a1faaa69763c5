# The vertices of a model that bones move, as OBJ frames, .mdd and .pc2 have them, against the .glb of the same run, skinned here by the
# specification of glTF; at rest the file's own; with its materials and images; what is refused.
. "$(dirname "$0")/common.sh" "$@"

twig=$top/data/fixtures/twig_armature.gltf
# leafy.gltf: the twig with two leaves that hang on its side branch, one through a node of its own that is scaled unequally; a pot that
# nothing moves; an image; vertices of the middle of the trunk moved by both its bones, in two sets of weights.
cat >leafy.py <<'P'
import base64, json, struct, sys
source, folder = sys.argv[1:]
model = json.load(open(source))
data = bytearray(open(source.replace("armature.gltf", "bark.bin"), "rb").read())
def add(numbers, form, component, kind, width):
    data.extend(b"\0" * (-len(data) % 4))
    model["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": struct.calcsize(form) * len(numbers)})
    data.extend(struct.pack("<" + str(len(numbers)) + form, *numbers))
    model["accessors"].append({"bufferView": len(model["bufferViews"]) - 1, "componentType": component, "count": len(numbers) // width, "type": kind})
    return len(model["accessors"]) - 1
bark = model["meshes"][0]["primitives"][0]["attributes"]
# A third of what moves vertices 4 to 11, a ring at 1 m on either bone, is the other bone's.
weights, joints, second = [], [], []
for v in range(32):
    shared = 4 <= v < 12
    weights += [2 / 3 if shared else 1, 0, 0, 0]
    joints += [1 if v < 8 else 0, 0, 0, 0]
    second += [1 / 3 if shared else 0, 0, 0, 0]
bark["WEIGHTS_0"], bark["JOINTS_1"], bark["WEIGHTS_1"] = add(weights, "f", 5126, "VEC4", 4), add(joints, "B", 5121, "VEC4", 4), add(second, "f", 5126, "VEC4", 4)
bark["TEXCOORD_0"] = add([x for v in range(32) for x in (v / 32, v % 4 / 4)], "f", 5126, "VEC2", 2)
model["meshes"].append({"primitives": [{"attributes": {"POSITION": add([0, 0, 0, 0.1, 0, 0, 0, 0.2, 0.05, 9, 9, 9], "f", 5126, "VEC3", 3)}, "indices": add([0, 1, 2], "H", 5123, "SCALAR", 1), "material": 1}]})
nodes = model["nodes"]
n = len(nodes)
nodes += [{"mesh": 1, "translation": [0, 0.3, 0]}, {"children": [n + 2], "translation": [0.1, 0.2, 0], "scale": [1, 2, 0.5]}, {"mesh": 1, "rotation": [0, 0.6, 0, 0.8]}, {"name": "pot", "mesh": 1, "translation": [-1, 0, 0]}]
nodes[5].setdefault("children", []).append(n)
nodes[5]["children"].append(n + 1)
model["scenes"][0]["nodes"].append(n + 3)
png = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==")
open(folder + "/spring.png", "wb").write(png)
model["images"], model["textures"] = [{"uri": "spring.png"}], [{"source": 0}]
model["materials"].append({"name": "spring leaf", "alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})
model["buffers"] = [{"uri": "leafy.bin", "byteLength": len(data)}]
open(folder + "/leafy.bin", "wb").write(data)
json.dump(model, open(folder + "/leafy.gltf", "w"))
P
mkdir -p art frames
python3 leafy.py "$twig" art

# compare FILE.glb PATTERN FRAME,... [X,Y,Z YAW [MOST]]: the OBJ frames beside the .glb's vertices, which stand in the scene where it says: MOST of
# the height apart (1e-5).
cat >compare.py <<'P'
import json, math, struct, sys
glb, pattern, frames = sys.argv[1:4]
place, yaw = ([float(x) for x in sys.argv[4].split(",")], math.radians(float(sys.argv[5]))) if len(sys.argv) > 4 else ([0, 0, 0], 0)
allowed = float(sys.argv[6]) if len(sys.argv) > 6 else 1e-5
data = open(glb, "rb").read()
size = struct.unpack("<I", data[12:16])[0]
g, binary = json.loads(data[20:20 + size]), data[28 + size:]
def rows(index):
    a = g["accessors"][index]
    view = g["bufferViews"][a["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[a["type"]]
    form, most = {5120: ("b", 127), 5121: ("B", 255), 5122: ("h", 32767), 5123: ("H", 65535), 5125: ("I", 1), 5126: ("f", 1)}[a["componentType"]]
    stride = view.get("byteStride", width * struct.calcsize(form))
    start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
    scale = most if a.get("normalized") else 1
    return [[x / scale for x in struct.unpack_from("<%d%s" % (width, form), binary, start + k * stride)] for k in range(a["count"])]
def product(a, b): return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
def columns(m): return [[m[4 * j + i] for j in range(4)] for i in range(4)]
def matrix(t, q, s):
    x, y, z, w = (c / math.sqrt(sum(c * c for c in q)) for c in q)
    r = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return [[r[i][j] * s[j] for j in range(3)] + [t[i]] for i in range(3)] + [[0, 0, 0, 1]]
motion = g["animations"][0]
read = {i: [[x[0] for x in rows(s["input"])], rows(s["output"])] for i, s in enumerate(motion["samplers"])}
def at(sampler, time): # keys stand at the frames that are asked for, or their neighbours are the same
    times, values = read[sampler]
    k = max((k for k in range(len(times)) if times[k] <= time + 1e-5), default=0)
    if k + 1 == len(times) or abs(times[k] - time) < 1e-5: return values[k]
    f = (time - times[k]) / (times[k + 1] - times[k])
    return [a + f * (b - a) for a, b in zip(values[k], values[k + 1])]
def worlds(time):
    moved = {}
    for c in motion["channels"]: moved[c["target"]["node"], c["target"]["path"]] = at(c["sampler"], time)
    local = [columns(n["matrix"]) if "matrix" in n else matrix(moved.get((i, "translation"), n.get("translation", [0, 0, 0])), moved.get((i, "rotation"), n.get("rotation", [0, 0, 0, 1])), n.get("scale", [1, 1, 1])) for i, n in enumerate(g["nodes"])]
    world = [None] * len(local)
    def down(i, above):
        world[i] = product(above, local[i])
        order.append(i)
        for c in g["nodes"][i].get("children", []): down(c, world[i])
    order = []
    for i in g["scenes"][g.get("scene", 0)]["nodes"]: down(i, columns([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]))
    return world, order
arrays = {}
def array(index):
    if index not in arrays: arrays[index] = rows(index)
    return arrays[index]
def vertices(time):
    world, order = worlds(time)
    shown, materials = [], []
    for i in order:
        for p, primitive in enumerate(g["meshes"][g["nodes"][i]["mesh"]]["primitives"] if "mesh" in g["nodes"][i] else []):
            material = primitive.get("material")
            if material not in materials: materials.append(material)
            shown.append((materials.index(material), g["nodes"][i]["mesh"], p, len(shown), i, primitive))
    out = []
    for _, _, _, _, i, primitive in sorted(shown, key=lambda s: s[:4]):
        node, has = g["nodes"][i], primitive["attributes"]
        used = sorted({int(x[0]) for x in array(primitive["indices"])})
        if "skin" in node:
            skin = g["skins"][node["skin"]]
            by = [product(world[j], columns(b)) for j, b in zip(skin["joints"], array(skin["inverseBindMatrices"]))]
            sets = [(array(has["JOINTS_%d" % k]), array(has["WEIGHTS_%d" % k])) for k in range(4) if "JOINTS_%d" % k in has]
        for v in used:
            x = array(has["POSITION"])[v] + [1]
            sums = [0] * 3
            shares = [(by[int(j)], w) for joint, weight in sets for j, w in zip(joint[v], weight[v]) if w > 0] if "skin" in node else [(world[i], 1)]
            for m, w in shares:
                for k in range(3): sums[k] += w * sum(m[k][c] * x[c] for c in range(4))
            total = sum(w for m, w in shares)
            a, b, c = (s / total for s in sums)
            out.append([place[0] + math.cos(yaw) * a + math.sin(yaw) * c, place[1] + b, place[2] - math.sin(yaw) * a + math.cos(yaw) * c])
    return out
worst, most, fps, rest = 0, 0, 30, None
for frame in map(int, frames.split(",")):
    truth = vertices(frame / fps)
    ours = [[float(x) for x in line.split()[1:4]] for line in open(pattern % frame) if line.startswith("v ")]
    assert len(truth) == len(ours), (len(truth), len(ours))
    height = max(v[1] for v in truth) - min(v[1] for v in truth)
    worst = max([worst] + [math.dist(a, b) / height for a, b in zip(truth, ours)])
    rest = rest or ours
    most = max([most] + [math.dist(a, b) / height for a, b in zip(rest, ours)])
print("%d vertices, off by %.2g of the height, moved by %.2g" % (len(ours), worst, most))
assert worst < allowed, worst
assert most > (0.02 if allowed == 1e-5 else 1e-3), "nothing moves"
P

soft=(--set material.E=2e8) # so that it bends
run=(treesim art/leafy.gltf "${soft[@]}" --wind storm --seconds 1 --fps 30)
expect 0 "${run[@]}" --key-tolerance 0 -o leafy.glb
expect 0 "${run[@]}" -o frames/leafy_%d.obj
grep -q "4 bones of the model moved" err || fail "OBJ frames say nothing of bones: $(cat err)"
! grep -q "made from the tree" err || fail "a made mesh: $(cat err)"
grep -q "1 mesh stays still" err || fail "the pot is not told of: $(cat err)"
python3 compare.py leafy.glb frames/leafy_%d.obj 0,1,7,15,30 >said 2>&1 || fail "OBJ frames and the .glb: $(cat said)"
# At rest the bark's vertices are the file's, which its bones draw where it has them.
python3 - "$top" <<'P' || fail "at rest the vertices are not the file's"
import math, struct, sys
data = open(sys.argv[1] + "/data/fixtures/twig_bark.bin", "rb").read()
file = [struct.unpack_from("<3f", data, 12 * k) for k in range(32)]
vertex = [[float(x) for x in line.split()[1:4]] for line in open("frames/leafy_0.obj") if line.startswith("v ")]
assert len(vertex) == 32 + 3 * 3
assert max(min(math.dist(a, b) for b in vertex) for a in file) < 2e-6
P
expect 0 "${run[@]}" -o leafy.pc2
grep -q "the file's own mesh" err || fail "what a cache moves is not told: $(cat err)"
expect 0 "${run[@]}" -o leafy.mdd
python3 - <<'P' || fail "the caches hold other vertices than the OBJ frames"
import struct
pc2, mdd = open("leafy.pc2", "rb").read(), open("leafy.mdd", "rb").read()
n, frames = struct.unpack_from("<i", pc2, 16)[0], struct.unpack_from("<i", pc2, 28)[0]
assert (frames, n) == struct.unpack_from(">ii", mdd) == (31, 41), (frames, n)
for f in range(frames):
    obj = [float(x) for line in open("frames/leafy_%d.obj" % f) if line.startswith("v ") for x in line.split()[1:4]]
    a = struct.unpack_from("<%df" % (3 * n), pc2, 32 + 12 * n * f)
    b = struct.unpack_from(">%df" % (3 * n), mdd, 8 + 4 * frames + 12 * n * f)
    assert a == b and list(a) == [struct.unpack("f", struct.pack("f", x))[0] for x in obj], f
P
# Threads change nothing; nor does a tree of one's own making from the file, or where the scene puts it.
expect 0 "${run[@]}" --threads 1 -o one.pc2
same leafy.pc2 one.pc2
expect 0 treeconvert art/leafy.gltf -o twig.json
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "twig.json", "position": [30, 2, 5], "yaw": 40}], "wind": "storm"}' >one.json
expect 0 treesim one.json "${soft[@]}" --seconds 0.5 --skin art/leafy.gltf --key-tolerance 0 -o one.glb
expect 0 treesim one.json "${soft[@]}" --seconds 0.5 --skin art/leafy.gltf -o one_%d.obj
python3 compare.py one.glb one_%d.obj 0,4,15 30,2,5 40 >said 2>&1 || fail "in a scene: $(cat said)"
# Compressed and quantized arrays are decoded.
expect 0 treesim "$top/data/fixtures/twig_meshopt.glb" --frames 2 -o small_%d.obj
expect 0 treesim "$twig" --frames 2 -o plain_%d.obj
python3 - <<'P' || fail "compressed arrays show another mesh"
import math
read = lambda name: [[float(x) for x in line.split()[1:4]] for line in open(name) if line.startswith("v ")]
small, plain = read("small_1.obj"), read("plain_1.obj")
assert max(min(math.dist(a, b) for b in small) for a in plain) < 2e-3 # of 14 bits, 2 m high
P

# A user's own, of Blender as FBX. (A .glb has no key of a bone that leaves its place by less than 1e-5 of the bones' size, and these bones lie in chains.)
if [[ -n ${BOUGH_CASES_DIR:-} ]]; then
    aspen=$BOUGH_CASES_DIR/sapling/sapling_quaking_aspen_s0_skin.fbx
    expect 0 treesim "$aspen" "${soft[@]}" --wind gusty --seconds 1 --key-tolerance 0 -o aspen.glb
    expect 0 treesim "$aspen" "${soft[@]}" --wind gusty --seconds 1 -o aspen_%d.obj
    python3 compare.py aspen.glb aspen_%d.obj 0,30 0,0,0 0 3e-5 >said 2>&1 || fail "the aspen: $(cat said)"
else
    echo "notice: BOUGH_CASES_DIR is not set, no model of another program's is compared"
fi

# Materials in the scene's order, with the image that stands in a folder beside the .mtl; coordinates count from the bottom.
python3 - <<'P' || fail "materials and coordinates"
mtl = open("frames/leafy.mtl").read()
assert mtl.index("newmtl spring_leaf") < mtl.index("newmtl bark"), mtl
assert "map_Kd leafy_textures/spring_leaf.png\nmap_d -imfchan m leafy_textures/spring_leaf.png" in mtl, mtl
image = mtl.split("map_Kd ")[1].split("\n")[0]
assert open("frames/" + image, "rb").read() == open("art/spring.png", "rb").read()
kd = [float(x) for x in mtl[mtl.index("newmtl bark"):].split("Kd ")[1].split("\n")[0].split()]
assert all(abs(a - b) < 1e-3 for a, b in zip(kd, (0.5371, 0.3885, 0.2777))), kd # sRGB of 1/4, 1/8, 1/16
coordinates = [[float(x) for x in line.split()[1:]] for line in open("frames/leafy_3.obj") if line.startswith("vt ")]
assert coordinates[9:] == [[v / 32, 1 - v % 4 / 4] for v in range(32)]
lines = open("frames/leafy_3.obj").read().split("\n")
assert lines[0] == "mtllib leafy.mtl" and [l for l in lines if l.startswith("usemtl")] == ["usemtl spring_leaf", "usemtl bark"]
P

# Draco's form is in a .glb alone: else ours is shown, with a note.
python3 - <<'P'
import json
model = json.load(open("art/leafy.gltf"))
model["extensionsUsed"] = ["KHR_draco_mesh_compression"]
model["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}}
json.dump(model, open("art/packed.gltf", "w"))
P
expect 0 treesim art/packed.gltf --frames 1 -o packed_%d.obj
grep -q "its mesh is in Draco's form, which is not read: one made from the tree is shown" err || fail "a packed mesh: $(cat err)"
refused 2 "its own mesh: is in Draco's form" treesim art/packed.gltf --mesh own --frames 1 -o x_%d.obj
refused 2 "holds a mesh in Draco's form" treesim twig.json --skin art/packed.gltf --frames 1 -o x_%d.obj

# Our own .glb whose joints stand for whole crowns: its bones are not the tree's, which is read finer. Said where nobody asked, refused where one did.
treegen -q --species cherry --age 4 --bodies 60 --leaves | treeconvert -q - -o cherry.json
expect 0 treesim cherry.json --frames 2 --max-joints 1 -o cherry.glb
for to in cherry_%d.obj again.glb; do
    expect 0 treesim cherry.glb --frames 1 -o $to
    grep -q "bones lie beside the tree.*: a mesh made from the tree is shown" err || fail "$to: $(cat err)"
    refused 2 "bones lie beside the tree" treesim cherry.glb --mesh own --frames 1 -o $to
done
expect 0 treesim cherry.glb --frames 1 -o cherry.pc2
! grep -q "own mesh, material by material" err || fail "a cache of a made mesh is said to be of the file's: $(cat err)"
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "cherry.glb"}, {"file": "art/leafy.gltf", "position": [20, 0, 0]}]}' >both.json
for to in cherry_%d.obj again.glb; do
    expect 0 treesim both.json --frames 1 -o $to
    grep -q "bones lie beside the tree.*: a mesh made from the tree is shown" err || fail "$to of a scene: $(cat err)"
    refused 2 "bones lie beside the tree" treesim both.json --mesh own --frames 1 -o $to
done
grep -q "spring_leaf" cherry_0.obj || fail "the scene's other model is not shown"
rm -r cherry.glb again.glb cherry.pc2 cherry.mtl cherry_*

# A scene that names the model shows it, in any form.
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "art/leafy.gltf", "position": [30, 2, 5], "yaw": 40}], "wind": "storm"}' >named.json
expect 0 treesim named.json "${soft[@]}" --frames 16 -o x_%d.obj
expect 0 treesim named.json "${soft[@]}" --frames 16 --key-tolerance 0 -o x.glb
python3 compare.py x.glb x_%d.obj 0,4,15 >said 2>&1 || fail "a scene that names the model: $(cat said)"
expect 0 treesim named.json --mesh made --frames 1 -o x_%d.obj
! grep -q "spring_leaf" x_0.obj || fail "--mesh made of a scene"
rm -r x.glb x.mtl x_*

# Ours where it is asked for; refused: what is out of range, with its place, and nothing is written.
expect 0 treesim art/leafy.gltf --mesh made --frames 1 -o made_%d.obj
! grep -q "spring_leaf" made_0.obj || fail "--mesh made"
refused 1 "--sides: only with --mesh made" treesim art/leafy.gltf --frames 1 --sides 5 -o x_%d.obj
refused 1 "--sides: not with --skin" treesim twig.json --skin art/leafy.gltf --frames 1 --sides 5 -o x.pc2
broken() { # PYTHON TEXT: what it makes of model and data
    python3 - "$1" <<'P'
import json, struct, sys
model, data = json.load(open("art/leafy.gltf")), bytearray(open("art/leafy.bin", "rb").read())
bark = model["meshes"][0]["primitives"][0]
def put(accessor, form, k, value):
    view = model["bufferViews"][model["accessors"][accessor]["bufferView"]]
    struct.pack_into("<" + form, data, view.get("byteOffset", 0) + k * struct.calcsize(form), value)
exec(sys.argv[1])
open("art/broken.bin", "wb").write(data)
model["buffers"][0]["uri"] = "broken.bin"
json.dump(model, open("art/broken.gltf", "w"))
P
    for to in x_%d.obj x.pc2 x.mdd; do
        refused 2 "$2" treesim art/broken.gltf --frames 2 -o $to
        refused 2 "$2" treesim twig.json --skin art/broken.gltf --frames 2 -o $to
    done
}
broken 'put(bark["indices"], "H", 5, 32)' 'mesh 0, primitive 0: a triangle names vertex 32'
broken 'put(bark["attributes"]["JOINTS_1"], "B", 16, 5)' 'JOINTS_1 has joint 5 move vertex 4, but skin 0 has 5 joints'
broken 'put(bark["attributes"]["WEIGHTS_1"], "f", 17, float("nan"))' 'WEIGHTS_1: vertex 4 is not finite'
broken 'put(bark["attributes"]["POSITION"], "f", 4, float("inf"))' 'POSITION: vertex 1 is not finite'
broken 'pot, leaf = model["nodes"][-1], model["meshes"][1]["primitives"][0]["attributes"]["POSITION"]
pot.pop("translation"); pot["matrix"] = [1, 1e308, 0, 0, 0, -1e308, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
put(leaf, "f", 3, 100); put(leaf, "f", 4, 100)' 'is drawn beyond any float, at 100, ' # in y alone
broken 'put(model["skins"][0]["inverseBindMatrices"], "f", 3, float("nan"))' 'inverseBindMatrices: matrix 0 is not finite'
broken 'model["materials"][1]["alphaMode"] = 5' '/materials/1/alphaMode: is a number, expected a text'
broken 'bark["material"] = 7' 'material is 7, expected less than 2'
broken 'model["accessors"][bark["attributes"]["WEIGHTS_1"]]["count"] = 31' 'WEIGHTS_1 has 31 elements, expected one for each of 32 vertices'
absent x_0.obj x.pc2 x.mdd x.mtl x_.mtl x_textures
