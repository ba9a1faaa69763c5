#!/usr/bin/env bash
# bough.py: what it reads and runs is what the tools wrote and ran (python.py); the example's numbers and picture.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

python=$(python_with_numpy)
[[ -n $python ]] || { echo "SKIPPED: no Python with numpy (python3-numpy)"; exit 77; }
[[ -z $sanitizers ]] || { echo "SKIPPED: Python is not built with the sanitizers"; exit 77; }
export BOUGH_LIBRARY=$build/formats/libbough_files.so PYTHONPATH=$top/formats/c PYTHONDONTWRITEBYTECODE=1

treegen --species birch --bodies 300 --seed 2 --leaves | treeconvert - -o birch.json
treesim birch.json --wind gusty --frames 15 --fields pose,velocity -o birch.jsonl --save-state birch.state
echo '{"format": "bough-scene", "version": 1, "wind": "storm", "material": {"E": 6e9},
    "trees": [{"file": "birch.json"}, {"file": "birch.json", "position": [9, 0, 2], "yaw": 40}]}' >park.json
hash park.json --frames 15 --precision float >park.hash
treesim birch.json --wind storm --frames 1 --settle 0 --report plan 2>storm.plan >/dev/null
# Other programs' trees, as treesim moves what treeconvert makes of them.
mkdir imports
cp "$maple" "$top"/data/fixtures/{archi_small.csv,simpleforest_small.csv,shuffled.swc,shrub.mtg,lines.obj,lines.gltf,eztree_list.json,bare_bones.xml,twig_armature.gltf,twig_bark.bin,moved_armature.dae,twig_meshopt.glb} imports
for file in imports/*; do
    case $file in *.bin | *.dae | *meshopt*) continue ;; esac
    treeconvert "$file" -q >converted.json || fail "treeconvert $file"
    echo "$file $(hash converted.json --wind gusty --frames 6 | cut -d' ' -f2)" >>imports.hashes
done
"$python" -W error "$top/tests/cli/python.py" >out 2>err || fail "python.py: $(tail -n 5 err)"
[[ ! -s out && ! -s err ]] || fail "python.py says: $(cat out err)"
[[ $(treesim --version | sed -n 1p) == "treesim $("$python" -c 'import bough; print(bough.__version__)') (bough)" ]] || fail "bough.py is of another version than treesim"
[[ $(hash saved.safetensors --wind gusty --frames 15) == "$(hash birch.json --wind gusty --frames 15)" ]] || fail "the tree that bough.py saved moves otherwise"

# Where the library for other programs' trees is not beside, its own documents are read all the same.
mkdir alone
cp "$build/formats/libbough_files.so" alone/
BOUGH_LIBRARY=$PWD/alone/libbough_files.so "$python" -W error - <<'END' >out 2>&1 || fail "without libbough_imports: $(cat out)"
import bough
assert len(bough.read_tree("birch.json")) > 200
try:
    bough.read_tree("imports/young_maple.xml")
except bough.InputError as error:
    assert "young_maple.xml" in str(error) and "are read by libbough_imports, which cannot be loaded: " in str(error), error
else:
    raise AssertionError("it is read")
END

# The example's tip swings at the frequency that a solve of the tree's modes gives; its resolution is 0.05 Hz, of which it shows eighths.
if command -v gnuplot >/dev/null; then
    "$python" "$top/formats/c/examples/tip.py" pine tip.svg >said 2>err || fail "tip.py: $(tail -n 3 err)"
    treegen --species pine --bodies 1000 --seed 1 | treeconvert - | treeprofile modes - --modes 2 >modes 2>err || fail "treeprofile modes: $(cat err)"
    swings=$(sed -n 's/^pine: [0-9]* bodies, [0-9.]* mm, strongest at \([0-9.]*\) Hz$/\1/p' said)
    lowest=$(awk '$1 == 1 { print $2 }' modes)
    awk -v a="$swings" -v b="$lowest" 'BEGIN { exit !(a > 0 && b > 0 && a - b < 0.02 && b - a < 0.02) }' ||
        fail "the tip swings at '$swings' Hz ($(cat said)), its first mode at '$lowest' Hz"
    grep -q '</svg>' tip.svg || fail "tip.py made no picture"
fi
