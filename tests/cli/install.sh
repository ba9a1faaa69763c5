#!/usr/bin/env bash
# What is installed is enough: a program of ten lines finds the library by find_package and runs; so do the tools.
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
cat >program/program.cpp <<'END'
#include <bough/growth/grow.h>
#include <bough/growth/segment.h>
#include <bough/stages/step.h>
#include <cstdio>
int main() {
    const bough::Tree tree = bough::segment(bough::grow(bough::default_growth(), 1, {}), bough::wood_presets().front(), {});
    const auto plan = bough::make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, {}, {}, 1.0 / 30);
    auto state = bough::make_state(plan);
    for (int i = 0; i < 30; ++i) bough::step(plan, state);
    return std::printf("%zu bodies\n", tree.size_bodies()) > 0 && !bough::first_non_finite(state) ? 0 : 1;
}
END
grep -q 'BOUGH_SANITIZE:STRING=..*' "$build/CMakeCache.txt" &&
    sanitize=-DCMAKE_EXE_LINKER_FLAGS=-fsanitize=$(sed -n 's/BOUGH_SANITIZE:STRING=//p' "$build/CMakeCache.txt") || sanitize=
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
cmake -S program -B program/build -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" ${sanitize:+"$sanitize"} \
    >log 2>&1 || fail "find_package: $(tail -n 5 log)"
cmake --build program/build >log 2>&1 || fail "building the program: $(tail -n 20 log)"
program/build/program || fail "the program does not run"
"$work/prefix/bin/treegen" --bodies 200 | "$work/prefix/bin/treeconvert" - | "$work/prefix/bin/treesim" - --frames 2 >/dev/null ||
    fail "the installed tools do not run"
