#!/usr/bin/env bash
# What is installed is enough: the program of lib/README.md finds the library by find_package and runs; so do the tools.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cmake --install "$build" --prefix "$work/prefix" >log 2>&1 || fail "cmake --install: $(tail -n 5 log)"
headers=$(cd "$work/prefix/include/bough" && find . -name '*.h' | sort | tr '\n' ' ')
[[ $headers == "./bough.h ./bough_c.h ./bough_imports.h ./error.h ./files.h " ]] ||
    fail "installed headers are $headers"

mkdir program
cat >program/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(program LANGUAGES CXX)
find_package(bough 0.1 REQUIRED)
add_executable(program program.cpp)
target_link_libraries(program PRIVATE bough::files)
END
code cpp lib/README.md >program/program.cpp
own=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
compilers=("$own") # sanitized libraries go with their own compiler alone
[[ -n $sanitizers ]] || compilers=(g++ clang++)
for compiler in "${compilers[@]}"; do
    command -v "$compiler" >/dev/null || { echo "SKIPPED: no $compiler"; continue; }
    rm -rf program/build
    cmake -S program -B program/build -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
        ${sanitizers:+"-DCMAKE_EXE_LINKER_FLAGS=-fsanitize=$sanitizers"} >log 2>&1 || fail "find_package with $compiler: $(tail -n 5 log)"
    cmake --build program/build >log 2>&1 || fail "building the program with $compiler: $(tail -n 20 log)"
    program/build/program >"said.$(basename "$compiler")" || fail "the program of $compiler does not run"
done
"$work/prefix/bin/treegen" --species apple --bodies 10000 --seed 7 | "$work/prefix/bin/treeconvert" - |
    "$work/prefix/bin/treesim" - --wind gusty --settle 0 --seconds 3 --precision float --report hash -o run.safetensors 2>err || fail "treesim of the program's tree: $(cat err)"
hash=$(grep -o '[0-9a-f]\{16\}' err | tail -n 1)
for said in said.*; do
    grep -q " bodies, $hash\$" "$said" || fail "the program's motion is '$(cat "$said")', treesim's '$hash'"
done
# The libraries call their own copies of Eigen's functions: a program that is compiled without optimization, or for another processor, has others.
if command -v readelf >/dev/null; then
    for library in bough bough_files bough_imports; do
        readelf -rW "$(find "$work/prefix" -name "lib$library.so")" >relocations || fail "readelf reads no lib$library.so"
        grep -q 'JUMP_SLO' relocations || { echo "SKIPPED: lib$library.so calls nothing through a table"; continue; }
        others=$(grep -c 'JUMP_SLO.* _ZNK\?5Eigen' relocations || true)
        [[ $others -eq 0 ]] || fail "lib$library.so calls $others of Eigen's functions as another library or the program has them"
    done
fi
# By pkg-config, without CMake.
if command -v pkg-config >/dev/null && [[ -z $sanitizers ]]; then
    PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name bough.pc)")
    export PKG_CONFIG_PATH
    # shellcheck disable=SC2046
    g++ -std=c++20 program/program.cpp -o by_hand $(pkg-config --cflags --libs bough) >log 2>&1 || fail "pkg-config: $(tail -n 5 log)"
    LD_LIBRARY_PATH=$(dirname "$(find "$work/prefix" -name 'libbough.so' | head -n 1)") ./by_hand >said || fail "the program by pkg-config does not run"
    grep -q " bodies, $hash\$" said || fail "by pkg-config it is '$(cat said)'"
fi
# In C, by its own pkg-config file (without Eigen), the program of lib/README.md.
if command -v pkg-config >/dev/null && [[ -z $sanitizers ]]; then
    code c lib/README.md >apple.c
    for compiler in gcc clang; do
        command -v "$compiler" >/dev/null || { echo "SKIPPED: no $compiler"; continue; }
        # shellcheck disable=SC2046
        "$compiler" -std=c99 apple.c -o apple $(PKG_CONFIG_LIBDIR=$PKG_CONFIG_PATH pkg-config --cflags --libs bough_c) >log 2>&1 || fail "C by pkg-config, $compiler: $(tail -n 5 log)"
        LD_LIBRARY_PATH=$(dirname "$(find "$work/prefix" -name 'libbough.so' | head -n 1)") ./apple >said || fail "the C program of $compiler does not run"
        grep -q " bodies, $hash\$" said || fail "in C by $compiler it is '$(cat said)'"
    done
fi
# Another program's tree from its bytes, in C++ by CMake and in C by pkg-config: it moves as treesim moves what treeconvert makes of it. The documents' library
# asks for neither pugixml nor assimp, this one for no assimp.
if command -v readelf >/dev/null; then
    for library in bough bough_files bough_imports; do
        asked=$(readelf -d "$(find "$work/prefix" -name "lib$library.so")" | grep -oE 'NEEDED.*lib(pugixml|assimp|tiff|png|OpenEXR|meshoptimizer)' || true)
        [[ -z $asked || $library$asked == bough_imports*pugixml ]] || fail "lib$library.so asks for $asked"
    done
fi
"$work/prefix/bin/treeconvert" "$maple" 2>/dev/null | "$work/prefix/bin/treesim" - --wind gusty --settle 0 --seconds 0.5 --report hash -o maple.jsonl 2>err ||
    fail "treesim of the maple: $(cat err)"
hash_of_maple=$(grep -o '[0-9a-f]\{16\}' err | tail -n 1)
mkdir maple
cat >maple/maple.cpp <<'END'
#include <bough/bough_imports.h>
#include <bough/files.h>
#include <cstdio>
#include <fstream>
#include <iterator>

int main(int, char** files) {
    std::ifstream file(files[1], std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    std::vector<std::string> notes;
    bough::Scene scene;
    scene.add(bough::import_tree(bytes, files[1], {}, &notes));
    scene.wind = bough::wind_preset("gusty");
    bough::Simulation simulation(scene);
    simulation.step(15);
    std::printf("%s: %016llx\n", notes.at(0).c_str(), (unsigned long long)simulation.hash());
    try {
        bough::import_tree("Kaydara FBX Binary  ", "a maple.fbx");
    } catch (const bough::InputError& error) {
        std::printf("%s\n", error.what());
    }
}
END
cat >maple/maple.c <<'END'
#include <bough/bough_imports.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

int main(int count, char **files) {
    FILE *file = fopen(files[1], "rb");
    char *bytes = malloc(1 << 25);
    size_t size = fread(bytes, 1, 1 << 25, file);
    bough_tree *tree;
    bough_scene *scene;
    bough_simulation *simulation;
    bough_wind wind;
    uint64_t hash;
    int k;
    if (count != 2 || bough_import_tree(bytes, size, files[1], NULL, &tree)) return fprintf(stderr, "%s\n", bough_error()), 1;
    printf("%.*s: ", (int)sizeof "SpeedTree raw XML" - 1, bough_import_notes());
    bough_wind_preset("gusty", &wind);
    bough_read_scene(NULL, 0, NULL, &scene);
    bough_scene_set_wind(scene, &wind);
    bough_scene_add(scene, tree, NULL, 0);
    bough_simulate(scene, NULL, NULL, &simulation);
    for (k = 0; k < 15; ++k) bough_step(simulation, NULL);
    bough_hash(simulation, &hash);
    printf("%016" PRIx64 "\n", hash);
    if (bough_import_tree("Kaydara FBX Binary  ", 20, "a maple.fbx", NULL, &tree) == BOUGH_INPUT) printf("%s\n", bough_error());
    return fclose(file);
}
END
sed 's/program/maple/g; s/bough::files/bough::imports/' program/CMakeLists.txt >maple/CMakeLists.txt
cmake -S maple -B maple/build -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$own" \
    ${sanitizers:+"-DCMAKE_EXE_LINKER_FLAGS=-fsanitize=$sanitizers"} >log 2>&1 || fail "find_package of bough::imports: $(tail -n 5 log)"
cmake --build maple/build >log 2>&1 || fail "building with bough::imports: $(tail -n 20 log)"
maple/build/maple "$maple" >said.maple || fail "the program that reads the maple does not run"
if command -v pkg-config >/dev/null && [[ -z $sanitizers ]]; then
    # shellcheck disable=SC2046
    gcc -std=c99 maple/maple.c -o maple/in_c $(PKG_CONFIG_LIBDIR=$PKG_CONFIG_PATH pkg-config --cflags --libs bough_imports) >log 2>&1 || fail "pkg-config bough_imports: $(tail -n 5 log)"
    LD_LIBRARY_PATH=$(dirname "$(find "$work/prefix" -name 'libbough.so' | head -n 1)") maple/in_c "$maple" >said.in_c 2>&1 || fail "the C program that reads the maple: $(cat said.in_c)"
    same said.maple said.in_c
    # shellcheck disable=SC2046
    g++ -std=c++20 maple/maple.cpp -o maple/in_cpp $(pkg-config --cflags --libs bough bough_imports) >log 2>&1 || fail "pkg-config bough bough_imports: $(tail -n 5 log)"
fi
[[ $(cat said.maple) == "SpeedTree raw XML: $hash_of_maple"$'\n'"a maple.fbx: is an FBX model, which the tools alone read; by hand: treeconvert 'a maple.fbx' -o 'a maple.tree.json'; or save it as glTF" ]] ||
    fail "the maple's program says '$(cat said.maple)', treesim $hash_of_maple"
# bough.py where the prefix's Python looks, with the library found beside it: the program of lib/README.md.
module=$(find "$work/prefix" -name bough.py)
[[ $module == */lib/python3*/site-packages/bough.py ]] || fail "bough.py is installed as '$module'"
numpy=$(python_with_numpy)
if [[ -n $numpy && -z $sanitizers ]]; then
    code python lib/README.md >run.py
    env -u BOUGH_LIBRARY PYTHONPATH="$(dirname "$module")" PYTHONDONTWRITEBYTECODE=1 "$numpy" run.py >said 2>err || fail "bough.py, installed: $(cat err)"
    grep -q " bodies, $hash\$" said || fail "in Python it is '$(cat said)'"
    env -u BOUGH_LIBRARY PYTHONPATH="$(dirname "$module")" PYTHONDONTWRITEBYTECODE=1 "$numpy" - "$maple" <<'END' >said 2>err || fail "bough.py, installed, reads no maple: $(cat err)"
import sys
import bough
scene = bough.Scene(wind="gusty")
scene.add(bough.read_tree(sys.argv[1]))
run = bough.Simulation(scene)
for _ in range(15):
    run.step()
print(run.hash())
END
    [[ $(cat said) == "$hash_of_maple" ]] || fail "in Python the maple is '$(cat said)', treesim's $hash_of_maple"
else
    echo "notice: no Python with numpy, bough.py is not tried"
fi
# Uninstalled, nothing of it stays, and nothing else goes.
touch "$work/prefix/bin/own"
cmake "-DMANIFEST=$build/install_manifest.txt" -P "$top/tools/uninstall.cmake" >log 2>&1 || fail "uninstall: $(tail -n 5 log)"
left=$(find "$work/prefix" -not -type d -o -name bough)
[[ $left == "$work/prefix/bin/own" ]] || fail "what is uninstalled leaves $left"
