#!/usr/bin/env bash
# What a file can reach that came from somewhere: nothing outside its folder, no memory and no time without bounds, and no terminal.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mkdir -p own/below
treegen --age 12 --bodies 60 --seed 3 -q | treeconvert - -q -o secret.json
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
# Neither it nor what is made of it may replace that file.
for output in "treeconvert own/in.gltf -o own/points.bin" "treeconvert own/in.gltf -o x.json --mesh own/points.bin.obj" "treegen --import own/in.gltf -o own/points.bin" "treeprofile stages own/in.gltf --frames 4 -o own/points.bin" "treeprofile modes own/in.gltf -o own/points.bin.json"; do
    ln -sf points.bin own/points.bin.json
    ln -sf points.bin own/points.bin.obj
    refused 1 "own/points.bin" $output
    cmp points.bin own/points.bin || fail "$output has replaced the model's own file"
done
rm own/points.bin.obj own/points.bin.json

# A FIFO that a file names is not opened, and a tree's file of the name - is that file, not stdin.
mkfifo own/fifo
scene fifo
expect 2 timeout 20 treesim own/scene.json --frames 2 -o x.jsonl
one_line "is no regular file" treesim
sed 's/points.bin/fifo/' own/in.gltf >own/fifo.gltf
expect 2 timeout 20 treeconvert own/fifo.gltf -o x.json
one_line "is no regular file" treeconvert
rm own/fifo own/fifo.gltf
cp secret.json own/-
scene -
(cd own && timeout 20 treesim scene.json --frames 2 -o ../x.jsonl </dev/null) >out 2>err || fail "a tree in a file named -: $(cat err)"
rm x.jsonl own/-

# Buffers of one file hold it once, however it is spelt.
if [[ -z $sanitizers ]]; then
    head -c 20000000 /dev/zero | cat points.bin - >own/large.bin
    python3 - <<'END'
import json
gltf = json.load(open("own/in.gltf"))
gltf["buffers"] = [{"byteLength": 20000000 + k, "uri": "./" * (k % 3) + "large.bin"} for k in range(36)]
json.dump(gltf, open("own/many.gltf", "w"))
END
    code=0
    (ulimit -v 500000 && exec treeconvert own/many.gltf -q -o x.json) >out 2>err </dev/null || code=$?
    [[ $code -eq 0 ]] || fail "exit $code for buffers of one file: $(cat err)"
    rm x.json own/large.bin own/many.gltf
fi

# An OBJ's materials are no matter of ours: what it names is not opened. (A FIFO that nobody writes to would keep who opens it for ever.)
mkfifo trap
for name in trap ../trap "$PWD/trap"; do
    printf 'mtllib %s\nv 0 0 0\nv 2 0 0\nv 1 0 2\nv 1 2 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n' "$name" >own/mtllib.obj
    expect 0 timeout 60 treegen --envelope own/mtllib.obj --bodies 60 -q -o x.json
done
rm -f x.json
# A texture outside is not looked at, and it is the same to who reads the messages whether one stands there.
sed 's/File="textures.bark.TGA"/File="..\/secret.json"/; s/File="bark_normal.tga"/File="..\/none.tga"/' "$top/data/fixtures/meshed_tree.xml" >own/tree.xml
expect 0 treesim own/tree.xml --frames 1 -o x.glb
grep -q 'texture "../secret.json" not found, .*; looked for own/secret.json; own/../secret.json leads out of the folder of the file that names it; --outside lets it$' err || fail "a texture outside: $(cat err)"
grep -q 'texture "../none.tga" not found, .*; looked for own/none.tga; own/../none.tga leads out of the folder of the file that names it; --outside lets it$' err || fail "a texture that is nowhere: $(cat err)"
if [[ -z $sanitizers ]] && command -v strace >/dev/null && strace -o calls true 2>/dev/null; then
    strace -f -e trace=%file -o calls treesim own/tree.xml --settle 0 --frames 1 -q -o x.glb 2>err || fail "under strace: $(cat err)"
    scene ../secret.json
    strace -f -e trace=%file -o scene_calls treesim own/scene.json --frames 1 -q 2>err && fail "a tree outside under strace"
    strace -f -e trace=%file -o gltf_calls treeconvert own/out.gltf -q -o y.json 2>err && fail "a buffer outside under strace"
    grep -q "own/tree.xml" calls && grep -q "own/scene.json" scene_calls && grep -q "own/out.gltf" gltf_calls || fail "strace sees nothing"
    ! grep -hE '(^|[^n]/|")secret\.json|\.\./|points\.bin' calls scene_calls gltf_calls || fail "a name outside is asked for"
    rm calls scene_calls gltf_calls
    scene ./tree.json
elif [[ -z $sanitizers ]]; then
    echo "reach: SKIPPED what files are asked for: strace is not there, or may not trace"
fi
refused 2 "own/../secret.json: is no image that can be read" treesim own/tree.xml --frames 1 --outside -o x.glb
rm x.glb

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
# A model's own mesh that cannot be had for a limit is no reason to show another without a word: turning it takes more than reading its bones.
python3 - >skinned.dae <<'END'
# a COLLADA of one skinned mesh: J joints in a row, V vertices
import sys
J,V=400,10000
F=V-2
pos=" ".join(f"{(k%3)*0.1} {k*J/V:.4f} {(k%2)*0.1}" for k in range(V))
tri=" ".join(f"{k} {k+1} {k+2}" for k in range(F))
def node(j):
    inner = node(j+1) if j+1<J else ""
    y = 0 if j==0 else 1
    return f'<node id="j{j}" sid="j{j}" name="j{j}" type="JOINT"><matrix sid="transform">1 0 0 0 0 1 0 {y} 0 0 1 0 0 0 0 1</matrix>{inner}</node>'
sys.setrecursionlimit(10000)
binds=" ".join(f"1 0 0 0 0 1 0 {-j} 0 0 1 0 0 0 0 1" for j in range(J))
names=" ".join(f"j{j}" for j in range(J))
vc=" ".join("1" for _ in range(V)); v=" ".join(f"{min(J-1,k*J//V)} 0" for k in range(V))
print(f'''<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="{3*V}">{pos}</float_array><technique_common><accessor source="#pa" count="{V}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="vs"><input semantic="POSITION" source="#p"/></vertices><triangles count="{F}"><input semantic="VERTEX" source="#vs" offset="0"/><p>{tri}</p></triangles></mesh></geometry></library_geometries>
<library_controllers><controller id="c"><skin source="#g"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
<source id="n"><Name_array id="na" count="{J}">{names}</Name_array><technique_common><accessor source="#na" count="{J}" stride="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
<source id="b"><float_array id="ba" count="{16*J}">{binds}</float_array><technique_common><accessor source="#ba" count="{J}" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
<source id="w"><float_array id="wa" count="1">1</float_array><technique_common><accessor source="#wa" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
<joints><input semantic="JOINT" source="#n"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints><vertex_weights count="{V}"><input semantic="JOINT" source="#n" offset="0"/><input semantic="WEIGHT" source="#w" offset="1"/><vcount>{vc}</vcount><v>{v}</v></vertex_weights></skin></controller></library_controllers>
<library_visual_scenes><visual_scene id="s">{node(0)}<node id="m"><instance_controller url="#c"><skeleton>#j0</skeleton></instance_controller></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>''')
END
limits=(80 90 100 105 110 115 120 1000)
[[ -z $sanitizers ]] || limits=(1000) # see above
for megabytes in "${limits[@]}"; do
    treegen --import skinned.dae -q --reader-memory $megabytes -o bones.json 2>/dev/null || continue
    code=0
    rm -f skinned.glb
    treesim skinned.dae -q --frames 2 --gravity 0,0,0 --reader-memory $megabytes -o skinned.glb 2>err </dev/null || code=$?
    if [[ $code -eq 0 ]]; then
        vertices=$(python3 -c 'import json,struct;d=open("skinned.glb","rb").read();g=json.loads(d[20:20+struct.unpack("<I",d[12:16])[0]]);print(g["accessors"][g["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]["count"])')
        [[ $vertices -eq 10000 ]] || fail "$vertices vertices, skinned.dae's own mesh has 10000, with --reader-memory $megabytes"
    else
        [[ $code -eq 2 ]] || fail "exit $code with --reader-memory $megabytes"
        one_line "MB it may take (--reader-memory)" treesim
        absent skinned.glb
    fi
done
refused 1 "--reader-memory: is '0', expected a whole number from 1" treegen --envelope large.obj --reader-memory 0
refused 1 "--reader-seconds: is '0.5', expected a whole number" treesim large.obj --reader-seconds 0.5
absent x.json

# What is repeated of a file or an argument moves no cursor and is valid UTF-8.
printf '{"format": "bough-tree", "version": 1, "\033[2J\xff": 1}' >"$(printf 'odd\033]0;x\007\xfe.json')"
refused 2 "odd" treesim "$(printf 'odd\033]0;x\007\xfe.json')" --frames 2
! LC_ALL=C grep -q $'[\x01-\x09\x0b-\x1f\x7f]' err && iconv -f UTF-8 -t UTF-8 <err >/dev/null || fail "stderr: $(od -c err | head)"
