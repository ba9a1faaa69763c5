#!/usr/bin/env bash
# --settle: what is run before frame 0, held against a closed form and against runs that began earlier; its default, its note, and what it goes with.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
treesim() { command treesim "$@"; }

# loop.sh's pole in a sinusoidal wind: once it has forgotten its start it swings as the closed form says, by the wind's own clock, from frame 0 on.
cat >pole.json <<'END'
{"format": "bough-tree", "version": 1, "name": "pole", "parent": [-1], "mass": [1], "com": [0, 0, 0.5],
 "inertia": [0.0834, 0.0834, 0.0002, 0, 0, 0], "joint_position": [0, 0, 0], "joint_rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
 "stiffness": [19, 19, 10], "damping": [0.026], "size": [1, 0.02, 0.02], "branch": [0], "level": [0], "s": [0]}
END
echo '{"format": "bough-wind", "version": 1, "velocity": [0.01, 0, 0], "profile": 0, "grid": {"origin": [-5, -5], "cell": 10, "columns": 1, "rows": 1, "octaves": 1, "frequency": 0.3}}' >wind.json
for solver in coupled analytic articulated-reference; do
    treesim pole.json --wind wind.json --gravity 0,0,0 --substeps 8 --fields angles --seconds 3 --settle 31 --solver $solver -q >settled.jsonl
    python3 - $solver <<'END' || fail "a settled pole does not swing as the closed form says ($solver)"
import cmath, json, math, sys
head, *frames = [json.loads(line) for line in open("settled.jsonl")]
assert [f["frame"] for f in frames] == list(range(91)) and frames[0]["time"] == 0 and frames[30]["time"] == 1
V, w, I, K, beta, c = 0.01, 0.6 * math.pi, 0.0834 + 0.25, 19, 0.026, 0.6 * 1.2 * 0.04 / 2
H = lambda s: 1 / (K + 1j * s * beta * K - I * s * s)
exact = lambda t: c * V * V * (1.5 / K + 2 * (H(w) * cmath.exp(1j * w * t)).imag - 0.5 * (H(2 * w) * cmath.exp(2j * w * t)).real)
swing = max(abs(exact(k / 30)) for k in range(90))
off = max(abs(f["theta"][1] - exact(f["time"])) for f in frames)
print(f"{sys.argv[1]}: off by {off / swing:.2g} of the swing", file=sys.stderr)
assert off < 2e-3 * swing, off / swing
END
done

# By default where a wind blows, and said; as long for any precision and number of threads. --settle 0 is the start at rest.
treegen --age 12 --bodies 300 --seed 3 -q | treeconvert - -o tree.json -q
treesim tree.json --wind gusty --frames 20 -o settled.jsonl --no-source 2>note
frames=$(sed -n 's/^treesim: \([0-9]*\) frames ([0-9.]* s) of this wind were run before frame 0, .*(--settle 0: it begins at rest)$/\1/p' note)
[[ $frames -ge 60 && $frames -le 600 && $(wc -l <note) -eq 1 ]] || fail "note: $(cat note)"
treesim tree.json --wind gusty --frames 20 -q --no-source --settle "$(python3 -c "print($frames / 30)")" >same.jsonl
same settled.jsonl same.jsonl
treesim tree.json --wind gusty --frames 20 -q --no-source --settle 0 >rest.jsonl
treesim tree.json --frames 20 -q --no-source >still.jsonl
[[ $(sed -n 2p rest.jsonl) == "$(sed -n 2p still.jsonl)" ]] || fail "--settle 0 does not start at rest"
[[ $(sed -n 2p settled.jsonl) != "$(sed -n 2p rest.jsonl)" ]] || fail "a run in the wind starts at rest by default"
expect 0 treesim tree.json --frames 3 --no-output
! grep -q 'before frame 0' err || fail "a note without wind: $(cat err)"
for run in "" "--precision float" "--simd off" "--solver analytic"; do
    # shellcheck disable=SC2086
    one=$(hash tree.json --wind gusty --frames 20 --threads 1 $run)
    # shellcheck disable=SC2086
    [[ $(hash tree.json --wind gusty --frames 20 --threads 2 --no-output $run) == "$one" ]] || fail "hash by threads ($run)"
    # shellcheck disable=SC2086
    treesim tree.json --wind gusty --frames 8 -q --no-output --save-state half.json $run
    # shellcheck disable=SC2086
    [[ $(hash tree.json --wind gusty --frames 12 --resume half.json $run) == "$one" ]] || fail "hash of a run in two ($run)"
done

# A loop has periods of its own before it; a run that goes on has its start; pose rest and /fracture are looked at from theirs.
expect 0 treesim tree.json --wind gusty --loop 2 --loop-blend -o loop.jsonl
! grep -q 'before frame 0' err || fail "--loop settles: $(cat err)"
refused 1 "--settle: not with --loop" treesim tree.json --wind gusty --loop 2 --settle 2
refused 1 "--settle: not with --resume" treesim tree.json --wind gusty --resume half.json --settle 2
expect 0 treesim tree.json --wind gusty --frames 3 --set pose=rest --no-output
[[ ! -s err ]] || fail "pose rest settles: $(cat err)"
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}], "wind": "storm", "fracture": {"branch": 1}}' >breaks.json
expect 0 treesim breaks.json --frames 2 --no-output
! grep -q 'before frame 0' err || fail "a scene with /fracture settles: $(cat err)"
expect 0 treesim breaks.json --frames 1 --settle 3 -o before.jsonl
! grep -q broke before.jsonl || fail "something broke before frame 0"
refused 1 "--settle" treesim tree.json --wind gusty --settle -1
refused 1 "--settle: is 1e+09 s, expected at most" treesim tree.json --wind gusty --settle 1e9
refused 1 "--settle" treesim tree.json --wind gusty --settle long

# Beside the run: what holding joints costs, and the step's error, are of the same motion.
share() { treesim tree.json --wind gusty --frames 60 --no-output -q --report error "$@" 2>&1 | sed -n 's/^error up to about \([0-9.]*\) % .*/\1/p'; }
settled=$(share) rest=$(share --settle 0)
python3 -c "import sys; sys.exit(not 0 < $settled < 4 * $rest)" || fail "the step's error is $settled % of a settled run, $rest % of one from rest"
expect 0 treesim tree.json --wind gusty --frames 20 --no-output -q --report rigid --set 'simulate={"last_level": 1}'
grep -q '^rigid ' err || fail "--report rigid of a settled run: $(cat err)"

# The parts of a scene wait for the same time, that of the tree that takes longest, and end as the whole.
treegen --age 12 --bodies 900 --species pine --seed 1 -q | treeconvert - -o pine.json -q
python3 - <<'END'
import json
trees = [{"file": "tree.json", "position": [20.0 * k, 0, 0]} for k in range(3)] + [{"file": "pine.json", "position": [80.0, 0, 0]}]
json.dump({"format": "bough-scene", "version": 1, "trees": trees, "wind": "gusty"}, open("park.json", "w"))
END
treesim park.json --frames 5 --no-output --report hash >/dev/null 2>whole
for k in 1 2; do
    treesim park.json --frames 5 --no-output --shard $k/2 --save-state end$k.json 2>part
    [[ $(grep 'before frame 0' part) == "$(grep 'before frame 0' whole)" ]] || fail "part $k: $(cat part), whole: $(cat whole)"
done
[[ $(hash join end1.json end2.json) == "$(grep '^hash' whole)" ]] || fail "the parts of a settled park are not the whole"

# Ctrl-C while it settles leaves nothing.
python3 - <<'END' || fail "interrupted while settling"
import os, signal, subprocess, time
child = subprocess.Popen(["treesim", "tree.json", "--wind", "gusty", "--settle", "100000", "-q", "-o", "never.jsonl"], stderr=subprocess.PIPE)
time.sleep(1)
child.send_signal(signal.SIGINT)
said = child.communicate()[1].decode()
assert child.returncode == 130 and "before the first frame" in said, (child.returncode, said)
assert not os.path.exists("never.jsonl")
END
absent never.jsonl

# One way to settle, in every language: the same hash as treesim's.
wanted=$(hash tree.json --wind gusty --settle 2 --seconds 1)
cat >settled.cpp <<'END'
#include "formats/files.h"
#include <cstdio>

int main() {
    bough::Scene scene;
    scene.add(bough::read_tree("tree.json"));
    scene.wind = bough::wind_preset("gusty");
    bough::Simulation at_once(scene, {}), by_step(scene, {});
    at_once.settle(2);
    by_step.begin_before(60);
    while (by_step.steps() < 0) by_step.step();
    at_once.step(30);
    by_step.step(30);
    std::printf("hash %016llx\nhash %016llx\n", (unsigned long long)at_once.hash(), (unsigned long long)by_step.hash());
}
END
cat >settled.c <<'END'
#include "formats/c/bough_c.h"
#include <inttypes.h>
#include <stdio.h>

int main(void) {
    static char bytes[1 << 22];
    FILE* file = fopen("tree.json", "rb");
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    bough_settings settings = bough_default_settings();
    bough_tree* tree;
    bough_scene* scene;
    bough_simulation* simulation;
    bough_wind wind;
    uint64_t hash;
    int k;
    if (bough_read_tree(bytes, size, "tree.json", &tree) || bough_read_scene(NULL, 0, NULL, &scene) || bough_wind_preset("gusty", &wind) ||
        bough_scene_set_wind(scene, &wind) || bough_scene_add(scene, tree, NULL, 0) || bough_simulate(scene, &settings, NULL, &simulation) ||
        bough_settle(simulation, 2))
        return fprintf(stderr, "%s\n", bough_error()), 1;
    for (k = 0; k < 30; ++k) bough_step(simulation, NULL);
    bough_hash(simulation, &hash);
    printf("hash %016" PRIx64 "\n", hash);
    return 0;
}
END
libraries=(-L"$build/formats" -L"$build/lib" -lbough_files -lbough -Wl,-rpath,"$build/formats:$build/lib" -pthread)
c++ -std=c++20 -I"$top" -I"$top/lib" -isystem /usr/include/eigen3 settled.cpp -o settled_cpp "${libraries[@]}" 2>err || fail "settled.cpp: $(cat err)"
cc -std=c99 -I"$top" settled.c -o settled_c "${libraries[@]}" 2>err || fail "settled.c: $(cat err)"
[[ $(./settled_cpp | sort -u) == "$wanted" ]] || fail "in C++ it is $(./settled_cpp), treesim's $wanted"
[[ $(./settled_c) == "$wanted" ]] || fail "in C it is $(./settled_c), treesim's $wanted"
python=$(python_with_numpy)
if [[ -n $python ]]; then
    export BOUGH_LIBRARY=$build/formats/libbough_files.so PYTHONPATH=$top/formats/c PYTHONDONTWRITEBYTECODE=1
    said=$("$python" -c '
import bough
scene = bough.Scene(wind="gusty")
scene.add(bough.read_tree("tree.json"))
run = bough.Simulation(scene, precision="double")
run.settle(2)
for _ in range(30): run.step()
print("hash", run.hash())')
    [[ $said == "$wanted" ]] || fail "in Python it is $said, treesim's $wanted"
else
    echo "SKIPPED: no Python with numpy (python3-numpy)"
fi
