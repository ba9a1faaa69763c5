#!/bin/bash
# Repairs that real files need: each in one line on stderr, each an error with --strict in both tools.
. "$(dirname "$0")/common.sh"

# repair FILE TEXT: it is read with a note that holds TEXT, and with --strict refused with one line.
repair() {
    local file=$1 text=$2 line
    expect 0 treegen --import "$file" -o splines.json
    grep -qF -- "$text" err || fail "no note about '$text' from treegen: $(cat err)"
    expect 0 treeconvert "$file" -o tree.json
    line=$(grep -F -- "$text" err) || fail "no note about '$text' from treeconvert: $(cat err)"
    [[ $(grep -cF -- "$text" err) -eq 1 ]] || fail "more than one line about '$text': $line"
    rm -f splines.json tree.json
    refused 2 "(--strict)" treegen --import "$file" --strict -o splines.json
    refused 2 "(--strict)" treeconvert "$file" --strict -o tree.json
    absent splines.json tree.json
}

refused 1 "--strict: only with --import" treegen --strict
cat >loose.csv <<END
spline,point,x,y,z,radius
0,0,0,0,0,0.2
0,1,0,0,0,0.2
0,2,0,0,4,0.1
1,0,0.1,0,3,0
1,1,1,0,3.5,0
END
repair loose.csv "1 curve attached to the nearest branch, as the file names no parents, over a gap of up to 0.1"
repair loose.csv "2 of 5 radii are missing or 0; filled by the pipe rule"
repair loose.csv "1 point that repeats the one before left out"
awk -F, -v OFS=, 'NR > 1 { $5 += 990 } { print }' loose.csv >far.csv
repair far.csv "set on the ground at the origin (--keep-place leaves it)"
awk -F, -v OFS=, 'NR > 1 { $3 *= 0.01; $5 *= 0.01; $6 *= 0.01 } { print }' loose.csv >small.csv
repair small.csv "0.04 m high, hardly a tree: is the unit right?"
printf 'v 0 0 0\nv 0 2 0\nv 0 2 0\nv 0 3 0\nv 0.2 2 0\nv 1 3 0\nl 1 2\nl 3 4\nl 5 6\n' >lines.obj
repair lines.obj "1 point welded to another at its place"
repair lines.obj "1 loose part attached to the nearest branch, over a gap of up to 0.2"
printf 'l 1 4\nl 1 2\n' >>lines.obj
repair lines.obj "1 line cut that closes a circle"
repair lines.obj "1 line that repeats another left out"

# A mesh is no skeleton; what is neither guessed nor repaired passes.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >mesh.obj
refused 2 "is a mesh (1 face) without lines (l) or curves (curv), which is no skeleton" treegen --import mesh.obj
printf '1 3 0 0 0 0.1 -1\n2 3 0 2 0 0.05 1\n' >good.swc
expect 0 treegen --import good.swc --strict --units m --up y -o splines.json
expect 0 treeconvert good.swc --strict --units m --up y -o tree.json
