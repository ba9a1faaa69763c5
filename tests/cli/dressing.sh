#!/usr/bin/env bash
# --look, --leaf-detail, --textures: what a .glb then holds, its size, and what does not go together.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cat >shown.py <<'END'
import json, struct, sys
data = open(sys.argv[1], "rb").read()
(length,) = struct.unpack_from("<I", data, 12)
document = json.loads(data[20 : 20 + length])
binary = data[28 + length :]
parts = {}
for mesh in document["meshes"]:
    for primitive in mesh["primitives"]:
        parts[document["materials"][primitive["material"]]["name"]] = document["accessors"][primitive["attributes"]["POSITION"]]["count"]
sizes = []
for image in document.get("images", []):
    view = document["bufferViews"][image["bufferView"]]
    png = binary[view.get("byteOffset", 0) :][: view["byteLength"]]
    assert image["mimeType"] == "image/png" and png[:8] == b"\x89PNG\r\n\x1a\n", image
    sizes.append(struct.unpack_from(">II", png, 16))
masks = [m["name"] for m in document["materials"] if m.get("alphaMode") == "MASK"]
print(len(data), parts.get("leaf", 0), parts["bark"], " ".join(f"{w}x{h}" for w, h in sizes), "mask:" + ",".join(masks))
END

# 5 000 bodies in leaf with pictures of 1024 are at most 6 MB; each leaf is a few corners.
for species in maple pine; do
    treegen --species $species --age 12 --bodies 5000 --seed 7 --leaves -q | treeconvert -q - -o $species.json
    treesim $species.json --wind gusty --frames 20 --textures 1024 -q -o $species.glb
    read -r bytes leaf _ pictures <<<"$(python3 shown.py $species.glb)"
    [[ $bytes -le 6000000 && $leaf -gt 1000 ]] || fail "$species: $bytes bytes, $leaf corners of leaves"
    [[ $pictures == "1024x1024 512x512 1024x1024 mask:leaf" ]] || fail "$species: pictures $pictures"
done

# The motion is the same however leaves are drawn; the pictures are the same on any number of threads.
treegen --species birch --age 12 --bodies 300 --seed 7 --leaves -q | treeconvert -q - -o birch.json
for look in "" "--look none" "--leaf-detail mesh" "--textures none"; do
    # shellcheck disable=SC2086
    [[ $(hash birch.json --wind gusty --frames 5 -o look.glb $look) == "$(hash birch.json --wind gusty --frames 5)" ]] || fail "hash with $look"
done
treesim birch.json --frames 2 -q --no-source -o one.glb --threads 1
treesim birch.json --frames 2 -q --no-source -o two.glb --threads 2
same one.glb two.glb
read -r _ card bark pictures <<<"$(python3 shown.py one.glb)"
[[ $pictures == "512x512 256x256 512x512 mask:leaf" ]] || fail "pictures by default: $pictures"
treesim birch.json --frames 2 -q -o kite.glb --look none
read -r _ kite _ pictures <<<"$(python3 shown.py kite.glb)"
[[ $pictures == "mask:" && $kite -gt $card ]] || fail "--look none: $pictures, $kite corners"
treesim birch.json --frames 2 -q -o mesh.glb --leaf-detail mesh
read -r _ mesh _ pictures <<<"$(python3 shown.py mesh.glb)"
[[ $pictures == "512x512 256x256 512x512 mask:" && $mesh -gt $kite ]] || fail "--leaf-detail mesh: $pictures, $mesh corners"

# A tree that is called after no species is plain until --look names one, also a document; an OBJ has leaves by their outline.
treeconvert "$maple" -q -o young.json
treesim young.json --frames 2 -q -o young.glb
[[ $(python3 shown.py young.glb) == *" mask:" ]] || fail "a tree of no species is dressed"
treesim young.json --frames 2 -q -o young.glb --look oak --textures 256
[[ $(python3 shown.py young.glb) == *"256x256 256x256"* ]] || fail "--look oak: $(python3 shown.py young.glb)"
sed 's/"name": "oak"/"name": "mine"/' "$top/data/species/oak.json" >mine.json
treegen --params mine.json --bodies 200 --leaves -q | treeconvert -q - -o mine.tree.json
treesim mine.tree.json --frames 2 -q -o mine.glb --look mine.json
[[ $(python3 shown.py mine.glb) == *"mask:leaf" ]] || fail "--look mine.json: $(python3 shown.py mine.glb)"
treegen --species birch --age 12 --bodies 300 --seed 7 --leaves -q | treeconvert -q - -o /dev/null --mesh birch.obj --leaf-detail mesh --sides 12
[[ $(grep -c '^v ' birch.obj) -eq $((mesh + bark)) ]] || fail "the OBJ has $(grep -c '^v ' birch.obj) vertices, the .glb $((mesh + bark))"

refused 1 "no species whose leaves are known" treesim young.json --frames 2 -o young.glb --leaf-detail mesh
refused 1 "neither none, a species" treesim birch.json --frames 2 -o no.glb --look bamboo
refused 2 "leaf_outline" treesim birch.json --frames 2 -o no.glb --look <(sed 's/"leaf_outline": \[0,/"leaf_outline": [7,/' "$top/data/species/oak.json")
refused 1 "only with a mesh" treesim birch.json --frames 2 --look oak
refused 1 "--textures: only with .glb" treesim birch.json --frames 2 -o no_%d.obj --textures 256
refused 1 "only with .glb" treesim birch.json --frames 2 -o no_%d.obj --leaf-detail card
refused 1 "not with --textures none" treesim birch.json --frames 2 -o no.glb --leaf-detail card --textures none
refused 1 "not with --leaves-as instances" treesim birch.json --frames 2 -o no.glb --leaf-detail mesh --leaves-as instances
refused 1 "not with --rustle" treesim birch.json --frames 2 -o no.glb --leaf-detail mesh --rustle
absent no.glb no_0.obj

# Each tree of a scene looks as its file calls it: pictures and colours are those of the tree alone.
for species in birch oak; do
    treegen --species $species --age 6 --bodies 300 --leaves -q | treeconvert - -q -o $species.json
    expect 0 treesim $species.json --frames 1 --textures 256 -o $species.glb
done
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "oak.json"}, {"file": "birch.json", "position": [9, 0, 0]},
    {"file": "oak.json", "position": [0, 0, 9]}]}' >two.json
expect 0 treesim two.json --frames 1 --textures 256 -o two.glb
expect 0 treesim two.json --frames 1 --look oak --textures 256 -o like.glb
python3 - <<'END' || fail "a scene of an oak and a birch"
import json


def pictures(name):
    data = open(name, "rb").read()
    end = 20 + int.from_bytes(data[12:16], "little")
    g, rest = json.loads(data[20:end]), data[end + 8:]
    views = [g["bufferViews"][image["bufferView"]] for image in g["images"]]
    return [rest[v.get("byteOffset", 0):v.get("byteOffset", 0) + v["byteLength"]] for v in views]


oak, birch, two, like = (pictures(name + ".glb") for name in ("oak", "birch", "two", "like"))
assert len(oak) == 3 and not set(oak) & set(birch), "an oak's pictures are a birch's"
assert two == oak + birch, (len(two), len(oak), len(birch))
assert like == oak, "--look is not all trees' look"
END
# One of no known look among them is told of, and keeps kites; where none is known the option is refused. --look may be a pipe: it is read once.
sed 's/"name": "birch"/"name": "shrub"/' birch.json >shrub.json
sed 's/birch.json/shrub.json/' two.json >shrubs.json
expect 0 treesim shrubs.json --frames 1 --textures 256 -o shrubs.glb
grep -q "not of the tree that is called 'shrub', which is no species whose leaves are known" err || fail "nothing is said of the shrub: $(cat err)"
[[ $(python3 shown.py shrubs.glb) == *"256x256 mask:leaf" ]] || fail "shrubs.glb: $(python3 shown.py shrubs.glb)"
cp "$top/data/fixtures/meshed_tree.xml" own.xml
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "own.xml"}, {"file": "oak.json", "position": [9, 0, 0]}, {"file": "birch.json", "position": [0, 0, 9]}]}' >owned.json
expect 0 treesim owned.json --frames 1 --look <(cat "$top/data/species/oak.json") --textures 256 -o owned.glb
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "own.xml"}, {"file": "shrub.json", "position": [9, 0, 0]}]}' >unknown.json
refused 1 "no species whose leaves are known" treesim unknown.json --frames 1 --leaf-detail mesh -o no.glb
absent no.glb
