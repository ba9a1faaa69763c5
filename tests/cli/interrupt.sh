#!/usr/bin/env bash
# Ctrl-C ends a run at a frame boundary with a shorter, valid output and exit code 130.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 3000 --seed 3 | treeconvert - -o tree.json

# stop FILE COMMAND...: starts it as a shell starts a foreground job (SIGINT not ignored), interrupts it once FILE says
# that frames are made (it is longer than it was at first, or a numbered one is there; `unfinished`: what it writes that has no name yet; a .glb is
# empty until its end, so 3 s after it is there), and checks the code. A header may make a file longer too: a run that says that it was interrupted before
# its first frame is made again and given ten times as long, so that a busy machine decides nothing.
stop() {
    local code wait
    for wait in 0.3 3 30 300; do
        code=0
        interrupt "$wait" "$@" || code=$?
        grep -q "interrupted before the first frame" err || break
    done
    [[ $code -eq 130 ]] || fail "exit $code after an interrupt, expected 130: $* ($(cat err))"
    one_line "interrupted after frame" "${@:2}"
}
interrupt() { # SECONDS FILE COMMAND...
    python3 - "$@" <<'END'
import signal, subprocess, sys, time
wait, watched, command = float(sys.argv[1]), sys.argv[2], sys.argv[3:]
child = subprocess.Popen(command, stderr=open("err", "wb"), stdout=open("out", "wb"), stdin=subprocess.DEVNULL,
                         preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
import glob, os
def unfinished(): # open, in this folder, and without a name or with a hidden one
    for link in glob.glob(f"/proc/{child.pid}/fd/*"):
        try:
            name = os.readlink(link)
            if name.startswith(os.getcwd()) and (name.endswith(" (deleted)") or "/.bough-" in name):
                yield name, os.stat(link).st_size
        except FileNotFoundError:
            pass
def sizes():
    return unfinished() if watched == "unfinished" else ((f, os.path.getsize(f)) for f in glob.glob(watched))
first = {}
def grown():
    return any("%" in " ".join(command) or size > first.setdefault(name, size or 1e9) for name, size in sizes() if size > 0)
end = time.time() + 60
empty_until_done = command[-1].endswith(".glb")
while child.poll() is None and time.time() < end and not (any(sizes()) if empty_until_done else grown()):
    time.sleep(0.01)
time.sleep(max(wait, 3 if empty_until_done else 0))
child.send_signal(signal.SIGINT)
sys.exit(child.wait())
END
}

stop out treesim -q tree.json --frames 1000000
python3 -c '
import json
frames = [json.loads(line) for line in open("out")][1:]
assert [f["frame"] for f in frames] == list(range(len(frames))) and frames' || fail "the JSON lines are not whole"

# What a shell leads into a file is kept as what -o names is: its size is said. What goes through a pipe is not.
for wait in 0.3 3 30; do
    interrupt "$wait" out treesim tree.json --frames 1000000 || true
    ! grep -q 'the output will be about [0-9.]* [GT]B' err || break
done
grep -q 'the output will be about [0-9.]* [GT]B' err || fail "nothing is said of a large file's size: $(cat err)"
{ treesim tree.json --frames 1000000 2>err || true; } | head -c 2000000 >/dev/null
! grep -q 'will be about' err || fail "the size of what goes through a pipe is said: $(cat err)"

stop unfinished treesim -q tree.json --frames 1000000 -o cut.json
python3 -c 'import json; assert json.load(open("cut.json"))' || fail "the JSON is not whole"

stop unfinished treesim -q tree.json --frames 1000000 -o cut.glb
python3 -c '
import json, struct
data = open("cut.glb", "rb").read()
size, length = struct.unpack("<II", data[8:16])
assert size == len(data) and json.loads(data[20:20 + length])["animations"]' || fail "the .glb is not whole"

mkdir frames
stop 'frames/m_0003.obj' treesim -q tree.json --frames 1000000 -o frames/m_%04d.obj --save-state state.json
[[ $(for f in frames/m_*.obj; do grep -c '^f ' "$f"; done | sort -u | wc -l) -eq 1 ]] || fail "a mesh is not whole"

# The state saved by an interrupted run goes on.
expect 0 treesim tree.json --resume state.json --frames 2 -o rest.jsonl
last=$(find frames -name 'm_*.obj' | wc -l)
grep -q "\"frame\": *$last[,}]" rest.jsonl || fail "the run does not go on with frame $last"
absent

# At whatever moment: some frames, or no file.
python3 - <<'END' || fail "interrupted before the first frame"
import os, signal, struct, subprocess, time
for k in range(12):
    child = subprocess.Popen(["treesim", "-q", "--settle", "0", "tree.json", "--frames", "1000000", "-o", "early.mdd"], stderr=subprocess.PIPE,
                             preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    time.sleep(0.02 * k)
    child.send_signal(signal.SIGINT)
    told = child.communicate()[1]
    if os.path.exists("early.mdd"):
        frames = struct.unpack(">i", open("early.mdd", "rb").read(4))[0]
        assert frames > 0 and b"after frame" in told, (frames, told)
        os.remove("early.mdd")
    else:
        assert b"after frame" not in told, told
END
absent

# A point cache tells its number of frames first: it is mended.
for form in mdd pc2; do
    stop unfinished treesim -q tree.json --frames 1000000 -o cut.$form
    python3 - cut.$form <<'END' || fail "a .$form cut short"
import os, struct, sys
head = open(sys.argv[1], "rb").read(32)
if sys.argv[1].endswith("mdd"):
    frames, vertices = struct.unpack(">2i", head[:8])
    size = 8 + 4 * frames + 12 * frames * vertices
else:
    _, _, vertices, _, _, frames = struct.unpack("<12siiffi", head)
    size = 32 + 12 * frames * vertices
assert os.path.getsize(sys.argv[1]) == size and 0 < frames < 1000000, (frames, vertices, size)
END
    rm -f cut.$form
done
absent
