#!/usr/bin/env bash
# What is installed is enough: the README's program finds the library by find_package and runs; so do the tools.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cmake --install "$build" --prefix "$work/prefix" >log 2>&1 || fail "cmake --install: $(tail -n 5 log)"
mkdir program
cat >program/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(program LANGUAGES CXX)
find_package(bough 0.1 REQUIRED)
add_executable(program program.cpp)
target_link_libraries(program PRIVATE bough::bough)
END
sed -n '/^## The library/,$ { /^    #include <bough/,/^    }$/ s/^    //p; /^$/p }' "$top/README.md" >program/program.cpp
grep -q 'advance(plan, state)' program/program.cpp || fail "no program in the README: $(cat program/program.cpp)"
grep -q 'BOUGH_SANITIZE:STRING=..*' "$build/CMakeCache.txt" &&
    sanitize=-DCMAKE_EXE_LINKER_FLAGS=-fsanitize=$(sed -n 's/BOUGH_SANITIZE:STRING=//p' "$build/CMakeCache.txt") || sanitize=
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
cmake -S program -B program/build -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" ${sanitize:+"$sanitize"} \
    >log 2>&1 || fail "find_package: $(tail -n 5 log)"
cmake --build program/build >log 2>&1 || fail "building the program: $(tail -n 20 log)"
program/build/program >said || fail "the program does not run"
"$work/prefix/bin/treegen" --seed 1 | "$work/prefix/bin/treeconvert" - |
    "$work/prefix/bin/treesim" - --wind gusty --seconds 1 --hash -o run.jsonl 2>err || fail "treesim of the program's tree: $(cat err)"
hash=$(grep -o '[0-9a-f]\{16\}' err | tail -n 1)
grep -q " bodies, $hash\$" said || fail "the program's motion is '$(cat said)', treesim's '$hash'"
"$work/prefix/bin/treegen" --bodies 200 | "$work/prefix/bin/treeconvert" - | "$work/prefix/bin/treesim" - --frames 2 >/dev/null ||
    fail "the installed tools do not run"
