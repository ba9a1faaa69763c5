#!/usr/bin/env bash
# What is installed is enough: the program of lib/README.md finds the library by find_package and runs; so do the tools.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cmake --install "$build" --prefix "$work/prefix" >log 2>&1 || fail "cmake --install: $(tail -n 5 log)"
headers=$(cd "$work/prefix/include/bough" && find . -name '*.h' | sort | tr '\n' ' ')
[[ $headers == "./bough.h ./bough_c.h ./error.h ./files.h " ]] ||
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
    for library in bough bough_files; do
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
# bough.py where the prefix's Python looks, with the library found beside it: the program of lib/README.md.
module=$(find "$work/prefix" -name bough.py)
[[ $module == */lib/python3*/site-packages/bough.py ]] || fail "bough.py is installed as '$module'"
numpy=$(python_with_numpy)
if [[ -n $numpy && -z $sanitizers ]]; then
    code python lib/README.md >run.py
    env -u BOUGH_LIBRARY PYTHONPATH="$(dirname "$module")" PYTHONDONTWRITEBYTECODE=1 "$numpy" run.py >said 2>err || fail "bough.py, installed: $(cat err)"
    grep -q " bodies, $hash\$" said || fail "in Python it is '$(cat said)'"
else
    echo "notice: no Python with numpy, bough.py is not tried"
fi
# Uninstalled, nothing of it stays, and nothing else goes.
touch "$work/prefix/bin/own"
cmake "-DMANIFEST=$build/install_manifest.txt" -P "$top/tools/uninstall.cmake" >log 2>&1 || fail "uninstall: $(tail -n 5 log)"
left=$(find "$work/prefix" -not -type d -o -name bough)
[[ $left == "$work/prefix/bin/own" ]] || fail "what is uninstalled leaves $left"
