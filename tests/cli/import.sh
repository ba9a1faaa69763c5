# Files of other programs, from file to moving tree: each of the cases that are not ours is read, converted and simulated
# for 1 s (sanitized: one in five, for 0.2 s) in a gusty wind with finite results, or refused with exit 2 in one line; so are, unsanitized, its first half and itself with
# bytes changed at random. Nothing crashes, takes more than 1 GB or longer than its time.
source "$(dirname "$0")/common.sh"

# Run by every reader, with or without the cases.
fixtures=$top/data/fixtures
for file in cylinder_small.txt simpleforest_small.csv archi_small.csv shrub.mtg eztree_list.json shuffled.swc two_trees.txt two_trunks_spines.xml; do
    expect 0 treegen --import "$fixtures/$file" --stats --leaves -o tree.json
    for word in read units "up axis" roots height wood; do
        grep -q "^$word  *[A-Za-z0-9]" err || fail "--stats of $file does not tell $word: $(cat err)"
    done
    # Whatever was guessed or left out is a line of its own, which --strict turns into an error.
    notes=$(grep -c '^note ' err || true)
    ! grep -v -e ' has no leaves, ' err | grep -q '^treegen: ' || fail "$file: --stats tells a guess twice: $(cat err)"
    treegen --import "$fixtures/$file" --leaves -o tree.json 2>plain
    sed -i '/ has no leaves, /d' plain # which is no guess
    [[ $notes -eq $(grep -c '^treegen: ' plain) ]] || fail "$file: $notes lines in --stats, but $(grep -c '^treegen: ' plain) notes without"
    if ((notes > 0)); then
        refused 2 "(--strict)" treegen --import "$fixtures/$file" --strict -o strict.json
        refused 2 "(--strict)" treeconvert "$fixtures/$file" --strict -o strict.json
        absent strict.json
    fi
done
refused 1 "--stats" treegen --stats --seed 3
# Where the note says guessed, so do the statistics, whichever reader guessed.
for file in lines.obj tip_to_base.obj shrub.mtg; do
    expect 0 treegen --import "$fixtures/$file" --stats -o tree.json
    grep -q '^up axis  *[YZ] (guessed)' err && grep -q '^note  *up axis: ' err || fail "$file: $(cat err)"
    expect 0 treegen --import "$fixtures/$file" --up Y --stats -o tree.json
    grep -q '^up axis  *Y (given)' err && ! grep -q '^note  *up axis: ' err || fail "$file: $(cat err)"
done
expect 0 treeconvert "$fixtures/shrub.mtg" --units cm --up Z --stats -o tree.json
grep -q '^read  *MTG: 4 branches on 3 levels, 10 points' err || fail "--stats of the shrub: $(cat err)"
grep -q '^units  *cm (given)' err && grep -q '^up axis  *Z (given)' err && grep -q '^roots  *2' err || fail "$(cat err)"
grep -q '^height  *3 m, from 0 to 3; 4 by 0.3 m wide' err || fail "$(cat err)"

# A trunk without radii is guessed, said, and may be said otherwise; so may one that a file states.
expect 0 treegen --import "$fixtures/bare_bones.xml" -o tree.json
grep -q 'is taken as 0.08824 m thick at the base.*--trunk-diameter' err || fail "the guess is not told: $(cat err)"
expect 0 treegen --import "$fixtures/bare_bones.xml" --trunk-diameter 0.3 --stats -o tree.json
grep -q '^wood .* to 0.15 m' err && ! grep -q 'thick at the base' err || fail "$(cat err)"
expect 0 treeconvert "$fixtures/shuffled.swc" --trunk-diameter 0.5 -o tree.json
grep -q 'radii multiplied by' err || fail "$(cat err)"
refused 1 "--trunk-diameter: only with --import" treegen --trunk-diameter 0.3 --seed 3
refused 1 "--trunk-diameter" treegen --import "$fixtures/bare_bones.xml" --trunk-diameter 0 -o none.json
expect 0 treegen --bodies 20 -o own.json
refused 1 "--trunk-diameter: own.json is a bough document, whose radii are its own" treeconvert own.json --trunk-diameter 0.3 -o none.json

# Twigs that a scan cannot see; ground that gives way, by treeconvert as by the scene.
expect 0 treeconvert "$fixtures/archi_small.csv" --scan-radii --stats -o thin.json
grep -q '^note  *--scan-radii: [1-9][0-9]* of [0-9]* radii made thinner' err || fail "$(cat err)"
refused 1 "--scan-radii: own.json is a bough document, whose radii are its own" treeconvert own.json --scan-radii -o none.json
refused 1 "--scan-radii: only with --import" treegen --scan-radii --seed 3
expect 0 treeconvert "$fixtures/archi_small.csv" -o rigid.json
expect 0 treeconvert "$fixtures/archi_small.csv" --root-stiffness 2000 -o soft.json
treeprofile modes soft.json --modes 3 -q >soft.txt
treeprofile modes rigid.json --modes 3 -q >rigid.txt
treeprofile modes rigid.json --modes 3 -q --set material.root_stiffness=2000 >scene.txt
cmp -s soft.txt scene.txt || fail "root_stiffness of a scene is another than treeconvert's"
! cmp -s soft.txt rigid.txt || fail "--root-stiffness was passed over"
refused 1 "--root-stiffness" treeconvert "$fixtures/archi_small.csv" --root-stiffness 0 -o none.json
refused 2 "material/root_stiffness" treeprofile modes rigid.json --set material.root_stiffness=-1

# A scan has no leaves, and none grow on it: who asks for them is told.
expect 0 treegen --import "$fixtures/archi_small.csv" --leaves --fruit -o bare.json
for what in leaves fruit; do
    grep -q -- "--$what: $fixtures/archi_small.csv has no $what, and none grow on what is imported" err || fail "$(cat err)"
done

# Where memory ends, what was read is named. (A sanitizer maps terabytes.)
if [[ -z $sanitizers ]]; then
    awk 'BEGIN { print "1 2 0 0 0 1 -1"; for (k = 2; k < 600000; ++k) print k, 2, k % 9, k % 7, k % 5, 1, 1 }' >wide.swc
    for tool in treegen\ --import treeconvert; do
        code=0
        # shellcheck disable=SC2086 # two words
        (ulimit -v 250000 -c 0 && exec $tool wide.swc --units m --up z --threads 1 -o none.json) >out 2>err </dev/null || code=$?
        [[ $code -eq 2 ]] || fail "$tool without memory: exit $code: $(cat err)"
        one_line "wide.swc: out of memory while its" "${tool%% *}"
    done
    absent none.json
fi

# Wood that cannot carry what it is drawn with says what would, and --radii carry does.
cat >soft.swc <<'END'
1 2 0 0 0 0.01 -1
2 2 0 0 1 0.01 1
3 2 3 0 1 0.001 2
4 2 6 0 1 0.001 3
END
expect 0 treeconvert soft.swc --units m --up z -o soft.json
refused 2 "times as thick would carry it: treeconvert --radii carry" treesim soft.json --frames 2 --no-output
expect 0 treeconvert soft.swc --units m --up z --radii carry --stats -o carried.json
grep -q -- '--radii carry: 1 of 1 branch made thicker' err || fail "$(cat err)"
expect 0 treegen --import soft.swc --units m --up z --radii carry -o carried.splines.json
grep -q -- '--radii carry: [1-9][0-9]* of [0-9]* branch' err || fail "$(cat err)"
expect 0 treeconvert carried.splines.json -o of_splines.json
expect 0 treesim of_splines.json --frames 2 --no-output
expect 0 treegen --import soft.swc --units m --up z --radii file -o file.splines.json
refused 1 "--radii: only with --params or --import" treegen --radii carry --seed 3
expect 0 treesim carried.json --frames 2 --no-output

# What nobody can read is called by its name, whatever its content or its name says.
refuse_as() {
    local file=$1 text=$2
    cat >"$file"
    refused 2 "$text" treegen --import "$file" -o none.json
    absent none.json
}
printf 'SRT 07.0.0\0\1\2' | refuse_as tree.xml "compiled SpeedTree tree"
head -c 300 /dev/urandom | sed 's/^/x/' | refuse_as tree.spm "SpeedTree Modeler"
printf 'Ogawa\377\0\0' | refuse_as tree.bin "Alembic"
printf '#usda 1.0\n' | refuse_as tree.txt "USD"
printf 'PXR-USDC\0\0' | refuse_as tree.usd "USD"
printf 'MATLAB 5.0 MAT-file' | refuse_as QSM.csv "save_model_text"
printf '//Maya ASCII 2022 scene\n' | refuse_as tree.ma "Maya"
printf '\320\317\021\340\241\261\032\341' | refuse_as tree.max "3ds Max"
printf 'BLENDER-v340' | refuse_as tree.blend "Blender"
printf 'MM\1\2\0\0' | refuse_as tree.dat "3D Studio"
gzip -c "$fixtures/shrub.mtg" | refuse_as shrub.mtg.gz "gzip"
printf '<html><body>404</body></html>' | refuse_as tree.xml "web page"
refuse_as params.json "treegen --params" <"$top/data/eztree_sprig.json"
printf 'radius\tlength\n1\t2\n' | refuse_as table.txt "unknown format"

[[ -n ${BOUGH_CASES_DIR:-} && -d ${BOUGH_CASES_DIR:-} ]] || {
    echo "notice: BOUGH_CASES_DIR is not set, files of other programs are not tried"
    exit 0
}

# What is to be read, by its path; all else is to be refused.
readable='^(speedtree/|measured/.*\.csv$|qsm/.*\.(txt|csv)$|sapling/.*\.(csv|json)$|sapling/.*\.(lines|nurbs|nurbs_py)\.obj$'
readable+='|skeleton/.*\.(swc|ply)$|skeleton/reconstructed_appletree\.mtg$|eztree/.*\.branches\.json$'
readable+='|invalid/Neuron(-flat|_zero_length_segments)\.swc$|models/testline\.obj$'
# Armatures.
readable+='|sapling/.*\.(fbx|gltf|glb|dae)$|models/(animation_with_skeleton\.fbx|simple_skin\.gltf)$)'
# Address space: the tools map some libraries, 1.5 GB leaves them what they take without a file and 1 GB. (A sanitizer maps terabytes.)
space=1572864
seconds=1
[[ -z $sanitizers ]] || space=unlimited seconds=0.2
limited() {
    local seconds=$1
    shift
    (ulimit -v "$space" -c 0 && exec timeout "$seconds" "$@")
}

cd "$BOUGH_CASES_DIR"
mapfile -t cases < <(find . -type f ! -name README.md -printf '%P\n' | sort)
cd "$work"
at=0
for name in "${cases[@]}"; do
    # Sanitized, every fifth: formats/imports/foreign_files has the readers of all, and the unsanitized tools take all.
    [[ -z $sanitizers || $((at++ % 5)) -eq 0 ]] || continue
    code=0
    limited 60 treeconvert "$BOUGH_CASES_DIR/$name" -q -o tree.json >out 2>err </dev/null || code=$?
    if [[ $code -eq 2 ]]; then
        one_line "$(basename "$name")" treeconvert
        [[ ! $name =~ $readable ]] || fail "$name is to be read: $(cat err)"
        continue
    fi
    [[ $code -eq 0 && ! -s err ]] || fail "exit $code of treeconvert $name, expected 0 or 2: $(head -c 300 err)"
    [[ $name =~ $readable ]] || fail "$name was read, expected a refusal"
    code=0
    limited 120 treesim tree.json -q --seconds "$seconds" --settle 0 --wind gusty --no-output --report hash >out 2>err </dev/null || code=$?
    if [[ $code -eq 2 ]]; then # neurons, metres long, and branches drawn for pictures: no wood carries them
        one_line "too soft to carry its weight" treesim
        echo "notice: $name is read, but its wood is too soft to stand"
    elif [[ $code -ne 0 ]]; then
        fail "exit $code of treesim on $name: $(head -c 300 err)"
    fi
done

# Damage. Sizes are kept small: what readers do with size is not what is asked here. (The readers alone, sanitized: formats/imports/foreign_files.)
[[ -z $sanitizers ]] || exit 0
damaged() {
    local name=$1 file=$2 code=0
    limited 60 treegen --import "$file" -q -o tree.json >out 2>err </dev/null || code=$?
    [[ $code -eq 0 || $code -eq 2 ]] || fail "exit $code of treegen on $name, damaged ($(basename "$file")): $(head -c 300 err)"
    [[ $code -eq 0 || $(wc -l <err) -eq 1 ]] || fail "$name, damaged: $(cat err)"
}
seed=1
for name in "${cases[@]}"; do
    size=$(stat -c %s "$BOUGH_CASES_DIR/$name")
    ((size > 0)) || continue
    copy=damaged_$(basename "$name")
    head -c $((size / 2)) "$BOUGH_CASES_DIR/$name" >"$copy"
    damaged "$name" "$copy"
    for _ in 1 2; do
        seed=$((seed + 1))
        perl -e 'my ($from, $to, $seed) = @ARGV; srand $seed; local $/; open my $in, "<:raw", $from or die; my $bytes = <$in>;
            substr($bytes, int rand length $bytes, 1) = chr int rand 256 for 1 .. 12; open my $out, ">:raw", $to or die; print $out $bytes; close $out or die' \
            "$BOUGH_CASES_DIR/$name" "$copy" "$seed"
        damaged "$name" "$copy"
    done
    rm -f "$copy"
done
