# tools/picture and tools/glb_pose, from outside: a .glb's moment, its animation, textures, and what is wrong.
source "$(dirname "$0")/common.sh"
export PATH=$top/tools:$PATH
pose=glb_pose picture=picture

# A moment of a .glb holds the joints where another program's reading of the same run has them: the ends of bodies in our OBJ frames.
expect 0 treesim "$top/data/young_maple.xml" --wind gusty --frames 7 -q -o maple.glb
expect 0 "$pose" seconds maple.glb
awk '{ exit !($1 > 0.1999999 && $1 < 0.2000001) }' out || fail "7 frames last 0.2 s, not $(cat out)"
expect 0 "$pose" at 0.1 maple.glb half.glb
expect 0 "$pose" seconds half.glb
grep -qx '0' out || fail "a moment has an animation: $(cat out)"
expect 0 "$pose" box maple.glb
[[ $(grep -c '^v ' out) -eq 8 ]] || fail "no box: $(cat out)"
expect 1 "$pose"
expect 1 "$pose" box
echo 'no model' >broken.glb
refused 2 "broken.glb: is no .glb of glTF 2.0" "$pose" box broken.glb
refused 2 "gone.glb" "$pose" box gone.glb

# A triangle of a vertex that is not there is refused, before f3d reads past the end.
python3 - <<'P'
import json, struct
data = bytearray(open("maple.glb", "rb").read())
size = struct.unpack_from("<I", data, 12)[0]
glb = json.loads(data[20:20 + size])
accessor = glb["accessors"][glb["meshes"][0]["primitives"][0]["indices"]]
at = 28 + size + glb["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
struct.pack_into({5123: "<H", 5125: "<I"}[accessor["componentType"]], data, at, 65535)
open("index.glb", "wb").write(data)
P
refused 2 "index.glb: mesh 0, primitive 0: its indices name vertex 65535, expected 0 to " "$pose" at 0 index.glb x.glb
# A node below itself is walked for ever. A file beside is not reached, which f3d would open wherever it is.
python3 - <<'P'
import json, struct
corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
def put(name, high=1, **more):
    model = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
             "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "bufferView": 0, "min": [0, 0, 0], "max": [high, high, 0]}],
             "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}], **more}
    text = json.dumps(model).encode()
    text += b" " * (-len(text) % 4)
    open(name, "wb").write(struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + 36, len(text), 0x4E4F534A) + text + struct.pack("<II", 36, 0x004E4942) + corners)
put("cycle.glb", nodes=[{"mesh": 0, "children": [0]}])
put("loose.glb", scenes=[], nodes=[{"mesh": 0, "children": [1]}, {"mesh": 0}])
put("buffer.glb", buffers=[{"byteLength": 36, "uri": "../../secret.bin"}])
put("image.glb", images=[{"uri": "secret.png"}])
put("within.glb", images=[{"uri": "data:image/png;base64,AAAA"}])
put("endless.glb", high=1e300)
put("list.glb", nodes=[[]])
P
refused 2 "cycle.glb: node 0 is reached twice, expected a tree of nodes" "$pose" box cycle.glb
refused 2 "cycle.glb: node 0 is reached twice, expected a tree of nodes" "$pose" at 0 cycle.glb x.glb
expect 0 "$pose" box loose.glb
refused 2 "buffer.glb: buffer 0 is in the file '../../secret.bin', expected all in the .glb" "$pose" at 0 buffer.glb x.glb
refused 2 "image.glb: image 0 is in the file 'secret.png', expected all in the .glb" "$pose" at 0 image.glb x.glb
expect 0 "$pose" at 0 within.glb x.glb
refused 2 "list.glb: is no glTF 2.0" "$pose" box list.glb
# A video wants ffmpeg: without it, it is said what to install.
mkdir -p without
for program in bash awk tr head dirname f3d Xvfb mogrify python3; do
    ! command -v $program >/dev/null || ln -sf "$(command -v $program)" without/
done
code=0
PATH=$PWD/without "$top/tools/picture" none.mp4 maple.glb >out 2>err || code=$?
[[ $code -eq 1 ]] && grep -q '^picture: not installed: .*ffmpeg (apt-get install .* ffmpeg ' err || fail "a video without ffmpeg: exit $code, $(cat err)"

for program in f3d xvfb-run convert; do
    command -v $program >/dev/null || { echo "picture: no $program, nothing drawn"; exit 0; }
done
colours() { # how many an image has
    convert "$1" -format '%k' info:
}
expect 0 "$picture" --size 120x160 still.png maple.glb
[[ $(colours still.png) -gt 50 ]] || fail "the picture of a .glb shows nothing"
expect 0 "$picture" --size 120x160 --time 0.2 later.png maple.glb
! cmp -s still.png later.png || fail "the picture does not move"
for kind in gif webp; do
    expect 0 "$picture" --size 60x80 --every 3 moving.$kind maple.glb
    [[ $(identify moving.$kind | wc -l) -eq 3 ]] || fail "a .$kind of 3 frames has $(identify moving.$kind | wc -l)"
done
if command -v ffmpeg >/dev/null; then
    expect 0 "$picture" --size 60x80 --every 3 moving.mp4 maple.glb
    [[ $(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 moving.mp4) == 3* ]] || fail "an .mp4 of 3 frames"
else
    echo "notice: no ffmpeg here, no .mp4 is made"
fi
# A texture of its own, red above and blue below, is drawn.
expect 0 treesim "$top/data/fixtures/meshed_tree.xml" --frames 1 -q -o meshed.glb
expect 0 "$picture" --size 120x160 meshed.png meshed.glb
[[ $(colours meshed.png) -gt 50 ]] || fail "the textured tree shows nothing"
refused 2 "index.glb: mesh 0, primitive 0: its indices name vertex" "$picture" none.png index.glb
refused 2 "has no animation" "$picture" none.gif half.glb
refused 2 "no vertices" "$picture" none.png broken.glb
# f3d ends by itself at so many joints: it is not begun.
python3 - <<'P'
import json, struct
data = open("meshed.glb", "rb").read()
size = struct.unpack_from("<I", data, 12)[0]
model = json.loads(data[20:20 + size])
model["skins"][0]["joints"] += [model["skins"][0]["joints"][0]] * 1100
text = json.dumps(model).encode()
text += b" " * (-len(text) % 4)
open("jointed.glb", "wb").write(data[:8] + struct.pack("<III", 20 + len(text) + len(data) - 20 - size, len(text), 0x4E4F534A) + text + data[20 + size:])
P
refused 2 "joints, of which f3d draws 1020 at most" "$picture" none.png jointed.glb
head -c 40 maple.glb >cut.glb
refused 2 "is no glTF 2.0" "$picture" none.png cut.glb
refused 1 "does not end in" "$picture" none.tif maple.glb
# What f3d says in colours comes without them.
refused 4 "endless.glb: f3d failed: " "$picture" none.png endless.glb
! grep -q '[[:cntrl:]]' err || fail "control characters of f3d's: $(cat -v err)"

# What an OBJ names and its mtl is in the OBJ's folder or below. (A link to it was put where its name led from the scratch folder.)
mkdir -p model/a/b/c/in model/victim victim scratch
echo theirs | tee model/victim/kept.txt >model/a/b/kept.mtl
echo mine >victim/kept.txt
ln -s ../../../../victim/kept.txt model/a/b/c/link.png
convert -size 8x8 xc:red model/a/b/c/in/red.png
named() { # MTL, TEXTURE: what the model and its materials name
    printf 'mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n' "$1" >model/a/b/c/m.obj
    printf 'newmtl m\nKd 1 1 1\nmap_Kd %s\n' "$2" >model/a/b/c/m.mtl
}
export TMPDIR=$PWD/scratch
for texture in ../../../victim/kept.txt in/../../kept.mtl "$PWD/victim/kept.txt" link.png; do
    named m.mtl "$texture"
    refused 2 "names '$texture', which leads out of the folder of the file that names it" "$picture" none.png model/a/b/c/m.obj
done
for materials in ../kept.mtl "$PWD/victim/kept.txt" link.png; do
    named "$materials" in/red.png
    refused 2 "names '$materials', which leads out of the folder of the file that names it" "$picture" none.png model/a/b/c/m.obj
done
[[ $(cat victim/kept.txt) == mine && ! -L victim/kept.txt ]] || fail "a model's texture took the place of a file"

# What the user has beside OUT stays, and nothing else does.
named m.mtl in/red.png
mkdir beside
echo mine >beside/red.png.part
expect 0 "$picture" --size 40x40 beside/red.png model/a/b/c/m.obj
[[ $(convert beside/red.png -format '%[fx:minima.g<0.1 && maxima.r>0.8]' info:) == 1 ]] || fail "the texture is not drawn"
[[ $(ls -A beside) == $'red.png\nred.png.part' && $(cat beside/red.png.part) == mine && -z $(ls -A scratch) ]] || fail "beside OUT: $(ls -A beside scratch)"
[[ $(stat -c %a beside/red.png) == "$(stat -c %a beside/red.png.part)" ]] || fail "OUT is $(stat -c %A beside/red.png)"
refused 4 "cannot be written" "$picture" --size 40x40 gone/red.png model/a/b/c/m.obj
absent none.gif none.png none.mp4
