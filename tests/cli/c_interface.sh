#!/usr/bin/env bash
# bough_c.h as C programs have it: the header is C99 and C++ to both compilers, without a warning; the program of lib/README.md moves the tree as treesim
# does; so do 100 simulations on 100 threads. The engine's sample steps its trees without a call of its allocator.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mkdir -p include/bough
cp "$top/formats/c/bough_c.h" include/bough/
echo '#include <bough/bough_c.h>' | tee header.c >header.cpp
code c lib/README.md >apple.c

strict=(-Wall -Wextra -Wpedantic -Werror -Wshadow -Wstrict-prototypes -Iinclude)
own=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
compilers=(gcc clang)
[[ -z $sanitizers ]] || compilers=("${own/++/}") # sanitized libraries go with their own compiler alone
[[ -z $sanitizers || ${own##*/} != c++ ]] || compilers=(cc)
libraries=(-L"$build/formats" -L"$build/lib" -lbough_files -lbough -Wl,-rpath,"$build/formats:$build/lib" -pthread ${sanitizers:+"-fsanitize=$sanitizers"})
[[ -z $sanitizers ]] || libraries+=(-fsanitize-link-c++-runtime -lstdc++) # clang's, which the libraries ask for
treegen --species apple --bodies 10000 --seed 7 | treeconvert - -o apple.tree.json
wanted=$(hash apple.tree.json --wind gusty --seconds 3 --precision float)
treegen --species birch --age 8 --bodies 400 --leaves | treeconvert - -o birch.safetensors
threaded=$(hash birch.safetensors --wind gusty --seconds 1 --precision float)
ran=0
for compiler in "${compilers[@]}"; do
    command -v "$compiler" >/dev/null || { echo "SKIPPED: no $compiler"; continue; }
    "$compiler" -std=c99 "${strict[@]}" -Wconversion -fsyntax-only header.c 2>err || fail "$compiler, the header as C99: $(cat err)"
    "$compiler" -std=c11 "${strict[@]}" -Wconversion -fsyntax-only header.c 2>err || fail "$compiler, the header as C11: $(cat err)"
    "$compiler" -x c++ -std=c++11 "${strict[@]/-Wstrict-prototypes/-Wall}" -fsyntax-only header.cpp 2>err || fail "$compiler, the header as C++: $(cat err)"
    "$compiler" -std=c99 "${strict[@]}" apple.c -o apple "${libraries[@]}" 2>err || fail "$compiler, the program of lib/README.md: $(cat err)"
    ./apple >said 2>err || fail "the program of $compiler: $(cat said err)"
    [[ "hash $(sed 's/.*, //' said)" == "$wanted" ]] || fail "the program's motion is '$(cat said)', treesim's '$wanted'"
    "$compiler" -std=c99 "${strict[@]}" "$top/tests/cli/c_threads.c" -o threads "${libraries[@]}" 2>err || fail "$compiler, c_threads.c: $(cat err)"
    ./threads birch.safetensors 30 >said 2>err || fail "100 threads: $(cat said err)"
    [[ $(cat said) == "$threaded" && ! -s err ]] || fail "100 threads have '$(cat said err)', treesim '$threaded'"
    if [[ -z $sanitizers ]]; then # (those bring an allocator of their own)
        "$compiler" -std=c11 "${strict[@]}" "$top/formats/c/examples/engine.c" -o engine "${libraries[@]}" 2>err || fail "$compiler, engine.c: $(cat err)"
        ./engine 100 >said 2>err || fail "engine.c: $(cat said err)"
        grep -q '^[0-9]* bodies in 3 trees: .* ms a frame, .*; 0 allocations in 600 frames' said || fail "engine.c: $(cat said)"
    fi
    ran=1
done
[[ $ran -eq 1 ]] || exit 77
# Nothing that ends or prints is called by what implements it.
if command -v nm >/dev/null && [[ -z $sanitizers ]]; then
    found=$(nm -C --undefined-only "$build"/formats/CMakeFiles/bough_files.dir/c/*.o | grep -E ' U (exit|_exit|abort|printf|puts|fprintf|fputs|perror|std::cout|std::cerr)' || true)
    [[ -z $found ]] || fail "formats/c calls $found"
    found=$(nm -C --undefined-only "$build/formats/libbough_imports.so" | grep -E ' U (exit|_exit|abort|fork|system|execv.*|printf|puts|fprintf|fputs|perror|std::cout|std::cerr)(@|$)' || true)
    [[ -z $found ]] || fail "libbough_imports calls $found"
fi
