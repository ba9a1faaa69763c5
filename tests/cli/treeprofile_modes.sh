#!/usr/bin/env bash
# treeprofile modes: figures, reports, pictures and what is refused.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --species maple --age 12 --bodies 300 --leaves --seed 3 | treeconvert - -o tree.json
ending=txt
wrong_use treeprofile modes tree.json --modes 3
bad_input tree.json treeprofile modes
refused 1 "--modes" treeprofile modes tree.json --modes 0
refused 1 "--swing 3" treeprofile modes tree.json --modes 2 --swing 3 -o swing.glb
refused 1 "only with -o FILE.glb" treeprofile modes tree.json --swing 2
refused 1 "/wind/shelter" treeprofile modes tree.json --wind gusty --set 'wind.shelter={"cell":1}'
for name in x.csv x.json x.svg; do
    refused 1 "--report $name" treeprofile modes tree.json -o $name
done
refused 1 "x.html" treeprofile modes tree.json -o x.html
absent x.csv x.json x.svg x.html
expect 0 treeprofile modes tree.json --modes 1 -o x.txt
expect 0 treeprofile modes tree.json --modes 1 -o table
same x.txt table
refused 1 "--scan-radii: is treeconvert's: treeconvert FILE --scan-radii" treeprofile modes tree.json --scan-radii
refused 1 "--set material.root_stiffness=K" treeprofile modes tree.json --root-stiffness 5
refused 1 "r.html" treeprofile modes tree.json --report r.html
refused 1 "/wind/swirl" treeprofile modes tree.json --wind gusty --set 'wind.swirl={"center":[0,0],"radius":[0],"angle":[20],"period":3}'

# A uniform rod of 4 m whose first frequency is known: 0.1399 D / L^2 sqrt(E / rho), and weight off.
cat >rod.json <<'END'
{"format": "bough-splines", "version": 1, "parent": [-1], "parent_at": [0], "level": [0], "first_point": [0, 2], "point": [0, 0, 0, 0, 4, 0], "radius": [0.03, 0.03]}
END
treeconvert rod.json --segment-length 0.02 -o rod.tree.json
expect 0 treeprofile modes rod.tree.json --modes 4 --set gravity=[0,0,0] --report rod.csv
treeconvert --list-materials >materials
python3 - <<'END' || fail "the rod's frequencies are not a cantilever's: $(cat rod.csv)"
import csv, math
wood = [line.split("\t") for line in open("materials")][1]
first = 0.1399 * 0.06 / 16 * math.sqrt(float(wood[2]) / float(wood[1]))
f = [float(row["frequency"]) for row in csv.DictReader(open("rod.csv"))]
for k, ratio in enumerate([1, 1, 6.2669, 6.2669]):
    assert math.isclose(f[k], first * ratio, rel_tol=5e-3), (f, first)
END

# The reports hold one another's figures; wind damps, and does not change a frequency.
expect 0 treeprofile modes tree.json --modes 5 --report m.json
expect 0 treeprofile modes tree.json --modes 5 --wind gusty --report w.json
python3 - <<'END' || fail "the reports do not fit"
import json
m, w = json.load(open("m.json")), json.load(open("w.json"))
assert m["format"] == "bough-modes-report" and len(m["modes"]) == 5 and w["wind"] == "gusty"
for a, b in zip(m["modes"], w["modes"]):
    assert abs(a["frequency"] - b["frequency"]) < 1e-9 * a["frequency"] and b["damping"] > 2 * a["damping"] > 0
    assert abs(sum(v for k, v in a.items() if k.startswith("share_")) - 1) < 1e-9
    assert 0 <= a["mass_x"] + a["mass_y"] + a["mass_z"] < m["mass"]
assert [a["frequency"] for a in m["modes"]] == sorted(a["frequency"] for a in m["modes"])
END

# Shapes: of all branches the shares are whole, of few the largest are listed, and CSV has the same.
expect 0 treeprofile modes tree.json --modes 2 --branches 1000000 --report all.json
expect 0 treeprofile modes tree.json --modes 2 --branches 3 --report few.csv
python3 - <<'END' || fail "the shapes do not fit"
import csv, json
r, few = json.load(open("all.json")), list(csv.DictReader(open("few.csv")))
assert r["listed"] == r["branches"] == len({s["branch"] for s in r["shapes"]})
for mode, row in zip(r["modes"], few):
    shape = [s for s in r["shapes"] if s["mode"] == mode["mode"]]
    assert abs(sum(s["share"] for s in shape) - 1) < 1e-9
    farthest = max(shape, key=lambda s: s["amplitude"])
    assert farthest["branch"] == mode["branch"] and abs(farthest["amplitude"] - 1) < 1e-9
    assert [s["share"] for s in shape] == sorted((s["share"] for s in shape), reverse=True)
    for k in 1, 2, 3:
        assert all(abs(float(row[f"shape_{k}_{name}"]) - shape[k - 1][name]) < 1e-6 for name in ("branch", "level", "x", "y", "z", "amplitude", "share"))
    assert "shape_4_branch" not in row
END

# One body is one; a straight rod moves no mass along itself, and rounding is not shown as if it did.
treeconvert rod.json --segment-length 10 -o one.tree.json
expect 0 treeprofile modes one.tree.json --modes 2
grep -q ': 1 body, ' out || fail "$(cat out)"
expect 0 treeprofile modes rod.tree.json --modes 4
! grep -Eq '[0-9]e-(09|[1-9][0-9])%' out || fail "rounding is shown as masses: $(cat out)"
grep -Eq ' 0% ' out || fail "$(cat out)"
refused 1 "--branches" treeprofile modes tree.json --branches -1

# A swing of one period; who cannot stand is told.
expect 0 treeprofile modes tree.json --modes 2 --swing 2 -o swing.glb
python3 - <<'END' || fail "the swing does not last one period of its mode"
import json, struct
data = open("swing.glb", "rb").read()
gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
times = {a["input"] for a in gltf["animations"][0]["samplers"]}
ends = [gltf["accessors"][k]["max"][0] for k in times]
period = 1 / json.load(open("m.json"))["modes"][1]["frequency"]
assert abs(max(ends) - period) < 1e-6 * period, (ends, period)
END
if command -v gnuplot >/dev/null; then
    expect 0 treeprofile modes tree.json --modes 2 --report shapes.svg
    grep -q "mode 2" shapes.svg || fail "the picture has no second shape"
fi
expect 0 treeprofile modes rod.tree.json --modes 1 --set stiffness_scale=0.01
grep -q "branch 0 buckles .*--radii carry" err || fail "what carries a rod that cannot stand is not said: $(cat err)"
# Outputs are looked at before anything is computed.
ln -s same.json same.txt
refused 1 "the same file as" treeprofile modes tree.json --modes 2 --report same.json -o same.txt
refused 4 "none/x.json" treeprofile modes none.json --modes 2 --report none/x.json
refused 4 "none/x.txt" treeprofile modes none.json --modes 2 -o none/x.txt
absent same.json
absent
