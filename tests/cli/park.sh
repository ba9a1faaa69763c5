#!/usr/bin/env bash
# park.sh: many trees: places, starts, parts (--shard, treesim join), walkers.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

for k in 1 2 3; do
    treegen --species apple --age 8 --bodies $((300 * k)) --seed "$k" --leaves -q | treeconvert - -q -o "t$k.json"
done
cat >park.json <<'END'
{"format": "bough-scene", "version": 1,
 "trees": [{"file": "t1.json"},
           {"file": "t2.json", "places": [{"position": [6, 0, 0], "yaw": 30, "start": 2}, {"position": [6, 0, 7]}]},
           {"file": "t3.json", "position": [0, 0, 7], "start": 5}],
 "wind": {"velocity": [8, 0, 0], "turbulence": 0.2, "gust_factor": 1.6},
 "pulls": [{"on": {"tree": 2, "branch": 0, "at": 0.9}, "time": [0, 1], "force": [[0, 0, 0], [40, 0, 0]]}],
 "root_motion": [{"tree": 3, "time": [0, 1, 2], "position": [[0, 0, 0], [0.2, 0, 0], [0, 0, 0]]}]}
END

# One tree on several places is as many trees.
expect 0 treesim park.json --seconds 1 --no-output --report hash -q
whole=$(cat err)
python3 - <<'END'
import json
scene = json.load(open("park.json"))
entry = scene["trees"].pop(1)
scene["trees"][1:1] = [{"file": entry["file"], **place} for place in entry["places"]]
json.dump(scene, open("spelled.json", "w"))
END
expect 0 treesim spelled.json --seconds 1 --no-output --report hash -q
[[ $(cat err) == "$whole" ]] || fail "places are not trees: $(cat err), $whole"
# A start is felt, and by its own tree alone.
python3 - <<'END'
import json
scene = json.load(open("spelled.json"))
for tree in scene["trees"]: tree.pop("start", None)
json.dump(scene, open("together.json", "w"))
END
expect 0 treesim together.json --seconds 1 --no-output --report hash -q
[[ $(cat err) != "$whole" ]] || fail "starts change nothing"
expect 0 treesim park.json --seconds 0.2 --report plan --no-output
grep -q "starts, 3 clocks" err || fail "the plan does not name the starts: $(grep lanes err)"
# Its places share constants, in float whatever their yaws; trees of their own do not, nor what may break.
rows() { grep '^constants of rows in lanes ' err; }
expect 0 treesim park.json --frames 2 --precision float --report plan --no-output
rows | grep -Eq '^constants of rows in lanes [0-9]+ bytes, [0-9]+ rows: shared by instances, [0-9]+ kept$' || fail "places share nothing: $(rows)"
read -r all kept < <(rows | sed -E 's/.* ([0-9]+) rows: .* ([0-9]+) kept/\1 \2/')
((kept < all)) || fail "$kept rows are kept of $all"
sed 's/"trees"/"fracture": {"leaf": 1}, "trees"/' park.json >breaks.json
expect 0 treesim breaks.json --frames 2 --precision float --report plan --no-output
rows | grep -q ' rows: none shared, /fracture$' || fail "shared, but may break: $(rows)"
expect 0 treesim t1.json --frames 2 --report plan --no-output
rows | grep -q ' rows: none shared, one tree$' || fail "one tree shares: $(rows)"

# Parts: whatever their number, precision and solver, the whole's motion and hash.
python3 - <<'END'
import json
scene = json.load(open("park.json"))
del scene["root_motion"]
json.dump(scene, open("still.json", "w"))
END
# Some trees have foliage, and of those some have clumps that face one way: laws that a part would not choose by its own trees.
treegen --species oak --bodies 400 --leaves -q | treeconvert - -q -o faced.json
treegen --species apple --age 8 --bodies 400 --seed 5 -q | treeconvert - -q -o bare.json
python3 - <<'END'
import json
tree = json.load(open("faced.json"))
assert any(f > 0 for f in tree.pop("leaf_facing")), "no clump of the oak has a face"
json.dump(tree, open("faceless.json", "w"))
json.dump({"format": "bough-scene", "version": 1, "wind": {"velocity": [16, 0, 0], "turbulence": 0.2, "gust_factor": 1.6}, "trees": [
    {"file": name, "position": [40 * k, 0, 0]} for k, name in enumerate(["faceless.json", "bare.json", "faced.json"])]},
    open("mixed.json", "w"))
END
for way in "3 double coupled mixed" "3 float coupled mixed" "2 double analytic mixed" "3 double coupled mixed off" "2 double coupled park" "3 float coupled park" "4 double analytic park" "2 float analytic still" "3 double coupled still"; do
    read -r parts precision solver scene simd <<<"$way"
    options=(--seconds 1 --precision "$precision" --solver "$solver" --simd "${simd:-auto}" -q)
    expect 0 treesim "$scene.json" "${options[@]}" --report hash -o whole.safetensors
    cp err hash
    for ((i = 1; i <= parts; ++i)); do
        expect 0 treesim "$scene.json" "${options[@]}" --shard "$i/$parts" -o "part$i.safetensors" --save-state "state$i.json"
    done
    # In any order.
    mapfile -t motions < <(ls -r part?.safetensors)
    expect 0 treesim join "${motions[@]}" -o joined.safetensors
    expect 0 treesim join state?.json --report hash
    same err hash
    python3 - <<'END'
import json, struct
def arrays(name):
    with open(name, "rb") as file:
        size = struct.unpack("<Q", file.read(8))[0]
        header = json.loads(file.read(size))
        data = file.read()
    meta = header.pop("__metadata__")
    return ({key: (value["shape"], data[slice(*value["data_offsets"])]) for key, value in header.items()},
            {key: value for key, value in meta.items() if key != "source"})
assert arrays("whole.safetensors") == arrays("joined.safetensors"), "the parts' motions are not the whole's"
END
    rm -f part?.safetensors state?.json
done

# As lines, and from a part that was cut.
expect 0 treesim park.json --frames 5 -q -o whole.jsonl
for i in 1 2; do expect 0 treesim park.json --frames 5 -q --shard $i/2 -o part$i.jsonl; done
expect 0 treesim join part1.jsonl part2.jsonl -o joined.jsonl
same <(tail -n +2 whole.jsonl) <(tail -n +2 joined.jsonl)
for i in 1 2; do
    expect 0 treesim park.json --frames 3 -q --shard $i/2 --no-output --save-state half$i.json
    expect 0 treesim park.json --frames 2 -q --shard $i/2 --no-output --resume half$i.json --save-state end$i.json
done
expect 0 treesim join end1.json end2.json --report hash
expect 0 treesim park.json --frames 5 -q --no-output --report hash
cp err hash
expect 0 treesim join end2.json end1.json --report hash
same err hash
# Each tree finds its own sag, with its neighbours or without.
snowy=(park.json --frames 5 -q --set pose=settled --set 'load={"branch":2,"leaf":0.05}')
for i in 1 2; do expect 0 treesim "${snowy[@]}" --shard $i/2 --no-output --save-state end$i.json; done
expect 0 treesim "${snowy[@]}" --no-output --report hash
cp err hash
expect 0 treesim join end1.json end2.json --report hash
same err hash
for i in 1 2; do expect 0 treesim park.json --frames 5 -q --shard $i/2 --no-output --save-state end$i.json; done
refused 2 "/theta: is" treesim park.json --frames 2 --shard 2/2 --no-output --resume half1.json

# What is wrong is said.
refused 1 "expected i/n" treesim park.json --shard 3/2
refused 1 "expected i/n" treesim park.json --shard two
refused 1 "the scene has 4 trees" treesim park.json --shard 1/5
refused 1 "not with --shard" treesim park.json --shard 1/2 --sleep 1e-4
refused 1 "only with a scene" treesim t1.json --shard 1/2
refused 1 "part 2 of 2 is missing" treesim join part1.jsonl -o x.jsonl
refused 2 "which part1.jsonl is already" treesim join part1.jsonl part1.jsonl -o x.jsonl
refused 1 "--seconds" treesim join part1.jsonl part2.jsonl --seconds 3
refused 1 "a motion has none" treesim join part1.jsonl part2.jsonl --report hash -o x.jsonl
refused 1 "resumed part by part" treesim join end1.json end2.json -o x.json
refused 2 "expected motions or states alone" treesim join part1.jsonl end2.json -o x.jsonl
head -n 3 part2.jsonl >short.jsonl
refused 2 "has only 2 frames" treesim join part1.jsonl short.jsonl -o x.jsonl
expect 0 treesim park.json --frames 5 --fps 60 -q --shard 2/2 -o other.jsonl
refused 2 "/fps" treesim join part1.jsonl other.jsonl -o x.jsonl
expect 0 treesim park.json --frames 5 -q --shard 2/2 --wind storm -o other.jsonl --save-state other.json
refused 2 "/whole" treesim join part1.jsonl other.jsonl -o x.jsonl
refused 2 "/whole" treesim join end1.json other.json --report hash
refused 2 "/parts" treesim join whole.jsonl -o x.jsonl
refused 1 "files" treesim join part1.jsonl part2.jsonl part1.jsonl -o x.jsonl
sed 's/"file": "t3.json"/"file": "t3.json", "yaw": 5/' park.json >turned.json
refused 2 "/whole" treesim turned.json --frames 2 --shard 1/2 --no-output --resume half1.json
refused 1 "--save-tree" treesim t1.json --frames 2 -o same.json --save-tree same.json
expect 0 treesim join part1.jsonl part2.jsonl -o bare.jsonl --no-source
absent x.jsonl x.json
python3 - <<'END'
import json
scene = json.load(open("park.json"))
scene["trees"][1]["yaw"] = 3
json.dump(scene, open("both.json", "w"))
del scene["trees"][1]["yaw"]
scene["trees"][1]["places"] = []
json.dump(scene, open("none.json", "w"))
END
refused 2 "/trees/1/yaw" treesim both.json
refused 2 "/trees/1/places" treesim none.json

# A walker: from trunk to trunk, and the same run whatever the threads, cut or whole.
cat >walk.json <<'END'
{"format": "bough-scene", "version": 1, "trees": [{"file": "t1.json"}, {"file": "t1.json", "position": [2, 0, 0]}],
 "walkers": [{"mass": 1.5, "stops": [{"on": {"branch": 0, "at": 0.1}, "time": 0}, {"on": {"branch": 0, "at": 0.9}, "time": 0.8},
                                     {"on": {"tree": 1, "branch": 0, "at": 0.8}, "time": 1.6}]}]}
END
expect 0 treesim walk.json --seconds 2 --report hash --threads 1 -q -o walk.jsonl
cp err hash
expect 0 treesim walk.json --seconds 2 --report hash --threads 2 -q --no-output
same err hash
expect 0 treesim walk.json --seconds 1 --save-state walk.state.json -q --no-output
expect 0 treesim walk.json --seconds 1 --resume walk.state.json --report hash -q --no-output
same err hash
grep -q '"leapt"' walk.jsonl || fail "the leap is no event"
grep -q '"landed"' walk.jsonl || fail "the landing is no event"
expect 0 treesim walk.json --seconds 1 -q -o walk.glb
refused 1 "not with the scene's /walkers" treesim walk.json --shard 1/2
sed 's/"time": 1.6/"time": 0.9/' walk.json >hasty.json
refused 2 "/walkers/0/stops/2/time" treesim hasty.json --seconds 1
sed 's/"time": 0.8/"time": 0/' walk.json >late.json
refused 2 "/walkers/0/stops/1/time" treesim late.json --seconds 1
sed 's/"branch": 0, "at": 0.1/"level": 0/' walk.json >many.json
refused 2 "/walkers/0/stops/0/on" treesim many.json --seconds 1

# The scenes that come with bough run as they are.
for scene in "$top"/data/scenes/*.json; do
    expect 0 treesim "$scene" --frames 4 --no-output -q
done
