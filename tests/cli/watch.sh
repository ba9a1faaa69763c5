#!/usr/bin/env bash
# --watch: a run for each change of what it reads, an error that can be mended, Ctrl-C.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

treegen --age 12 --bodies 40 --seed 3 | treeconvert - -o tree.json
cp tree.json other.json
echo '{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}]}' >scene.json

cat >watch.py <<'END'
import os, re, signal, subprocess, sys, time
out = sys.argv[1]
open("wind.json", "w").write('{"format": "bough-wind", "version": 1, "velocity": [4, 0, 0]}')
log = open("log", "wb")
child = subprocess.Popen(["treesim", "scene.json", "--wind", "wind.json", "--watch", "--frames", "5", "-o", out], stderr=log,
                         stdin=subprocess.DEVNULL, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
def lines(): return open("log").read().splitlines()
def wait_for(count, text):
    end = time.time() + 60
    while len(lines()) < count:
        assert child.poll() is None, ("ended", lines())
        assert time.time() < end, ("no line", count, lines())
        time.sleep(0.05)
    assert text in lines()[count - 1], (text, lines())
def scene(text): open("scene.json", "w").write('{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}]' + text)
try:
    wait_for(1, out + ": 5 frames, ")
    assert re.match(r"treesim: \d\d:\d\d:\d\d .* \d+ ms$", lines()[0]), lines()
    first = open(out, "rb").read()
    scene(', "gravity": [0, 0, 0]}')                               # written in place
    wait_for(2, out + ": 5 frames, ")
    second = open(out, "rb").read()
    assert second != first
    scene(', "gravty": [0, 0, 0]}')                                # broken ...
    wait_for(3, "scene.json: /gravty: is an unknown field")
    assert open(out, "rb").read() == second                        # ... and the last good one stays
    open("new", "w").write('{"format": "bough-scene", "version": 1, "trees": [{"file": "tree.json"}]}')
    os.rename("new", "scene.json")                                 # mended, as editors do that write beside and rename
    wait_for(4, out + ": 5 frames, ")
    assert open(out, "rb").read() == first
    text = open("other.json").read()                               # a tree: gone and there again is one change or two
    open("tree.json", "w").write(text.replace('"name"', ' "name"', 1))
    wait_for(5, out + ": 5 frames, ")
    open("wind.json", "w").write('{"format": "bough-wind", "version": 1, "velocity": [0, 0, 9]}')
    wait_for(6, out + ": 5 frames, ")
    assert open(out, "rb").read() != first
    time.sleep(1)                                                  # nothing changes, nothing is run
    assert len(lines()) == 6, lines()
finally:
    child.send_signal(signal.SIGINT)
    code = child.wait(60)
assert code == 130, code
assert "no longer watching" in lines()[-1], lines()
END
python3 watch.py out.glb || fail "--watch: $(cat log)"
python3 watch.py out.jsonl || fail "--watch with JSON lines: $(cat log)"
absent

refused 1 "--watch: not with stdin" treesim - --watch -o out.glb
refused 1 "--watch: needs -o FILE" treesim scene.json --watch
refused 1 "--watch: needs -o FILE" treesim scene.json --watch --no-output
refused 1 "--watch: not with --resume" treesim scene.json --watch -o out.glb --resume state.json
refused 1 "which is one of the files that are read" treesim scene.json --watch --format jsonl -o ./tree.json

# Interrupted in a run: what was there before stays, whole.
treesim scene.json --frames 2 -o long.json
cp long.json before.json
python3 - <<'END' || fail "an interrupt while it runs: $(cat err)"
import glob, os, signal, subprocess, time
child = subprocess.Popen(["treesim", "scene.json", "--watch", "--frames", "1000000", "-o", "long.json"], stderr=open("err", "wb"),
                         stdin=subprocess.DEVNULL, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
end = time.time() + 60
def unfinished(): # a temporary file, with a name or without
    links = [os.readlink(fd) for fd in glob.glob(f"/proc/{child.pid}/fd/*") if os.path.islink(fd)]
    return glob.glob(".bough-*") or [link for link in links if link.startswith(os.getcwd()) and link.endswith("(deleted)")]
while child.poll() is None and time.time() < end and not unfinished(): time.sleep(0.01)
time.sleep(0.3)
child.send_signal(signal.SIGINT)
assert child.wait(60) == 130, child.returncode
END
same long.json before.json
absent
