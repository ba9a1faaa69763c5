#!/usr/bin/env bash
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --bodies 300 --seed 3 --leaves | treeconvert - -o tree.json
wrong_use treesim tree.json --frames 20
bad_input tree.json treesim

refused 1 "INPUT" treesim --frames 3
refused 1 "--frames" treesim tree.json --frames 0
refused 1 "--frames" treesim tree.json --frames 3 --seconds 1
refused 1 "--fps" treesim tree.json --fps 0
refused 1 "--fps" treesim tree.json --fps inf
refused 1 "--wind" treesim tree.json --wind typhoon
refused 2 "nowhere.json" treesim tree.json --wind ./nowhere.json
refused 1 "--solver" treesim tree.json --solver springs
refused 1 "--joint-limit" treesim tree.json --joint-limit 0
refused 1 "--joint-limit" treesim tree.json --joint-limit 181
refused 1 "--joint-limit" treesim tree.json --joint-limit 10 --solver articulated-implicit
refused 2 "joint_limit: body" treesim tree.json --joint-limit 1e-9
refused 1 "--precision" treesim tree.json --precision half
refused 1 "--gravity" treesim tree.json --gravity 1,2
refused 1 "--fields" treesim tree.json --fields pose,colour
refused 1 "--seed" treesim tree.json --seed 4
refused 1 "--sides" treesim tree.json --sides 5
refused 1 ".gltf" treesim tree.json -o x.gltf
refused 1 "--max-joints" treesim tree.json --max-joints 20
refused 1 "--key-tolerance" treesim tree.json --key-tolerance 1 -o x.json
refused 1 "--max-joints" treesim tree.json -o x.glb --max-joints 0
refused 1 "--max-joints" treesim tree.json -o x.glb --max-joints some
refused 1 "--key-tolerance" treesim tree.json -o x.glb --key-tolerance -1
refused 1 "--fields" treesim tree.json -o x.glb --fields pose
refused 1 "-o" treesim tree.json -o frames.obj
refused 1 "-o" treesim tree.json --format obj
refused 1 "--no-output" treesim tree.json --no-output -o x.json
refused 2 "state.json" treesim tree.json --resume ./state.json

# Frames: --frames N writes N, --seconds S round(S fps) + 1; a header line before them.
lines() { treesim tree.json "$@" | wc -l; }
[[ $(lines --frames 7) -eq 8 ]] || fail "--frames 7 wrote $(lines --frames 7) lines"
[[ $(lines --seconds 0.5 --fps 24) -eq 14 ]] || fail "--seconds 0.5 wrote $(lines --seconds 0.5 --fps 24) lines"
treesim tree.json --frames 2 --wind gusty | python3 -c '
import json, sys
head, *frames = [json.loads(line) for line in sys.stdin]
assert head["format"] == "bough-motion", head
assert [f["frame"] for f in frames] == [0, 1], frames
assert all(len(f["position"]) == 3 * head["bodies"] for f in frames)
assert all(len(f["rotation"]) == 4 * head["bodies"] for f in frames)' || fail "the motion is not as documented"

# Fields: only those asked for.
treesim tree.json --frames 2 --fields velocity,angles | tail -n 1 >frame
grep -q '"velocity"' frame && grep -q '"theta_dot"' frame || fail "a field is missing"
! grep -q '"position"' frame || fail "pose was not asked for"

# The hash does not depend on what is written, nor on where.
one=$(hash tree.json --wind gusty --frames 20)
[[ $(hash tree.json --wind gusty --frames 20 --no-output) == "$one" ]] || fail "output changes the hash"
[[ $(hash tree.json --wind gusty --frames 20 -q -o m.safetensors --fields pose,velocity,torque,angles) == "$one" ]] ||
    fail "fields change the hash"
[[ $(hash tree.json --wind gusty --frames 20 -o "obj/../m_%03d.obj" 2>/dev/null || true) == "" ]] || fail "a missing folder"
mkdir frames
[[ $(hash tree.json --wind gusty --frames 20 -o frames/m_%03d.obj) == "$one" ]] || fail "meshes change the hash"
[[ $(find frames -name 'm_*.obj' | wc -l) -eq 20 && -s frames/m.mtl ]] || fail "20 frames gave $(ls frames)"
[[ $(grep -c '^v ' frames/m_000.obj) -eq $(grep -c '^v ' frames/m_019.obj) ]] || fail "the topology changes"
! cmp -s frames/m_000.obj frames/m_019.obj || fail "nothing moves in a gusty wind"
for option in "--wind storm" "--seed 5" "--gravity 0,-3,0" "--precision float" "--pose rest" "--stiffness-scale 2" \
    "--damping-scale 3" "--substeps 2" "--fps 60"; do
    # shellcheck disable=SC2086
    [[ $(hash tree.json --wind gusty --frames 20 $option) != "$one" ]] || fail "$option changes nothing"
done

# Sequences keep their finished frames; a full disk ends them with a count.
if mkdir -p small && mount -t tmpfs -o size=4m tmpfs small 2>/dev/null; then
    code=0
    treesim tree.json --frames 200 -o small/m_%03d.obj >out 2>err || code=$?
    whole=$(find small -name '*.obj' | wc -l)
    left=$(find small -name '.bough-*' | wc -l)
    sizes=$(for f in small/m_*.obj; do grep -c '^f ' "$f"; done | sort -u | wc -l)
    umount small
    [[ $code -eq 4 && $left -eq 0 && $sizes -le 1 ]] || fail "a sequence on a full disk: exit $code, $left unfinished"
    one_line "after $whole frames" treesim
fi
absent x.json x.glb
