#!/usr/bin/env bash
# data/Makefile.example makes a tree and an OBJ sequence of an XML file, and nothing the second time.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cp "$top/data/Makefile.example" Makefile
cp "$maple" maple.xml
make -s SECONDS=0.5 >log 2>&1 || fail "make: $(tail -n 5 log)"
[[ -s maple.tree.json && -s frames/maple_0000.obj && -s frames/maple_0015.obj && -s frames/maple.mtl ]] ||
    fail "make gave $(ls -R)"
[[ $(find frames -name '*.obj' | wc -l) -eq 16 ]] || fail "half a second is not 16 frames"
make -q SECONDS=0.5 || fail "a second make has something to do: $(make -n SECONDS=0.5)"
cp frames/maple_0015.obj soft.obj
make -s -B SECONDS=0.5 SET='--set material.E=1e9' >log 2>&1 || fail "make with --set: $(tail -n 5 log)"
! cmp -s frames/maple_0015.obj soft.obj || fail "--set of the Makefile changes nothing"
touch maple.xml
! make -q SECONDS=0.5 || fail "a newer XML gives nothing to do"

# A run that fails leaves no stamp, and make fails.
echo broken >maple.xml
! make -s SECONDS=0.5 >log 2>&1 || fail "make took a broken file"
make -s clean
[[ ! -e frames && ! -e maple.tree.json ]] || fail "clean left $(ls)"
