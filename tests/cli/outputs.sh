#!/usr/bin/env bash
# What goes to other programs beside .glb and OBJ frames: point caches, leaves as instances, groups for Unreal's wind,
# skeletons.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --species cherry --age 5 --season spring --bodies 600 --seed 3 -q -o splines.json
treeconvert splines.json -q -o tree.json --mesh rest.obj
run=(treesim tree.json --wind gusty --frames 9 --fps 25)

# A point cache read by its description: as many vertices as the rest mesh has, where the OBJ frames have them.
cat >cache.py <<'END'
import glob, struct, sys
data = open(sys.argv[1], "rb").read()
if sys.argv[1].endswith("mdd"):
    frames, vertices = struct.unpack(">2i", data[:8])
    times = struct.unpack(f">{frames}f", data[8 : 8 + 4 * frames])
    form, at, first = ">", 8 + 4 * frames, round(times[0] * 25)
    assert all(abs(t - (first + k) / 25) < 1e-6 for k, t in enumerate(times)), times
else:
    mark, version, vertices, start, step, frames = struct.unpack("<12siiffi", data[:32])
    assert (mark, version, step) == (b"POINTCACHE2\0", 1, 1)
    form, at, first = "<", 32, int(start)
assert len(data) == at + 12 * vertices * frames, (len(data), vertices, frames)
assert vertices == sum(line.startswith("v ") for line in open("rest.obj")), vertices
off = 0
for k in range(frames):
    found = struct.unpack(f"{form}{3 * vertices}f", data[at + 12 * vertices * k : at + 12 * vertices * (k + 1)])
    wanted = [float(x) for line in open(f"m_{first + k:03d}.obj") if line.startswith("v ") for x in line.split()[1:]]
    off = max(off, max(abs(a - b) for a, b in zip(found, wanted)))
assert off < 1e-5, off
print(frames, first)
END
"${run[@]}" -q -o m_%03d.obj
for form in mdd pc2; do
    expect 0 "${run[@]}" -o m.$form
    [[ $(python3 cache.py m.$form) == "9 0" ]] || fail "a .$form of 9 frames: $(python3 cache.py m.$form 2>&1)"
    "${run[@]}" -q --format $form >stdout.$form
    same m.$form stdout.$form
    treesim tree.json --wind gusty --frames 5 --fps 25 --no-output --save-state state.json
    treesim tree.json --wind gusty --frames 4 --fps 25 --resume state.json -q -o end.$form
    [[ $(python3 cache.py end.$form) == "4 5" ]] || fail "the rest of a .$form: $(python3 cache.py end.$form 2>&1)"
    refused 1 "takes no number" "${run[@]}" -o m_%03d.$form
    refused 1 "--fields" "${run[@]}" -o x.$form --fields pose
    refused 1 "--max-joints" "${run[@]}" -o x.$form --max-joints 20
    refused 4 "No such file" "${run[@]}" -o missing/x.$form
    closed_stdout "${run[@]}" --format $form
    absent x.$form
done
# What breaks off has a mesh of its own, which no cache of the whole holds; of several trees the mesh is named.
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}], "wind": "storm", "fracture": {"leaf": 1e-6}}' >breaks.json
refused 1 "joints break in this run" treesim breaks.json --frames 9 -o x.pc2
absent x.pc2
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}, {"file": "tree.json", "position": [9, 0, 0]}]}' >two.json
expect 0 treesim two.json --frames 2 -o two.pc2
grep -q -- "--frames 1 -o rest_%d.obj" err || fail "nothing is said of the mesh that two trees need: $(cat err)"

# Fewer digits: a smaller file, each number the nearest of so many digits; only where frames are JSON.
"${run[@]}" -q -o whole.jsonl
"${run[@]}" -q --digits 6 -o short.jsonl
"${run[@]}" -q --digits 6 --precision float -o short_float.jsonl
python3 - <<'END'
import json
whole, short = ([json.loads(line) for line in open(f)][1:] for f in ("whole.jsonl", "short.jsonl"))
for a, b in zip(whole, short, strict=True):
    for field in "position", "rotation":
        assert [float(f"{x:.6g}") for x in a[field]] == b[field], field
END
(($(wc -c <short.jsonl) * 100 < $(wc -c <whole.jsonl) * 55)) || fail "six digits take $(wc -c <short.jsonl) of $(wc -c <whole.jsonl) bytes"
refused 1 "--digits: only with frames as JSON" "${run[@]}" --digits 6 -o x.safetensors
refused 1 "--digits" "${run[@]}" --digits 0 -o x.jsonl

# Leaves as instances: smaller, fewer joints, said what is lost; the same in treeconvert.
expect 0 "${run[@]}" -o skin.glb --max-joints all
expect 0 "${run[@]}" -o leaves.glb --max-joints all --leaves-as instances
grep -q "leaves and petals are instances" err || fail "nothing is said of leaves that do not flutter: $(cat err)"
grep -aq '"extensionsRequired":\["EXT_mesh_gpu_instancing"\]' leaves.glb || fail "no instances in leaves.glb"
! grep -aq EXT_mesh skin.glb || fail "instances where none were asked for"
[[ $(wc -c <leaves.glb) -lt $(($(wc -c <skin.glb) / 2)) ]] || fail "instances save little: $(wc -c skin.glb leaves.glb)"
expect 0 treeconvert splines.json -o /dev/null --mesh rest.glb --leaves-as instances
grep -aq EXT_mesh rest.glb || fail "treeconvert wrote no instances"
refused 1 "--leaves-as" "${run[@]}" -o x.glb --leaves-as cards
refused 1 "--leaves-as" "${run[@]}" -o x_%d.obj --leaves-as instances
refused 1 "--leaves-as" treeconvert splines.json --mesh x.obj --leaves-as instances
mkdir limited
frames_limited() (
    ulimit -f 2 # KB: less than a frame, more than its materials
    exec treesim splines.json --settle 0 --frames 2 -q -o limited/x_%d.obj
)
if frames_limited 2>err; then fail "frames above the limit are written"; fi
grep -q "stopped after 0 frames" err || fail "not said where it stopped: $(cat err)"
[[ -z $(ls -A limited) ]] || fail "without a frame there is $(ls -A limited)"
treegen --age 12 --bodies 60 -q | treeconvert - -q -o bare.json
expect 0 treesim bare.json --frames 2 -o bare.glb --leaves-as instances
grep -q "no leaves" err || fail "nothing is said of a tree without leaves: $(cat err)"

# Groups for Unreal's wind: the joints' names are the .glb's, in its order.
expect 0 treeconvert splines.json -o /dev/null --mesh wind.glb --max-joints 80 --wind-groups wind.json
python3 - <<'PY' || fail "wind.json does not fit wind.glb"
import json, struct
data = open("wind.glb", "rb").read()
glb = json.loads(data[20 : 20 + struct.unpack("<I", data[12:16])[0]])
wind = json.load(open("wind.json"))
joints = [glb["nodes"][j]["name"] for j in glb["skins"][0]["joints"]]
assert [j["JointName"] for j in wind["Joints"]] == joints and len(joints) == 80
assert {j["SimulationGroupIndex"] for j in wind["Joints"]} == set(range(len(wind["SimulationGroups"])))
PY
refused 1 "--wind-groups" treeconvert splines.json --wind-groups x.json
refused 1 "--wind-groups" treeconvert splines.json --mesh x.obj --wind-groups x.json
refused 1 "same file" treeconvert splines.json -o x.json --mesh x.glb --wind-groups x.json
refused 4 "missing/x.json" treeconvert splines.json -o y.json --mesh x.glb --wind-groups missing/x.json
absent x.json y.json x.glb
expect 0 treeconvert "$top/data/fixtures/two_trunks_spines.xml" -q --split -o t_%d.json --mesh t_%d.glb --wind-groups w_%d.json
[[ -s w_0.json && -s w_1.json ]] || fail "no groups a trunk: $(ls)"
cp t_0.json t_2.json
cp t_0.json t_3.json
cp t_0.json t_03.json # of another pattern
expect 0 treeconvert "$top/data/fixtures/two_trunks_spines.xml" --split -o t_%d.json --mesh t_%d.glb
grep -q 't_%d.json: 2 trees of an earlier run stay behind the last one: t_2.json to t_3.json$' err || fail "older trunks are not told of: $(cat err)"
grep -q 't_%d.glb: ' err && fail "meshes are told of: $(cat err)"
rm t_2.json t_3.json t_03.json

# Skeletons: by the name or --format; what they lose is said; nothing is guessed when they come back as high a tree.
high() { treeconvert "$1" --strict -q -o /dev/null --stats 2>&1 | sed -n 's/^height *\([0-9.]*\).*/\1/p' | tail -n 1; }
treegen --import splines.json -q -o bare.splines.json
for name in tree.swc tree.txt; do
    expect 0 treegen --import splines.json --leaves -o $name
    grep -q "leaves and petals left out" err || fail "nothing is said of leaves that $name lacks: $(cat err)"
    expect 0 treeconvert $name --strict -o made.json
    awk -v a="$(high $name)" -v b="$(high bare.splines.json)" 'BEGIN { exit !(a > 0.95 * b && a < 1.05 * b) }' ||
        fail "$name gives a tree $(high $name) m high, not $(high bare.splines.json)"
done
treegen --import splines.json -q --no-source --format treetools >again.txt
treegen --import splines.json -q --no-source -o tree.txt
same again.txt tree.txt
closed_stdout treegen --import splines.json -q --format swc
refused 4 "No such file" treegen --import splines.json -o missing/x.swc
absent

# No output replaces what it was made from, under whatever name; splines may be written anew in their own place.
cp tree.json kept.json
cp tree.json in.json
ln -s in.json link.json
echo '{"format": "bough-wind", "version": 1, "velocity": [3, 0, 0]}' >wind.json
cp wind.json wind_kept.json
for name in in.json ./in.json link.json "$PWD/in.json"; do
    for form in jsonl json safetensors glb mdd pc2; do
        refused 1 "which INPUT reads" treesim in.json --frames 2 -o "$name" --format $form
    done
    refused 1 "which INPUT reads" treesim in.json --frames 2 --no-output --save-state "$name"
done
refused 1 "which --wind reads" treesim in.json --frames 2 --wind wind.json -o wind.json
refused 1 "which --wind reads" treesim in.json --frames 2 --wind wind.json --no-output --save-tree wind.json
treesim in.json --frames 2 --no-output --save-state state.json
refused 1 "which --resume reads" treesim in.json --frames 2 --resume state.json -o ./state.json
expect 0 treesim in.json --frames 2 --resume state.json --no-output --save-state state.json
same in.json kept.json
same wind.json wind_kept.json
cp splines.json in.json
refused 1 "which INPUT reads" treeconvert in.json -o in.json
cp "$top/data/fixtures/shuffled.swc" in.swc
refused 1 "which --import reads" treegen --import in.swc -o in.swc
refused 1 "which --import reads" treegen --import in.json -o link.json --format swc
same in.json splines.json
cp rest.obj in.obj
refused 1 "which INPUT reads" treeconvert in.obj -o x.json --mesh in.obj
same in.obj rest.obj
cp "$top/data/eztree_sprig.json" params.json
refused 1 "which --params reads" treegen --params params.json -o params.json
same params.json "$top/data/eztree_sprig.json"
cp wind_kept.json wind.json
refused 1 "which --wind reads" treeconvert splines.json --merge-below 0.1 --wind wind.json -o wind.json
# A scene's trees, each of its places, and those that a part of it leaves out.
cp kept.json in.json
cp kept.json other.json
cat >scene.json <<'END'
{"format": "bough-scene", "version": 1,
 "trees": [{"file": "in.json"}, {"file": "other.json", "position": [9, 0, 0]}]}
END
cp scene.json scene_kept.json
for name in scene.json in.json ./other.json link.json; do
    reads="which the scene reads"
    [[ $name != scene.json ]] || reads="which INPUT reads"
    refused 1 "$reads" treesim scene.json --frames 2 -o "$name" --format json
    refused 1 "$reads" treesim scene.json --frames 2 --no-output --save-state "$name"
    refused 1 "$reads" treesim scene.json --frames 2 --shard 1/2 -o "$name" --format json
    for command in stages error stability; do
        refused 1 "$reads" treeprofile $command scene.json --report "$name"
        refused 1 "$reads" treeprofile $command scene.json -o "$name"
    done
done
refused 1 "which the scene reads" treesim scene.json --frames 2 --shard 2/2 --no-output --save-tree other.json
same in.json kept.json
same other.json kept.json
same scene.json scene_kept.json
for command in stages error; do
    refused 1 "which --wind reads" treeprofile $command kept.json --wind wind.json --report wind.json
done
refused 1 "which --tree reads" treeprofile scaling --tree in.json --report ./in.json
refused 1 "which --tree reads" treeprofile scaling --tree in.json -o link.json
same in.json kept.json
same wind.json wind_kept.json
for part in 1 2; do treesim scene.json --frames 2 -q --shard $part/2 -o part$part.json; done
cp part1.json part_kept.json
refused 1 "which PART reads" treesim join part1.json part2.json -o part1.json
same part1.json part_kept.json
expect 0 treesim join part1.json part2.json -o joined.json
sed 's/, {"file": "other.json".*}\]/]/' scene.json >single.json
cp single.json single_kept.json
refused 1 "which INPUT reads" treesim single.json --frames 2 --no-output --save-tree single.json
same single.json single_kept.json
cp "$top/data/fixtures/two_trunks_spines.xml" trunk_1.json
refused 1 "which INPUT reads" treeconvert trunk_1.json --split -o trunk_%d.json
same trunk_1.json "$top/data/fixtures/two_trunks_spines.xml"
absent trunk_0.json
# Both through pipes: the same name -, not the same file.
treesim tree.json --frames 2 -q -o own.glb --max-joints all
cat own.glb | treesim tree.json --frames 2 -q --skin - --format glb >piped.glb || fail "--skin - to stdout"
absent x.json
