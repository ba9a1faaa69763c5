# treegen --envelope: volumes, a mesh file, number of bodies, what is refused.
. "$(dirname "$0")/common.sh" "$@"

for shape in sphere cone box; do
    expect 0 treegen --envelope $shape --leaves --seed 3 -o $shape.json
    [[ ! -s out && ! -s err ]] || fail "treegen --envelope $shape says $(cat out err)"
    expect 0 treegen --envelope $shape --leaves --seed 3 --threads 1 --no-source -o a.json
    expect 0 treegen --envelope $shape --leaves --seed 3 --no-source -o b.json
    cmp a.json b.json || fail "two $shape of the same seed differ"
    expect 0 treeconvert $shape.json -o $shape.tree.json
done
expect 0 treegen --envelope cone --envelope-size 3,6,3 --crown-base 1 --attractors 500 --influence 2 --kill 0.3 --step 0.1 \
    --tropism 0,-0.1,0 --leader 0.5 --tip-radius 0.004 --fruit -o cone.json

# A cube in an OBJ, in centimetres, Z up.
cat >cube.obj <<'END'
v 0 0 0
v 200 0 0
v 200 300 0
v 0 300 0
v 0 0 400
v 200 0 400
v 200 300 400
v 0 300 400
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END
expect 0 treegen --envelope cube.obj --units cm --up z -o cube.json
[[ ! -s err ]] || fail "unexpected: $(cat err)"
expect 0 treegen --envelope cube.obj
grep -q "unit: the file states none" err || fail "no word of the unit: $(cat err)"
treegen --envelope - --crown-base 2 --envelope-size 3,3,3 --bodies 400 -o scaled.json -q <cube.obj || fail "a mesh from stdin"
sed '$d' cube.obj >open.obj
expect 0 treegen --envelope open.obj --units cm -o open.json
grep -q "warning: the mesh is not closed (4 open edges)" err || fail "no warning: $(cat err)"

expect 0 treegen --envelope sphere --bodies 1500 --leaves --no-source -o bodies.json
expect 0 treeconvert bodies.json --stats -o bodies.tree.json
n=$(sed -n 's/.*bodies *\([0-9]*\):.*/\1/p' err | head -1)
[[ $n -ge 1350 && $n -le 1650 ]] || fail "$n bodies, expected 1500 within a tenth"
expect 0 treegen --envelope sphere --leaves --no-source -o whole.json
cmp <(grep -v '^"bodies"' bodies.json) whole.json || fail "another tree for another number of bodies"

refused 1 "--species: not with --envelope" treegen --envelope sphere --species broadleaf
refused 1 "--envelope: not with --import" treegen --envelope sphere --import x.swc
refused 1 "--kill: only with --envelope" treegen --kill 1
refused 1 "--bodies: is 1, but this tree has at least" treegen --envelope box --leaves --bodies 1
refused 1 "--envelope-size is '1,2', expected 3 numbers" treegen --envelope box --envelope-size 1,2
refused 1 "--envelope-size is '1,2,-1', expected three lengths" treegen --envelope box --envelope-size 1,2,-1
refused 1 "--kill: is 0.1, expected at least the step" treegen --envelope box --kill 0.1 --step 0.2
refused 1 "--units: only with" treegen --envelope box --units cm
refused 1 "--leader: is 2, expected 0 to 1" treegen --envelope box --leader 2
refused 1 "--tip-radius: is 20, expected 0 to 10 m" treegen --envelope box --tip-radius 20
refused 1 "--step: is 1e-10, expected at least 1e-7 of the height" treegen --envelope box --step 1e-10 --kill 0.5
refused 1 "--envelope: the step that follows from what is given is 5e-10, expected at least" treegen --envelope sphere --kill 1e-9
# A volume in which no tree grows is the file's matter, or the size's, and no option's that nobody gave.
awk '/^v/ { printf "v %g %g %g\n", $2 * 1e7, $3 * 1e7, $4 * 1e7; next } { print }' cube.obj >huge.obj
refused 2 "huge.obj: is 4e+09 m large, expected its longest side" treegen --envelope huge.obj --units m
refused 1 "--envelope-size is '1e9,1e9,1e9', expected its longest side" treegen --envelope box --envelope-size 1e9,1e9,1e9
expect 0 treegen --envelope box --envelope-size 1,1,1 --crown-base 0 --attractors 1 --leaves --fruit -o one.json
expect 0 treeconvert one.json -o one.tree.json

refused 2 "nowhere.obj" treegen --envelope nowhere.obj
echo "ply" >crown.ply
refused 2 "is a PLY model, expected a closed triangle mesh" treegen --envelope crown.ply
printf 'glTF\2\0\0\0\377\377\0\0' >broken.glb
refused 2 "broken.glb: is cut off" treegen --envelope broken.glb
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n' >flat.obj
refused 2 "encloses no volume" treegen --envelope flat.obj
