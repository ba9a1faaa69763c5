#!/usr/bin/env bash
# data/Makefile.example makes a tree and an OBJ sequence of an XML file, and nothing the second time. data/critical_wind finds the wind that breaks a scan.
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

# A scan in two winds. What Python needs is the example's own to install, and not a test's.
critical=(make -s -f "$top/data/critical_wind/Makefile" SCAN=scan.csv WOOD=european-ash WINDS="0 60 120" RUN="--settle 20 --set damping_scale=10 --frames 2")
cp "$top/data/fixtures/archi_small.csv" scan.csv
"${critical[@]}" scan/wind_0.safetensors scan/wind_60.safetensors >log 2>&1 || fail "critical_wind: $(tail -n 5 log)"
[[ -s scan/wind_60.safetensors ]] || fail "critical_wind gave no motion: $(ls scan)"
if /usr/bin/python3 -c 'import matplotlib, pandas' 2>/dev/null; then
    "${critical[@]}" >log 2>&1 || fail "critical_wind: $(tail -n 5 log)"
    grep -q '^stem (branch .*: ' log || fail "critical_wind names no stem: $(cat log)"
    [[ -s scan/critical_wind.png && $(head -n 1 scan/critical_wind.csv) == branch,level,body,height_m,diameter_mm,wind_m_s,ratio ]] ||
        fail "critical_wind left $(ls scan)"
    "${critical[@]}" -q || fail "critical_wind has something to do a second time"
else
    echo "critical_wind's table: SKIPPED, no pandas or matplotlib"
fi
# A wood without a strength is told before anything is made.
echo '{"format": "bough-material", "version": 1, "name": "own", "density": 800}' >own.json
for wood in european-asch own.json; do
    ! make -s -f "$top/data/critical_wind/Makefile" SCAN=other.csv WOOD=$wood >log 2>&1 || fail "critical_wind took $wood"
    grep -q "WOOD is '$wood'" log || fail "critical_wind with $wood says: $(cat log)"
done
! make -s -f "$top/data/critical_wind/Makefile" >log 2>&1 || fail "critical_wind took no scan"
grep -q 'SCAN is empty' log || fail "critical_wind without a scan says: $(cat log)"
