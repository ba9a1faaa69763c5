#!/usr/bin/env bash
# One hash for any number of threads, and for a run cut in two.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --bodies 6000 --seed 5 --leaves --fruit | treeconvert - -o tree.json
hash() { treesim tree.json --wind gusty --no-output --hash "$@" 2>&1 | grep '^hash '; }
for run in "analytic --precision double" "analytic --precision float" "coupled --precision double" \
    "coupled --precision float" "coupled --scheme P34" "coupled --scheme midpoint"; do
    read -ra by <<<"--solver $run"
    one=$(hash "${by[@]}" --threads 1 --frames 12)
    for threads in 2 3 8 15; do
        [[ $(hash "${by[@]}" --threads $threads --frames 12) == "$one" ]] ||
            fail "$threads threads give another hash with $run"
    done
    hash "${by[@]}" --frames 5 --save-state half.json >/dev/null
    [[ $(hash "${by[@]}" --frames 7 --threads 3 --resume half.json) == "$one" ]] ||
        fail "a run cut in two gives another hash with $run"
    hash "${by[@]}" --frames 5 --save-state half.safetensors >/dev/null
    [[ $(hash "${by[@]}" --frames 7 --resume half.safetensors) == "$one" ]] ||
        fail "a run cut in two gives another hash with $run, its state in binary"
done

# Frames of the two halves are the frames of the whole.
treesim tree.json --wind gusty --frames 6 --no-source >whole.jsonl
treesim tree.json --wind gusty --frames 4 --no-source --save-state cut.json >first.jsonl
treesim tree.json --wind gusty --frames 2 --no-source --resume cut.json >second.jsonl
{ cat first.jsonl; tail -n +2 second.jsonl; } >joined.jsonl
same whole.jsonl joined.jsonl

# A state goes only with the tree, scene and step that it was saved from.
refused 2 "cut.json" treesim tree.json --wind breeze --frames 2 --resume cut.json
refused 2 "cut.json" treesim tree.json --wind gusty --frames 2 --resume cut.json --precision float
refused 2 "cut.json" treesim tree.json --wind gusty --frames 2 --resume cut.json --fps 60
refused 2 "cut.json" treesim tree.json --wind gusty --frames 2 --resume cut.json --substeps 2
