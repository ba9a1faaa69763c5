"""Reads documents that safetensors.cpp wrote with nothing but struct, json and numpy: both forms must hold the same
numbers bit by bit. Usage: safetensors.py PROGRAM ARGUMENT..., which writes them."""
import json, os, struct, subprocess, sys, tempfile
import numpy as np

EVENTS = "broke", "hit", "landed", "leapt"
DTYPES = {"F64": "<f8", "I64": "<i8", "I32": "<i4", "U8": "u1"}


def load(path):
    with open(path, "rb") as f:
        header = json.loads(f.read(struct.unpack("<Q", f.read(8))[0]))
        data = f.read()
    metadata = header.pop("__metadata__")
    arrays = {}
    used = 0
    for name, t in header.items():
        begin, end = t["data_offsets"]
        arrays[name] = np.frombuffer(data[begin:end], DTYPES[t["dtype"]]).reshape(t["shape"])
        used += end - begin
    assert used == len(data), "bytes that belong to no array"
    return metadata, arrays


def same(a, b):
    a, b = np.asarray(a, "<f8"), np.asarray(b, "<f8")
    return a.shape == b.shape and np.array_equal(a.view("<u8"), b.view("<u8"))


def compare(folder, name):
    with open(f"{folder}/{name}.json", encoding="utf-8") as f:
        document = json.load(f, parse_constant=lambda c: sys.exit(f"{name}.json holds {c}"))
    metadata, arrays = load(f"{folder}/{name}.safetensors")
    if name == "motion":
        frames = document.pop("frames")
        events = [(f, k) for f in frames for k in range(len(f.get("event", [])))]
        if events: # by their frames' numbers, and as places in the list of words
            assert arrays.pop("event_frame").tolist() == [f["frame"] for f, _ in events]
            assert [EVENTS[e] for e in arrays.pop("event")] == [f["event"][k] for f, k in events]
            for key in "event_body", "event_on", "event_value":
                assert same([f[key][k] for f, k in events], arrays.pop(key)), key
        for key in frames[0]:
            if key.startswith("event"):
                continue
            assert same(np.array([f[key] for f in frames], "<f8").ravel(), arrays.pop(key).ravel()), key
    for key, value in document.items():
        if isinstance(value, list) and key in arrays:
            assert same(np.array(value, "<f8"), arrays.pop(key).ravel()), key
        else:
            text = metadata.pop(key)
            assert (text if isinstance(value, str) else json.loads(text)) == value, key
    assert not arrays and not metadata, (list(arrays), list(metadata))


with tempfile.TemporaryDirectory() as folder:
    subprocess.run(sys.argv[1:], env={**os.environ, "BOUGH_DOCUMENTS_OUT": folder}, check=True, stdout=subprocess.DEVNULL)
    for document in ("tree", "splines", "motion"):
        compare(folder, document)
