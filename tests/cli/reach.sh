#!/usr/bin/env bash
# What a file can reach that came from somewhere: nothing outside its folder, no memory and no time without bounds, and no terminal.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mkdir -p own/below
treegen --bodies 60 --seed 3 -q | treeconvert - -q -o secret.json
cp secret.json own/tree.json
ln -s ../secret.json own/link.json
scene() { echo "{\"format\": \"bough-scene\", \"version\": 1, \"trees\": [{\"file\": \"$1\"}]}" >own/scene.json; }
for file in ../secret.json link.json "$PWD/secret.json" below/../../secret.json; do
    scene "$file"
    refused 2 "which leads out of the folder of the file that names it" treesim own/scene.json --frames 2 -o x.jsonl
    refused 2 "which leads out of the folder of the file that names it" treeprofile stages own/scene.json --frames 4
    absent x.jsonl
    expect 0 treesim own/scene.json --frames 2 --outside -o x.jsonl
    rm x.jsonl
done
scene ./tree.json
expect 0 treesim own/scene.json --frames 2
(cd own && treesim scene.json --frames 2 && treesim - --frames 2 <scene.json) >out || fail "a tree beside the scene"

# A line's buffer: a file beside it, and one that is not.
python3 - <<'END'
import json, struct
points = [(0, 0, 0), (0, 1, 0), (0, 2, 0.1)]
open("points.bin", "wb").write(b"".join(struct.pack("<3f", *p) for p in points))
for name, uri in {"out": "../points.bin", "in": "points.bin"}.items():
    json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
               "meshes": [{"primitives": [{"mode": 3, "attributes": {"POSITION": 0}}]}],
               "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 2, 0.1]}],
               "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": uri}]}, open(f"own/{name}.gltf", "w"))
END
cp points.bin own/
refused 2 "leads out of the folder" treeconvert own/out.gltf -o x.json
absent x.json
expect 0 treeconvert own/out.gltf --outside -o out.json
expect 0 treeconvert own/in.gltf -o in.json

# What reading a model may take: named where it bites, whatever sets it. (A sanitizer's own memory is no matter of limits.)
python3 - >large.obj <<'END'
n = 150
for i in range(n):
    for j in range(n):
        print(f"v {i} {j} {i * j % 7}")
for i in range(n - 1):
    for j in range(n - 1):
        print(f"f {i * n + j + 1} {i * n + j + 2} {i * n + n + j + 1}")
END
if ! treegen --version | grep -q sanitize; then
    refused 2 "needs more memory than the 1 MB it may take (--reader-memory)" treegen --envelope large.obj --reader-memory 1 -o x.json
    code=0
    (ulimit -v 300000 && exec treegen --envelope large.obj -o x.json) >out 2>err </dev/null || code=$?
    [[ $code -eq 0 ]] || fail "exit $code under a ulimit -v that is enough: $(cat err)"
    rm -f x.json
fi
refused 1 "--reader-memory: is '0', expected a whole number from 1" treegen --envelope large.obj --reader-memory 0
refused 1 "--reader-seconds: is '0.5', expected a whole number" treesim large.obj --reader-seconds 0.5
absent x.json

# What is repeated of a file or an argument moves no cursor and is valid UTF-8.
printf '{"format": "bough-tree", "version": 1, "\033[2J\xff": 1}' >"$(printf 'odd\033]0;x\007\xfe.json')"
refused 2 "odd" treesim "$(printf 'odd\033]0;x\007\xfe.json')" --frames 2
! LC_ALL=C grep -q $'[\x01-\x09\x0b-\x1f\x7f]' err && iconv -f UTF-8 -t UTF-8 <err >/dev/null || fail "stderr: $(od -c err | head)"
