#!/usr/bin/env bash
# tools/figures: the paper's figures that are small in the paper too run at its sizes, the others small; a run that fails is told by the exit code.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mkdir -p project/data project/tools
cp "$top/tools/figures" project/tools/
cp -r "$top/data/scenes" project/data/
figures() { BOUGH_BIN=$bin project/tools/figures "$@"; }

# bodies FIGURE LOW HIGH: the line of the figure says that it stayed finite, and its bodies are as many as the paper's (or the scene's) within 4 %.
bodies() {
    awk -v figure="$1" -v low="$2" -v high="$3" '$1 == figure { seen = 1; good = $7 == "yes" && $3 >= low && $3 <= high && length($8) == 16 }
        END { exit !(seen && good) }' out || fail "figure $1: $(cat out err)"
}

expect 0 figures --frames 10 7 12 15
bodies 7 1440 1560
bodies 12 285 285
bodies 15 590 590
expect 0 figures --small --frames 3 1 3 5 8 9 10 13
for figure in 1 3 5 8 9 10 13; do bodies "$figure" 200 5000; done

# A scene without its tree.
rm project/data/scenes/trees/ball_tree.safetensors
expect 1 figures --frames 3 12 15
bodies 12 285 285
grep -q 'ball_tree.safetensors' err || fail "figure 15 does not say which tree is missing: $(cat err)"
refused 1 "unknown argument '4'" figures 4
