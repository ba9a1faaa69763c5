# The mesh that came with the tree: a SpeedTree XML's in one command, with its textures; a skinned model's; --mesh and --skin; what is refused.
. "$(dirname "$0")/common.sh" "$@"

fixture=$top/data/fixtures/meshed_tree.xml
mkdir -p art/textures
cp "$fixture" art/tree.xml
# Images of 4 by 4 pixels: TGA with an upright red row at the top, PNG, BMP.
python3 - <<'P'
import struct, zlib
def tga(name, pixel):
    open(name, "wb").write(struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, 4, 4, 24, 0x20) + b"".join(bytes(reversed(pixel(x, y))) for y in range(4) for x in range(4)))
def png(name, pixel):
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(c for x in range(4) for c in pixel(x, y)) for y in range(4))
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
def bmp(name, pixel):
    data = b"".join(bytes(reversed(pixel(x, 3 - y))) for y in range(4) for x in range(4))
    open(name, "wb").write(b"BM" + struct.pack("<IHHI", 54 + len(data), 0, 0, 54) + struct.pack("<IiiHHIIiiII", 40, 4, 4, 1, 24, 0, len(data), 0, 0, 0, 0) + data)
tga("art/textures/Bark.tga", lambda x, y: (255, 0, 0) if y == 0 else (90, 70, 50))
png("art/leaf.png", lambda x, y: (10 * x, 100 + 10 * y, 20))
bmp("art/leaf_opacity.bmp", lambda x, y: (255, 255, 255) if y < 2 else (0, 0, 0))
P
# image FILE.glb NAME: the embedded PNG's pixels, a line a row; material FILE.glb NAME: its JSON.
image() {
    python3 - "$@" <<'P'
import json, struct, sys, zlib
data = open(sys.argv[1], "rb").read()
size = struct.unpack("<I", data[12:16])[0]
glb, binary = json.loads(data[20:20 + size]), data[28 + size:]
view = glb["bufferViews"][[i for i in glb["images"] if i["name"] == sys.argv[2]][0]["bufferView"]]
png = binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
assert png[:8] == b"\x89PNG\r\n\x1a\n"
at, idat = 8, b""
while at < len(png):
    n, kind = struct.unpack(">I4s", png[at:at + 8])
    if kind == b"IHDR": width, height, depth, color = struct.unpack(">IIBB", png[at + 8:at + 18])
    if kind == b"PLTE": colors = [list(png[k:k + 3]) for k in range(at + 8, at + 8 + n, 3)]
    if kind == b"tRNS": colors = [c + [a] for c, a in zip(colors, png[at + 8:at + 8 + n])]
    if kind == b"IDAT": idat += png[at + 8:at + 8 + n]
    at += 12 + n
channels = {0: 1, 2: 3, 3: 1, 6: 4}[color]
assert depth == 8
raw, before = zlib.decompress(idat), [0] * (width * channels)
for y in range(height):
    line = raw[y * (width * channels + 1):(y + 1) * (width * channels + 1)]
    row = []
    for i, c in enumerate(line[1:]):
        a = row[i - channels] if i >= channels else 0
        b, d = before[i], before[i - channels] if i >= channels else 0
        p = a + b - d
        paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - d), 2, d))[2]
        row.append((c + [0, a, b, (a + b) // 2, paeth][line[0]]) & 255)
    before = row
    pixels = [colors[i] for i in row] if color == 3 else [row[i:i + channels] for i in range(0, len(row), channels)]
    print(" ".join(",".join(map(str, p)) for p in pixels))
P
}
json() { python3 -c 'import json,struct,sys;d=open(sys.argv[1],"rb").read();g=json.loads(d[20:20+struct.unpack("<I",d[12:16])[0]]);print(eval(sys.argv[2]))' "$1" "$2"; }

expect 0 treesim art/tree.xml --wind gusty --seconds 1 -o tree.glb
grep -q 'texture "bark_normal.tga" not found, its material does without it; looked for art/bark_normal.tga$' err || fail "the missing texture: $(cat err)"
[[ $(grep -c "not found" err) -eq 1 ]] || fail "found textures are named as missing: $(cat err)"
[[ $(json tree.glb '[i["name"] for i in g["images"]]') == "['bark', 'leaf']" ]] || fail "images: $(json tree.glb 'g["images"]')"
image tree.glb bark >bark.txt
[[ $(head -1 bark.txt) == "255,0,0,255 255,0,0,255 255,0,0,255 255,0,0,255" && $(sed -n 2p bark.txt) == "90,70,50,255 "* ]] || fail "the TGA's top is not the PNG's: $(cat bark.txt)"
image tree.glb leaf >leaf.txt
[[ $(head -1 leaf.txt) == "0,100,20,255 10,100,20,255 "* && $(sed -n 3p leaf.txt) == "0,120,20,0 "* ]] || fail "colour and opacity in one: $(cat leaf.txt)"
[[ $(json tree.glb 'g["materials"][1]["alphaMode"], g["materials"][1]["alphaCutoff"], g["materials"][1]["doubleSided"]') == "('MASK', 0.5, True)" ]] || fail "the leaf's material: $(json tree.glb 'g["materials"][1]')"
[[ $(json tree.glb 'g["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"], "normalTexture" in g["materials"][0]') == "(0.75, False)" ]] || fail "the bark's material"
# One image under other spellings is embedded once.
sed 's,File="leaf.png",File="./textures/.././leaf.png",' art/tree.xml >art/spelled.xml
sed -i 's,<Map Name="Normal" File="[^"]*"/>,<Map Name="Normal" File="./leaf.png"/><Map Name="AO" File="textures/../leaf.png"/>,' art/spelled.xml
expect 0 treesim art/spelled.xml --frames 2 -o spelled.glb
[[ $(json spelled.glb 'len(g["images"]), g["materials"][0]["normalTexture"] == g["materials"][0]["occlusionTexture"]') == "(3, True)" ]] ||
    fail "one image, spelled three ways: $(json spelled.glb 'g["images"], g["materials"][0]')"
# The top of the image, v = 0 in glTF, is where TexcoordV is 1.
[[ $(json tree.glb 'g["animations"][0]["name"], len(g["meshes"][0]["primitives"])') == "('motion', 2)" ]] || fail "one animated mesh of two materials"

# Any mesh; with a tree of one's own making from it; ours where it is asked for.
expect 0 treesim art/tree.xml --wind gusty --frames 3 -o frame_%d.obj
grep -q "^usemtl Leaf" frame_2.obj || fail "frames of the file's own mesh"
expect 0 treesim art/tree.xml --wind gusty --frames 3 -o tree.pc2
grep -q "the file's own mesh" err || fail "what a cache moves is not told: $(cat err)"
[[ $(head -c 20 tree.pc2 | od -An -t d4 -j16 -N4) -eq $(grep -c "^v " frame_0.obj) ]] || fail "a cache of other vertices than the frames have"
expect 0 treeconvert art/tree.xml --segment-length 0.2 -o own.json
expect 0 treesim own.json --skin art/tree.xml --wind gusty --frames 3 -o skin.glb
[[ $(json skin.glb 'sum(g["accessors"][p["indices"]]["count"] for p in g["meshes"][0]["primitives"])') == $(json tree.glb 'sum(g["accessors"][p["indices"]]["count"] for p in g["meshes"][0]["primitives"])') ]] || fail "--skin of SpeedTree XML shows other triangles"
expect 0 treesim own.json --skin art/tree.xml --frames 2 -o skin_%d.obj
expect 0 treesim art/tree.xml --mesh made --frames 2 --sides 5 -o made.glb
[[ $(json made.glb '"images" in g') == False ]] || fail "--mesh made"
expect 0 treesim art/tree.xml --mesh own --frames 2 --max-joints 3 -o few.glb
grep -q "bodies merged to 3 joints" err || fail "joints of the file's own mesh: $(cat err)"
treesim - --frames 2 -o pipe.glb <art/tree.xml 2>err || fail "a pipe: $(cat err)"
grep -q "shown where INPUT names it" err || fail "a pipe's mesh: $(cat err)"
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "own.json", "position": [4, 0, 2], "yaw": 30}], "wind": "breeze"}' >scene.json
expect 0 treesim scene.json --skin art/tree.xml --frames 2 -o scene.glb
# A file whose tree stands 3 m aside and 2 m above its ground: set on the ground, or left there by --keep-place, its mesh stands with it. At rest both
# show the vertices of the file that has it at the origin, there or 3 m aside and 2 m up.
python3 - <<'P'
import re
text = open("art/tree.xml").read()
for name, by in (("X", 3), ("Z", 2)):
    text = re.sub(rf'\b(Abs{name}|Start{name}|End{name})="([^"]*)"', lambda m: f'{m[1]}="{float(m[2]) + by}"', text)
    leaves = re.search(r"<LeafReferences.*?</LeafReferences>", text, re.S)[0]
    moved = re.sub(rf"<{name}>(.*?)</{name}>", lambda m: f"<{name}>" + " ".join(str(float(v) + by) for v in m[1].split()) + f"</{name}>", leaves)
    text = text.replace(leaves, moved)
text = re.sub(r'(Name="Leaves") AbsX="[^"]*" AbsY="[^"]*" AbsZ="[^"]*"', r'\1 AbsX="0" AbsY="0" AbsZ="0"', text)
open("art/aside.xml", "w").write(text)
P
expect 0 treeconvert art/aside.xml -o set.json
grep -q "its foot stood at 3, 2, " err || fail "where the foot stood is not told: $(cat err)"
expect 0 treeconvert art/aside.xml --keep-place -o kept.json
! grep -q "its foot" err || fail "--keep-place moves the tree: $(cat err)"
height() { treeconvert art/aside.xml "$@" --stats -o /dev/null 2>&1 | sed -n 's/^height  *\([0-9.]*\) m$/\1/p'; }
[[ $(height) && $(height) == "$(height --keep-place)" ]] || fail "--keep-place makes the tree $(height --keep-place) m high, not $(height)"
for tree in set kept; do expect 0 treesim "$tree.json" --skin art/aside.xml --frames 1 -o "${tree}_%d.obj"; done
python3 - <<'P' || fail "the mesh of a tree that stands aside"
vertices = lambda name: [[float(x) for x in line.split()[1:4]] for line in open(name) if line.startswith("v ")]
at, moved, kept = vertices("skin_0.obj"), vertices("set_0.obj"), vertices("kept_0.obj")
assert len(at) == len(moved) == len(kept) > 100
assert max(abs(a - b) for p, q in zip(at, moved) for a, b in zip(p, q)) < 3e-6
assert max(abs(a + s - b) for p, q in zip(at, kept) for a, s, b in zip(p, (3, 2, 0), q)) < 3e-6
P
twig=$top/data/fixtures/twig_armature.gltf
expect 0 treesim "$twig" --wind storm --frames 4 -o twig.glb
expect 0 treesim "$top/data/fixtures/lines.gltf" --frames 2 -o lines.glb

# Scenes that name such files: each tree shows its file's mesh, moved and turned as the scene says; what else stands there is made.
cp "$top/data/fixtures/two_trunks_spines.xml" art/bare.xml
cat >several.json <<'S'
{"format": "bough-scene", "version": 1, "trees": [{"file": "art/tree.xml"}, {"file": "art/bare.xml", "position": [-6, 0, 0]}, {"file": "art/tree.xml", "position": [5, 0.5, 2], "yaw": 90}]}
S
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "art/tree.xml", "position": [5, 0.5, 2], "yaw": 90}]}' >single.json
for scene in several single; do
    expect 0 treesim $scene.json --frames 1 -o ${scene}_%d.obj
    expect 0 treesim $scene.json --frames 1 -o $scene.glb
done
expect 0 treesim several.json --frames 2 -o several.pc2
grep -q "the files' own meshes" err || fail "what a cache of a scene moves is not told: $(cat err)"
expect 0 treesim single.json --wind gusty --frames 2 -o single.mdd
expect 0 treesim several.json --mesh made --frames 1 -o made_%d.obj
! grep -q "^usemtl Leaf" made_0.obj || fail "--mesh made of a scene"
[[ $(json several.glb '[i["name"] for i in g["images"]]') == "['bark', 'leaf']" ]] || fail "the images of a file that stands twice: $(json several.glb 'g["images"]')"
python3 - <<'P' || fail "the meshes of a scene's trees"
def read(name):
    vertices, used, part = [], {}, None
    for word, *rest in (line.split() for line in open(name) if line.strip()):
        if word == "v": vertices.append([float(x) for x in rest[:3]])
        if word == "usemtl": part = rest[0]
        if word == "f": used.setdefault(part, set()).update(int(c.split("/")[0]) - 1 for c in rest)
    return vertices, used
own, _ = read("skin_0.obj") # where the file has them
turned = [(5 + z, 0.5 + y, 2 - x) for x, y, z in own] # by 90 degrees about +Y, x goes to -z
single, _ = read("single_0.obj")
several, used = read("several_0.obj")
def apart(a, b): return max(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q))
assert len(single) == len(own) > 100 and apart(single, turned) < 3e-6
n = len(own)
assert apart(several[:n], own) < 3e-6 and apart(several[n:2 * n], turned) < 3e-6
assert len(several) > 2 * n and all(v[0] < -3 for v in several[2 * n:]), "the made tree stands at -6"
P

# A model's own mesh in a texture: its vertices are where those of its OBJ frames are, 1e-4 m; of fewer each is near one of these, 2e-3 m.
twig_run=("$twig" --wind storm --set stiffness_scale=0.003 --frames 4 --fps 5 --settle 0)
expect 0 treesim "${twig_run[@]}" -o bones_%d.obj
expect 0 treesim "${twig_run[@]}" -o bones_vat/ --vat-image png
most=$(($(grep -c "^v " bones_0.obj) * 2 / 3))
expect 0 treesim "${twig_run[@]}" -o fewer_vat/ --vat-image png --vat-vertices $most
grep -q "vertices are left: wood is off by" err || fail "nothing is said of fewer vertices: $(cat err)"
for name in bones fewer; do convert ${name}_vat/${name}_vat.png -depth 16 -endian LSB rgb:$name.places; done
python3 - "$most" <<'P' || fail "a model's own mesh in a texture"
import json, struct, sys
def frames_of(name):
    glb = open(f"{name}_vat/{name}.glb", "rb").read()
    size = struct.unpack_from("<I", glb, 12)[0]
    g, binary = json.loads(glb[20:20 + size]), glb[28 + size:]
    assert any("baseColorTexture" in m.get("pbrMetallicRoughness", {}) for m in g["materials"]) == bool(g.get("images")), "materials"
    rest = []
    for primitive in g["meshes"][0]["primitives"]:
        accessor = g["accessors"][primitive["attributes"]["POSITION"]]
        view = g["bufferViews"][accessor["bufferView"]]
        rest += [struct.unpack_from("<3f", binary, view.get("byteOffset", 0) + accessor.get("byteOffset", 0) + 12 * k) for k in range(accessor["count"])]
    info, raw = json.load(open(f"{name}_vat/{name}-remap_info.json"))["os-remap"], open(f"{name}.places", "rb").read()
    assert info["Frames"] == 4 and len(raw) == 6 * 4 * len(rest), (info, len(raw), len(rest))
    for f in range(4):
        row = []
        for v, p in enumerate(rest):
            b = [low + (high - low) * n / 65535 for low, high, n in zip(info["Min"], info["Max"], struct.unpack_from("<3H", raw, 6 * (f * len(rest) + v)))]
            row.append((p[0] + b[0], p[1] + b[2], p[2] - b[1]))
        yield row
def vertices(name): return [[float(x) for x in line.split()[1:4]] for line in open(name) if line.startswith("v ")]
def apart(p, q): return max(abs(a - b) for a, b in zip(p, q))
moved = 0
for f, row in enumerate(frames_of("bones")):
    true = vertices(f"bones_{f}.obj")
    assert len(row) == len(true) and max(map(apart, row, true)) < 1e-4, (f, max(map(apart, row, true)))
    moved = max(moved, max(map(apart, true, vertices("bones_0.obj"))))
assert moved > 0.05, ("nothing moves", moved)
for f, row in enumerate(frames_of("fewer")):
    true = vertices(f"bones_{f}.obj")
    assert 8 < len(row) <= int(sys.argv[1]) and max(min(apart(p, q) for q in true) for p in row) < 2e-3, f
P

# Meshes without a material stay so.
python3 - "$twig" <<'P'
import json, os, shutil, sys, urllib.parse
g = json.load(open(sys.argv[1]))
for mesh in g["meshes"]:
    for primitive in mesh["primitives"]: primitive.pop("material", None)
for key in "materials", "textures", "images", "samplers": g.pop(key, None)
json.dump(g, open("grey.gltf", "w"))
for buffer in g["buffers"]:
    name = urllib.parse.unquote(buffer["uri"])
    shutil.copy(os.path.join(os.path.dirname(sys.argv[1]), name), name)
P
expect 0 treesim grey.gltf --wind storm --frames 2 --settle 0 -o grey_vat/
[[ $(json grey_vat/grey.glb '"materials" in g or any("material" in p for p in g["meshes"][0]["primitives"])') == False ]] || fail "a material of none: $(json grey_vat/grey.glb 'g')"

# Refused: what the mesh leaves nothing to decide, other trees, broken files and images.
refused 1 "--sides: only with --mesh made" treesim art/tree.xml --frames 2 --sides 5 -o x.glb
refused 1 "--leaves-as: only with --mesh made" treesim art/tree.xml --frames 2 --leaves-as instances -o x.glb
refused 1 "--rustle: only with --mesh made" treesim art/tree.xml --wind gusty --frames 2 --rustle -o x.glb
refused 1 "--mesh: only with a mesh" treesim art/tree.xml --frames 2 --mesh own
refused 1 "--mesh: not with --skin" treesim own.json --skin art/tree.xml --frames 2 --mesh made -o x.glb
refused 1 "has no mesh that could be moved" treesim "$maple" --frames 2 --mesh own -o x.glb
refused 2 "has no mesh of its own" treesim own.json --skin "$maple" --frames 2 -o x.glb
treegen --age 12 --bodies 300 -q | treeconvert - -q -o other.json
refused 2 "expected the model that the tree was made from" treesim other.json --skin art/tree.xml --frames 2 -o x.glb
refused 1 "would replace" treesim own.json --skin art/tree.xml --frames 2 --save-tree art/tree.xml -o x.glb
broken() { # SED TEXT
    sed "$1" art/tree.xml >art/broken.xml
    cmp -s art/tree.xml art/broken.xml && fail "nothing changed by $1"
    refused 2 "$2" treesim art/broken.xml --frames 2 -o x.glb
    grep -q "broken.xml:[0-9]*: " err || fail "no line in: $(cat err)"
}
broken 's/<PointIndices>0 1/<PointIndices>0 900/' 'PointIndices holds "900"'
broken 's/<VertexIndices>0 1/<VertexIndices>0 nan/' 'VertexIndices holds "nan"'
broken 's/Triangles Material="1"/Triangles Material="9"/' 'Material 9 does not exist'
broken 's/<BoneID>0 0/<BoneID>0 12/' 'BoneID 12 does not exist'
broken 's/<NormalX>1/<NormalX>nan/' 'NormalX holds "nan"'
broken 's/<QuadIndices>0/<QuadIndices>4/' 'QuadIndices holds "4"'
broken 's/<MeshID>1/<MeshID>9/' 'MeshID 9 does not exist, expected the ID of a Mesh or -1'
broken 's/LeafReferences Material="2"/LeafReferences Material="9"/' 'LeafReferences> Material 9 does not exist'
for far in 1e200 1e38; do
    broken "/<Points/,/<\/X>/s/<X>[^ ]*/<X>$far/" "Points> X holds ${far/e/e+}, expected points near the skeleton"
done
sed 's/<PointIndices>[^<]*</<PointIndices></; s/<VertexIndices>[^<]*</<VertexIndices></' art/tree.xml >art/bare.xml
refused 2 "bare.xml: has no mesh of its own (no triangles in its objects), expected one to be moved; --mesh made shows one" treesim art/bare.xml --frames 2 -o x.glb
expect 0 treesim art/bare.xml --frames 2 --mesh made -o bare.glb
mkdir -p folder/bark_normal.tga
cp art/tree.xml folder
expect 0 treesim folder/tree.xml --frames 2 -o folder.glb
grep -q 'texture "bark_normal.tga" is a folder, folder/bark_normal.tga, expected an image; its material does without it$' err || fail "a texture that is a folder: $(cat err)"
head -c 4000 art/tree.xml >art/half.xml
refused 2 "half.xml:" treesim art/half.xml --frames 2 -o x.glb
head -c 40 art/leaf.png >half.png
for bad in /dev/null half.png art/tree.xml; do
    cp art/leaf.png good.png
    cat $bad >art/leaf.png
    refused 2 "is no image that can be read" treesim art/tree.xml --frames 2 -o x.glb
    grep -q "art/leaf.png: .*art/tree.xml:11 names it" err || fail "where the image is named: $(cat err)"
    cp good.png art/leaf.png
done
absent x.glb x.usda x_vat

# A kind of image that games use and that is not read: the one of that name beside it that is read, or none.
mkdir games
cp -r art/* games
for kind in 'DDS \x7c' '\xABKTX 11' 'RIFF\0\0\0\0WEBPVP8 ' '\x76\x2F\x31\x01\x02'; do
    printf "$kind" >games/leaf.dds
    head -c 200 /dev/zero >>games/leaf.dds
    sed 's/leaf\.png/leaf.dds/' art/tree.xml >games/tree.xml
    cp art/leaf.png games/leaf.png
    expect 0 treesim games/tree.xml --frames 1 -o converted.glb
    grep -q "texture \"leaf.dds\" is a .* image, which is not read: games/leaf.png is taken" err || fail "beside it: $(cat err)"
    [[ $(grep -c leaf.dds err) == 1 ]] || fail "said more than once: $(cat err)"
    cp games/leaf.dds games/leaf.png # whose ending says otherwise
    cp art/leaf_opacity.bmp games/leaf.bmp
    expect 0 treesim games/tree.xml --frames 1 -o x.glb
    grep -q "not read: games/leaf.bmp is taken" err || fail "behind a .png that is none: $(cat err)"
    rm x.glb games/leaf.bmp
    rm games/leaf.png
    expect 0 treesim games/tree.xml --frames 1 -o bare.glb
    grep -q "is not read: its material does without it" err || fail "none beside it: $(cat err)"
    for pair in converted:leaf bare:leaf_opacity; do
        [[ $(json ${pair%:*}.glb '[i["name"] for i in g["images"]]') == "['bark', '${pair#*:}']" ]] || fail "$pair: $(json ${pair%:*}.glb 'g["images"]')"
    done
done

# A name of Windows whose folder has a point in it, and that has no ending.
mkdir -p games/v1.2
cp games/leaf.dds games/v1.2/leaf
cp art/leaf.png games/v1.png
cp art/leaf.png games/v1.2/leaf.png
sed 's/leaf\.png/v1.2\\leaf/' art/tree.xml >games/tree.xml
expect 0 treesim games/tree.xml --frames 1 -o x.glb
grep -q "not read: games/v1.2/leaf.png is taken" err || fail "a name of Windows: $(cat err)"
rm x.glb

# OBJ frames: the .mtl names the file's images, which stand in a folder of their own, byte for byte what the .glb holds.
expect 0 treesim art/tree.xml --frames 1 -o textured_%d.obj
expect 0 treesim art/tree.xml --frames 1 -o textured.glb
python3 - <<'P'
import json, struct
data = open("textured.glb", "rb").read()
size = struct.unpack("<I", data[12:16])[0]
glb, binary = json.loads(data[20:20 + size]), data[28 + size:]
def bytes_of(texture):
    view = glb["bufferViews"][glb["images"][glb["textures"][texture["index"]]["source"]]["bufferView"]]
    return binary[view.get("byteOffset", 0):][:view["byteLength"]]
lines, part = {}, None
for word, *rest in (line.split() for line in open("textured.mtl") if line.strip()):
    if word == "newmtl": part = lines.setdefault(rest[0], {})
    else: part[word] = rest
used = {line.split()[1] for line in open("textured_0.obj") if line.startswith("usemtl")}
seen = 0
for material in glb["materials"]:
    if material["name"] not in used: continue
    color = material["pbrMetallicRoughness"].get("baseColorTexture")
    named = lines[material["name"]].get("map_Kd")
    assert (color is None) == (named is None), material["name"]
    if color is None: continue
    seen += 1
    assert open(named[0], "rb").read() == bytes_of(color), named
    assert ("map_d" in lines[material["name"]]) == (material.get("alphaMode") == "MASK"), material["name"]
assert seen >= 2, seen
P

# The images that stand beside an output replace none that the model has, nor does the output itself.
mkdir -p own_images/m_textures own_images/frames
cp art/leaf.png own_images/m_textures/leaf.png
cp own_images/m_textures/leaf.png leaf_kept.png
sed 's/File="leaf.png"/File="m_textures\/leaf.png"/' art/tree.xml >own_images/m.xml
cp art/leaf_opacity.bmp own_images/
for output in own_images/m.usda own_images/m_%d.obj own_images/frames/../m.usda; do
    refused 1 "m_textures/leaf.png', the file of the model" treesim own_images/m.xml --frames 2 -o $output
    absent own_images/m.usda own_images/m_0.obj own_images/m_.mtl own_images/m.mtl
    cmp own_images/m_textures/leaf.png leaf_kept.png || fail "$output has replaced an image of the model"
done
refused 1 "which the model reads" treesim own_images/m.xml --frames 2 -o own_images/m_textures/leaf.png --format glb
cmp own_images/m_textures/leaf.png leaf_kept.png || fail "-o has replaced an image of the model"
mkdir own_images/new_textures
for option in --save-state --save-tree; do # nor one that the run writes
    refused 1 "leaf.png', the file of $option" treesim own_images/m.xml --frames 2 -o own_images/new.usda $option own_images/new_textures/leaf.png
    absent own_images/new_textures/leaf.png own_images/new.usda
done
expect 0 treesim own_images/m.xml --frames 2 -o own_images/other.usda
expect 0 treesim own_images/m.xml --frames 2 -o own_images/other.usda # over its own, again
