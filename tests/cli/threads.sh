#!/usr/bin/env bash
# One hash for any number of threads, and for a run cut in two.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --bodies 6000 --seed 5 --leaves --fruit | treeconvert - -o tree.json
hash() { treesim tree.json --wind gusty --no-output --report hash "$@" 2>&1 | grep '^hash '; }
for run in "analytic --precision double" "analytic --precision float" "coupled --precision double" \
    "coupled --precision float" "coupled --scheme P34"; do
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

# Frames are written beside the simulation where there are two threads or more: the same bytes as from one.
for kind in jsonl json safetensors glb; do
    treesim tree.json --wind gusty --frames 6 --no-source -q --threads 1 -o "one.$kind"
    for threads in 2 3; do
        treesim tree.json --wind gusty --frames 6 --no-source -q --threads $threads -o "more.$kind"
        same "one.$kind" "more.$kind"
    done
done
mkdir one more
treesim tree.json --wind gusty --frames 4 -q --threads 1 -o one/m_%d.obj
treesim tree.json --wind gusty --frames 4 -q --threads 2 -o more/m_%d.obj
for file in one/*; do same "$file" "more/${file#one/}"; done

# What goes wrong in writing stops the run with the same message, whichever thread it happens in.
mkdir more/b_3.obj
for threads in 1 2 3; do
    refused 4 "stopped after 3 frames: more/b_3.obj" treesim -q tree.json --frames 100000 --threads $threads -o more/b_%d.obj
    rm -f more/b_[0-2].obj
    code=0
    { treesim tree.json --frames 100000 --threads $threads 2>err || echo $? >code; } | head -c 3000000 >part.jsonl
    [[ $(cat code) -eq 4 ]] || fail "exit $(cat code) with the reader gone, expected 4 ($threads threads)"
    one_line "<stdout>: cannot be written: Broken pipe" treesim
done

# No output, no thread for it; nor with one thread. (The others are OpenMP's, or a sanitizer's.)
started() { # threads that a run starts
    strace -f -e trace=clone,clone3 -o calls treesim tree.json --frames 3 -q "$@" >/dev/null
    grep -c 'clone.* = [0-9]' calls || true
}
if command -v strace >/dev/null && strace -o calls true 2>/dev/null; then
    for threads in 1 2; do
        without=$(started --threads $threads --no-output) with=$(started --threads $threads)
        [[ $((with - without)) -eq $((threads - 1)) ]] ||
            fail "with --threads $threads, output starts $with threads, no output $without"
    done
fi
