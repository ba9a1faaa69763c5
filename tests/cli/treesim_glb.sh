#!/usr/bin/env bash
# treesim writes one animated mesh.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json

# One animated mesh: whole, from stdout the same bytes, with what merging and leaving out keys cost.
cat >glb.py <<'END'
import json, struct, sys
data = sys.stdin.buffer.read()
magic, version, size, length = struct.unpack("<4sIII", data[:16])
assert magic == b"glTF" and version == 2 and size == len(data), (magic, version, size, len(data))
doc = json.loads(data[20:20 + length])
channels = doc.get("animations", [{"channels": []}])[0]["channels"]
times = [doc["accessors"][s["input"]] for a in doc.get("animations", []) for s in a["samplers"]]
print(len(doc["skins"][0]["joints"]), len(channels), sum(t["count"] for t in times),
      max([round(t["max"][0], 4) for t in times], default="none"), "treesim" in doc["asset"]["extras"]["source"])
END
bodies=$(treesim tree.json --frames 1 -o one.jsonl && head -n 1 one.jsonl | python3 -c 'import json, sys; print(json.load(sys.stdin)["bodies"])')
one=$(hash tree.json --wind gusty --frames 20)
[[ $(hash tree.json --wind gusty --frames 20 -q -o m.glb) == "$one" ]] || fail "an animated mesh changes the hash"
read -r joints channels keys last source < <(python3 glb.py <m.glb)
[[ $joints -eq $bodies && $channels -le $bodies && $channels -gt 1 && $last == 0.6333 && $source == True ]] ||
    fail "20 frames of $bodies bodies gave $(python3 glb.py <m.glb)"
treesim tree.json --wind gusty --frames 20 -q --no-source --format glb >stdout.glb
treesim tree.json --wind gusty --frames 20 -q --no-source -o file.glb --threads 1
same stdout.glb file.glb
[[ $(treesim tree.json --wind gusty --frames 20 --format glb --key-tolerance 0 --rustle | python3 glb.py) == \
    "$bodies $((bodies + 1)) $((20 * (bodies + 1))) 0.6333 True" ]] || fail "--rustle adds no channel of its own"
[[ $(python3 glb.py <file.glb) == *False ]] || fail "--no-source leaves the command line"
[[ $(treesim tree.json --wind gusty --frames 20 --format glb --key-tolerance 0 | python3 glb.py) == \
    "$bodies $bodies $((20 * bodies)) 0.6333 True" ]] || fail "--key-tolerance 0 leaves out keys"
[[ $(treesim tree.json --wind gusty --frames 20 --format glb --key-tolerance 5 -q | python3 glb.py | cut -d' ' -f3) -lt $keys ]] ||
    fail "a larger --key-tolerance keeps as many keys"
expect 0 treesim tree.json --wind gusty --frames 20 -o few.glb --max-joints 40
read -r joints _ < <(python3 glb.py <few.glb)
[[ $joints -le 40 && $joints -gt 20 ]] || fail "--max-joints 40 gave $joints"
grep -q "merged to $joints joints (--max-joints): .* off by .* m RMS, .* m at most" err || fail "no error of merging: $(cat err)"
[[ $(treesim tree.json --frames 1 --format glb -q --max-joints all | python3 glb.py | cut -d' ' -f1) -eq $bodies ]] ||
    fail "--max-joints all merges"
closed_stdout treesim tree.json --frames 20 --format glb
refused 4 "No such file" treesim tree.json --frames 3 -o missing/x.glb
if mkdir -p small && mount -t tmpfs -o size=16k tmpfs small 2>/dev/null; then
    code=0
    treesim tree.json --frames 20 -o small/m.glb >out 2>err || code=$?
    left=$(ls -A small)
    umount small
    [[ $code -eq 4 && -z $left ]] || fail "an animated mesh on a full disk: exit $code, left: $left"
    one_line "space" treesim
fi
