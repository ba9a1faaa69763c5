"""faults_runs.py: the runs of tests/faults: which lines of the tools, their inputs, one run, and the judgement of how it ended and what it left. What goes
wrong with them is in tests/faults."""
import functools
import json
import os
import re
import resource
import shutil
import signal
import struct
import subprocess
import tempfile
import time

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
place = {"tools": os.path.join(TOP, "build", "tools")}
failed = []  # kinds, one for each that did not hold


def tools_of(build):
    place["tools"] = os.path.join(os.path.abspath(build), "tools")


def tool(line, **names):
    words = [word.format(**names) for word in line.split()]
    return [os.path.join(place["tools"], words[0]), *words[1:]]


# What each writes, {o}: into which folder. Its outputs are what is there afterwards. (.obj and .dae are read by a process of its own, as FBX is, of which
# no file is in data/.)
WRITERS = [
    "treegen -q --bodies 3000 --seed 3 --no-source -o {o}/a.json",
    "treegen -q --bodies 3000 --seed 3 --leaves --no-source -o {o}/a.safetensors",
    "treegen -q --bodies 3000 --seed 3 --no-source -o {o}/a.swc",
    "treegen -q --import {i}/splines.json --no-source -o {o}/a.txt",
    "treegen -q --envelope sphere --seed 3 --no-source -o {o}/a.json",
    "treegen -q --envelope {i}/cube.obj --bodies 300 --seed 3 --no-source -o {o}/a.json",
    "treeconvert -q {i}/twig_joints.dae --no-source -o {o}/t.json",
    "treeconvert -q {i}/splines.json --no-source -o {o}/t.json --mesh {o}/m.obj",
    "treeconvert -q {i}/splines.json --no-source -o {o}/t.safetensors --mesh {o}/m.glb --wind-groups {o}/w.json",
    "treeconvert -q {i}/two.xml --no-source --split -o {o}/t_%d.json --mesh {o}/m_%d.glb",
    "treesim -q --settle 0 {i}/tree.json --wind gusty --frames 90 --no-source -o {o}/m.jsonl",
    "treesim -q --settle 0 {i}/tree.json --wind gusty --frames 90 --no-source -o {o}/m.json --save-state {o}/s.json --save-tree {o}/t.json",
    "treesim -q --settle 0 {i}/tree.json --wind gusty --frames 90 --no-source -o {o}/m.safetensors --save-state {o}/s.safetensors",
    "treesim -q --settle 0 {i}/tree.safetensors --wind gusty --frames 30 --no-source -o {o}/m.glb",
    "treesim -q --settle 0 {i}/tree.json --wind gusty --frames 12 --no-source -o {o}/f_%03d.obj",
    "treesim -q --settle 0 {i}/tree.json --wind gusty --frames 30 --no-source -o {o}/m.mdd",
    "treesim -q --settle 0 {i}/tree.json --wind gusty --frames 30 --no-source -o {o}/m.pc2",
    "treesim -q --settle 0 {i}/scene.json --frames 60 --no-source -o {o}/m.jsonl --threads 2",
    "treesim -q --settle 0 {i}/tree.json --look birch --wind gusty --frames 12 --no-source -o {o}/m.usda",
    "treesim -q --settle 0 {i}/meshed_tree.xml --wind gusty --frames 30 --no-source -o {o}/m.pc2",
    "treesim -q --settle 0 {i}/twig_joints.dae --wind gusty --frames 30 --no-source -o {o}/m.glb",
    "treesim -q --settle 0 {i}/twig.json --skin {i}/twig_armature.gltf --wind gusty --frames 30 --no-source -o {o}/m.usda",
    "treesim -q --settle 0 {i}/tree.json --wind gusty --frames 12 --no-source --vat-vertices 8000 -o {o}/m_vat/",
    "treesim join -q {i}/part1.jsonl {i}/part2.jsonl --no-source -o {o}/j.jsonl",
    "treesim join -q {i}/part1.jsonl {i}/part2.jsonl --no-source -o {o}/j.safetensors",
    "treeprofile modes {i}/tree.json -q --modes 3 --no-source -o {o}/modes.glb --report {o}/modes.svg",
    "treeprofile error {i}/small.json -q --frames 4 --steps 1 --no-source -o {o}/e.txt --report {o}/e.html",
]
INTO_A_FOLDER = "_vat/"
READERS = [
    "treeconvert -q {i}/splines.json --no-source -o {o}/t.json",
    "treeconvert -q {i}/splines.safetensors --no-source -o {o}/t.json",
    "treeconvert -q {i}/two.xml --no-source -o {o}/t.json",
    "treesim -q --settle 0 {i}/tree.json --frames 3 --no-source -o {o}/m.jsonl",
    "treesim -q --settle 0 {i}/tree.safetensors --frames 3 --no-source -o {o}/m.jsonl",
    "treesim -q --settle 0 {i}/scene.json --frames 3 --no-source -o {o}/m.jsonl",
    "treeprofile stages {i}/tree.json --frames 4 --repeat 1 -o {o}/r.txt --report {o}/r.json",
]
TIMED = ("treeprofile stages", "treeprofile error")  # write times, others each time
UNABLE = 127  # the loader's, where it cannot map a library: no program has begun
EXITS = {0, 1, 2, 3, 4, 128 + signal.SIGINT, 128 + signal.SIGTERM, 128 + signal.SIGHUP, 128 + signal.SIGQUIT, 128 + signal.SIGXCPU}


def wrong(kind, line, what):
    failed.append(kind)
    print(f"  {kind}: {what}: {line}", flush=True)


def contents(folder):
    found = {}
    for at, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(at, name)
            if os.path.isfile(path) and not os.path.islink(path):
                with open(path, "rb") as file:
                    found[os.path.relpath(path, folder)] = file.read()
    return found


def put(folder, name, content):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content)
    return path


def inputs(folder):
    def make(line):
        subprocess.run(tool(line, i=folder, o=folder), check=True, stderr=subprocess.DEVNULL)

    make("treegen -q --bodies 2000 --seed 3 --leaves -o {o}/splines.json")
    make("treegen -q --import {i}/splines.json --leaves -o {o}/splines.safetensors")
    make("treeconvert -q {i}/splines.json -o {o}/tree.json")
    make("treeconvert -q {i}/splines.json -o {o}/tree.safetensors")
    make("treegen -q --bodies 20 --seed 3 -o {o}/small_splines.json")
    make("treeconvert -q {i}/small_splines.json -o {o}/small.json")
    for name in ("meshed_tree.xml", "twig_joints.dae", "twig_armature.gltf", "twig_bark.bin"):
        shutil.copy(os.path.join(TOP, "data/fixtures", name), folder)
    shutil.copy(os.path.join(TOP, "data/fixtures/two_trunks_spines.xml"), os.path.join(folder, "two.xml"))
    make("treeconvert -q {i}/twig_armature.gltf -o {o}/twig.json")
    put(folder, "cube.obj", ("".join(f"v {k % 2 * 3} {k // 2 % 2 * 3} {k // 4 * 3}\n" for k in range(8)) +
                             "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n").encode())
    with open(os.path.join(folder, "scene.json"), "w") as file:
        file.write('{"format": "bough-scene", "version": 1, "wind": "gusty", "fracture": {"leaf": 0.001},'
                   '"trees": [{"file": "tree.json"}, {"file": "tree.safetensors", "position": [9, 0, 0]}]}')
    with open(os.path.join(folder, "park.json"), "w") as file:
        file.write('{"format": "bough-scene", "version": 1, "wind": "gusty", "trees": [{"file": "tree.json"}, {"file": "tree.json", "position": [9, 0, 0]}]}')
    for part in (1, 2):
        make(f"treesim -q --settle 0 {{i}}/park.json --frames 30 --shard {part}/2 -o {{o}}/part{part}.jsonl")


@functools.cache
def whole_outputs(line, folder):
    """What it writes when nothing goes wrong, and how long that takes."""
    out = tempfile.mkdtemp(dir=folder)
    start = time.monotonic()
    subprocess.run(tool(line, i=folder, o=out), check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    seconds = time.monotonic() - start
    found = contents(out)
    shutil.rmtree(out)
    return found, seconds


def run(line, source, out, limit=None, **more):
    """Exit code as a shell has it, and stderr. SIGINT and SIGQUIT are not ignored, as they are in background jobs."""
    def prepare():
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        signal.signal(signal.SIGQUIT, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if limit:
            resource.setrlimit(limit[0], limit[1])

    child = subprocess.Popen(tool(line, i=source, o=out), stdin=more.pop("stdin", subprocess.DEVNULL),
                             stdout=more.pop("stdout", subprocess.DEVNULL), stderr=subprocess.PIPE, preexec_fn=prepare, **more)
    return child


def ended(kind, line, child, timeout=120):
    try:
        _, err = child.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        child.kill()
        child.communicate()
        wrong(kind, line, "did not end")
        return None
    code = child.returncode if child.returncode >= 0 else 128 - child.returncode
    if code not in EXITS | {UNABLE, 128 + signal.SIGKILL}:
        wrong(kind, line, f"exit {code}: {err[:200]!r}")
    if code in (1, 2, 4) and (err.count(b"\n") != 1 or not err.endswith(b"\n")):
        wrong(kind, line, f"exit {code} with {err.count(bytes([10]))} lines on stderr: {err[:300]!r}")
    try:
        err.decode()
    except UnicodeDecodeError:
        wrong(kind, line, f"stderr is no UTF-8: {err[:200]!r}")
    return code


def hidden(folder):
    return [name for _, folders, names in os.walk(folder) for name in folders + names if name.startswith(".bough-")]


def safetensors(data):
    size = struct.unpack_from("<Q", data)[0]
    header = json.loads(data[8:8 + size])
    return 8 + size + max(entry["data_offsets"][1] for name, entry in header.items() if name != "__metadata__") == len(data)


def glb(data):
    size, text = struct.unpack_from("<2I", data, 8)
    return size == len(data) == 28 + text + struct.unpack_from("<I", data, 20 + text)[0] and json.loads(data[20:20 + text])


def usda(data):
    last = int(re.search(rb"endTimeCode = (\d+)", data)[1])
    return all(data.count(a) == data.count(b) for a, b in (b"{}", b"[]", b"()")) and max(map(int, re.findall(rb"^ +(\d+): [\[(]", data, re.M))) == last


def exr(data):
    at = 8
    while data[at] != 0:  # attributes: name, type, size, value
        at = data.index(0, data.index(0, at) + 1) + 1
        at += 4 + struct.unpack_from("<I", data, at)[0]
    first = struct.unpack_from("<Q", data, at + 1)[0]  # blocks stand behind the table of their places
    last = max(struct.unpack_from(f"<{(first - at - 1) // 8}Q", data, at + 1))
    return last + 8 + struct.unpack_from("<I", data, last + 4)[0] == len(data)


def mdd(data):
    frames, points = struct.unpack_from(">2I", data)
    return len(data) == 8 + 4 * frames + 12 * frames * points


def pc2(data):
    points, frames = struct.unpack_from("<I", data, 16)[0], struct.unpack_from("<I", data, 28)[0]
    return data.startswith(b"POINTCACHE2\0") and len(data) == 32 + 12 * points * frames


# Whether a file is whole by itself, for the endings of those that may be shorter than they would have become, or differ each time.
WHOLE = {"json": json.loads, "jsonl": lambda data: data.endswith(b"\n") and [json.loads(line) for line in data.splitlines()], "safetensors": safetensors,
         "glb": glb, "usda": usda, "exr": exr, "mdd": mdd, "pc2": pc2, "html": lambda data: data.endswith(b"</html>\n"),
         "txt": lambda data: data.endswith(b"\n")}


def whole_by_itself(name, content):
    try:
        return bool(WHOLE.get(name.rsplit(".")[-1], lambda data: False)(content))
    except (ValueError, LookupError, TypeError, struct.error):
        return False


def judge(kind, line, out, before, whole, cut=False):
    """Every file is whole, as it was before, or absent. cut: a run that was interrupted may have written a shorter whole one."""
    alone = cut or line.startswith(TIMED)
    for name in hidden(out):
        wrong(kind, line, f"{name} was left behind")
    for name, content in contents(out).items():
        if content not in (before.get(name), whole.get(name)) and not (alone and whole_by_itself(name, content)):
            wrong(kind, line, f"{name} has {len(content)} bytes, whole are {len(whole.get(name, b''))}")
