#!/usr/bin/env bash
# An output appears whole under its name or not at all, outputs are told apart by their files, and what cannot be written is known before
# the work is done.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 60 --seed 3 -q -o splines.json
treeconvert splines.json -q -o tree.json
run=(treesim tree.json --frames 3)

# Outputs that are one file, under whatever name: refused before anything is written.
ln -s q.json to_q.json
mkdir there
ln -s there also
mkfifo pipe
ln -s state.json f_0002.obj
refused 1 "the same file as -o" "${run[@]}" -o x.json --save-tree ./x.json
refused 1 "the same file as -o" "${run[@]}" -o there/x.json --save-state also/x.json
refused 1 "the same file as --save-state" "${run[@]}" --no-output --save-state ./q.json --save-tree q.json
refused 1 "the same file as --save-state" "${run[@]}" --no-output --save-state q.json --save-tree to_q.json
refused 1 "the same file as --save-state" "${run[@]}" --no-output --save-state pipe --save-tree ./pipe
refused 1 "the same file as the .mtl of -o" "${run[@]}" -o f_%d.obj --save-state f.mtl
refused 1 "the same file as -o" "${run[@]}" -o f_%d.obj --save-state f_17.obj
refused 1 "the same file as -o" "${run[@]}" -o f_%04d.obj --save-state state.json
refused 1 "the same file as -o" treeconvert splines.json -o x.glb --format json --mesh ./x.glb
refused 1 "the .mtl of --mesh" treeconvert splines.json -o x.mtl --format json --mesh x.obj
refused 1 "the same file as -o" treeconvert splines.json --split -o t_%d.glb --format json --mesh t_%02d.glb
refused 1 "the same file as -o" treeprofile stages tree.json -o x.json --report there/../x.json
code=0
"${run[@]}" --save-tree x.json >x.json 2>err </dev/null || code=$?
[[ $code -eq 1 ]] || fail "exit $code where stdout is the file of --save-tree, expected 1: $(cat err)"
cp tree.json f_0007.obj
refused 1 "which INPUT reads" treesim f_0007.obj --frames 3 -o f_%04d.obj
same tree.json f_0007.obj
# A species document is read too.
cp "$top/data/species/oak.json" look.json
for file in "--save-tree look.json -o x.glb" "--save-state look.json -o x.glb" "-o look.json --format glb"; do
    # shellcheck disable=SC2086
    refused 1 "which --look reads" treesim tree.json --frames 2 --look look.json $file
done
refused 1 "which --look reads" treeconvert splines.json --look look.json -o look.json --mesh x.glb
same "$top/data/species/oak.json" look.json
# Two files of a sequence that are one, by links.
ln -s w_1.json w_0.json
refused 1 "is a link to the file of 'w_1.json'" treeconvert "$top/data/fixtures/two_trunks_spines.xml" --split -o w_%d.json
ln -s w.obj w_0.obj
expect 0 "${run[@]}" -o w_%d.obj
[[ -L w_0.obj && -s w.obj && -s w_1.obj ]] || fail "one link of a sequence is no place for its file"
rm -f w_1.obj
ln -s w.obj w_1.obj
refused 1 "is a link to the file of 'w_0.obj'" "${run[@]}" -o w_%d.obj
# A name with room for the numbers that are written, not for eighteen digits.
long=$(printf 'n%.0s' {1..245})
expect 0 "${run[@]}" -o "${long}_%d.obj"
rm -f x.json f_0002.obj "$long"_* w.obj w_*
absent x.glb x.mtl x.obj q.json state.json f.mtl f_0001.obj
# Not one file: other names, other folders, what swallows all.
expect 0 "${run[@]}" -o there/x.json --save-state x.json --save-tree y.json
expect 0 "${run[@]}" -o /dev/null --save-state /dev/null --save-tree /dev/null

# A pipe with a name brings what it has once, however often its path is opened.
wanted=$(treesim - --frames 3 --no-output --report hash 2>&1 <tree.json | grep ^hash)
found=$(treesim <(cat tree.json) --frames 3 --no-output --report hash 2>&1 | grep ^hash) || true
[[ $found == "$wanted" ]] || fail "a tree by <(...) has $found, by stdin $wanted"
(cat tree.json >pipe &)
found=$(timeout 60 treesim pipe --frames 3 --no-output --report hash 2>&1 | grep ^hash) || true
[[ $found == "$wanted" ]] || fail "a tree by a named pipe has $found, by stdin $wanted"
(cat tree.json >pipe &)
timeout 60 treeprofile modes pipe -q >/dev/null 2>err || fail "treeprofile modes of a named pipe: $(cat err)"

# A folder that is not there, or may not be written to, is said before the first frame: a run that would take hours ends at once.
long=(treesim tree.json --seconds 1e9)
refused 4 "missing/s.json: cannot be" "${long[@]}" --no-output --save-state missing/s.json
refused 4 "missing/t.json: cannot be" "${long[@]}" --no-output --save-tree missing/t.json
refused 4 "missing/m.jsonl: cannot be" "${long[@]}" -o missing/m.jsonl
refused 4 "missing/f_0000.obj: cannot be" "${long[@]}" -o missing/f_%04d.obj
refused 4 "there: cannot be written: Is a directory" "${long[@]}" --no-output --save-state there
refused 4 "missing/r.json: cannot be" treeprofile stages tree.json --seconds 1e6 --report missing/r.json
refused 4 "missing/x.json: cannot be" treegen --bodies 20000000 -o missing/x.json
refused 1 "the same file as -o" "${long[@]}" -o oak_vat/ --save-state oak_vat
absent
# So is what the system will not let go of: a file on which another is mounted, another user's in a folder such as /tmp.
: >under.json
if mount --bind tree.json under.json 2>/dev/null; then
    code=0
    "${long[@]}" -o under.json 2>err || code=$?
    umount under.json
    [[ $code -eq 4 ]] && grep -q "under.json: cannot be replaced" err || fail "a mount point: exit $code, $(cat err)"
fi
other=(setpriv --reuid 65534 --regid 65534 --clear-groups "$(type -P treesim)")
if [[ $EUID -eq 0 ]] && "${other[@]}" --version >/dev/null 2>&1; then
    shared=$(mktemp -d /tmp/bough-test-XXXXXX)
    chmod 1777 "$shared"
    cp tree.json "$shared/in.json"
    : >"$shared/out.json"
    chmod 666 "$shared"/*.json
    code=0
    "${other[@]}" "$shared/in.json" --seconds 1e9 -o "$shared/out.json" 2>err || code=$?
    [[ $code -eq 4 ]] && grep -q "out.json: cannot be replaced" err || fail "another's file in a shared folder: exit $code, $(cat err)"
    rm -r "$shared"
fi
rm -f under.json

# Whatever ends a run, no unfinished file stays: killed, quit, out of processor time, interrupted twice.
if [[ -d /dev/shm && -w /dev/shm ]]; then folders="$work/killed $(mktemp -d /dev/shm/bough-test-XXXXXX)"; else folders=$work/killed; fi
mkdir killed
ended() { # SIGNAL[,SIGNAL] CODE FILE OPTION...
    local code=0
    python3 - "$@" <<'END' || code=$?
import glob, os, signal, subprocess, sys, time
signals, file, command = sys.argv[1].split(","), sys.argv[3], ["treesim", "-q", "tree.json", *sys.argv[4:], "-o", sys.argv[3]]
def prepare():
    for s in signal.SIGINT, signal.SIGQUIT: signal.signal(s, signal.SIG_DFL)
child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=open("err", "wb"), preexec_fn=prepare)
first = {}
def written(): # more than it began with
    for link in glob.glob(f"/proc/{child.pid}/fd/*"):
        try:
            if os.readlink(link).startswith(os.path.dirname(file)):
                size = os.stat(link).st_size
                if size > 0 and size > first.setdefault(link, size): return True
        except FileNotFoundError: pass
end = time.time() + 60
while child.poll() is None and time.time() < end and not written(): time.sleep(0.01)
for s in signals:
    child.send_signal(getattr(signal, s))
code = child.wait()
sys.exit(code if code >= 0 else 128 - code)
END
    [[ $code -eq $2 ]] || fail "exit $code after $1, expected $2 ($(cat err))"
    [[ -z $(find "$(dirname "$3")" -name '.bough-*') ]] || fail "left after $1: $(ls -A "$(dirname "$3")")"
}
for folder in $folders; do
    echo "whole before" >"$folder/o.json"
    ended SIGKILL 137 "$folder/o.json" --frames 10000000
    ended SIGQUIT 131 "$folder/o.json" --frames 10000000
    [[ $(cat "$folder/o.json") == "whole before" ]] || fail "$folder/o.json is not what it was"
    for k in 1 2 3 4 5 6 7 8 9 10; do ended SIGINT,SIGINT 130 "$folder/twice.json" --frames 10000000; done
    ended SIGXCPU 152 "$folder/cpu.json" --frames 10000000
    python3 -c 'import json, sys; json.load(open(sys.argv[1]))' "$folder/cpu.json" || fail "the JSON cut short by SIGXCPU is not whole"
done
[[ $folders != *shm* ]] || rm -rf "${folders#* }"
# What a kill has left where files without names are not to be had is taken away by the next run there; what lives, stays.
touch killed/.bough-1-1.tmp killed/.bough-2-7.tmp
exec 9>killed/.bough-2-7.tmp
if flock -n 9; then
    expect 0 "${run[@]}" -o killed/next.json
    [[ ! -e killed/.bough-1-1.tmp && -e killed/.bough-2-7.tmp ]] || fail "not what is left was taken away: $(ls -A killed)"
fi
exec 9>&-
rm killed/.bough-2-7.tmp

# A file larger than the shell allows is an output that cannot be written.
code=0
(ulimit -f 8 && exec treesim tree.json --frames 1000 -o large.json) >out 2>err </dev/null || code=$?
[[ $code -eq 4 ]] || fail "exit $code beyond ulimit -f, expected 4: $(cat err)"
one_line "large.json: cannot be written: File too large" treesim
absent large.json

# A shorter sequence says which frames of an earlier run stay behind it.
expect 0 treesim tree.json --frames 6 -o s_%03d.obj
! grep -q "s_" err || fail "a first sequence says: $(cat err)"
expect 0 treesim tree.json --frames 4 -o s_%03d.obj
grep -q "s_%03d.obj: 2 frames of an earlier run stay behind the last one: s_004.obj to s_005.obj" err ||
    fail "nothing is said of older frames: $(cat err)"
touch s_0099.obj s_x.obj s_099.txt # no frames of this sequence
rm s_004.obj s_005.obj
expect 0 treesim tree.json --frames 4 -o s_%03d.obj
! grep -q "s_" err || fail "what is no frame is taken for one: $(cat err)"

# Inputs without an end.
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "/dev/zero"}]}' >zero.json
refused 2 "names '/dev/zero', which is no regular file" treesim zero.json --frames 2 --outside
refused 2 "is a device" treeconvert /dev/urandom -o endless.json
refused 2 "is a device" treegen --params /dev/zero -o endless.json
absent endless.json
