"""What other programs see of our moving files, read here by numpy alone: played.py usda|glb FILE FPS OBJ FRAME...

Plays USD text as OpenUSD describes UsdSkel, or a .glb as glTF 2.0 describes skins, animations and nodes, at each frame, and prints how far each corner of
each triangle is from the nearest of the OBJ frame's at most, both ways [m], and how far the farthest moves. The triangles must be as many.
"""
import json
import re
import struct
import sys

import numpy as np


def obj_corners(name):
    vertices, corners = [], []
    for line in open(name):
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(x) for x in rest[:3]])
        if word == "f":
            corners += [int(c.split("/")[0]) - 1 for c in rest]
    return np.array(vertices)[corners]


def rotations(q):
    """x, y, z, w"""
    x, y, z, w = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def blended(points, joints, weights, matrices):
    moved = np.einsum("vk,vkij->vij", weights, matrices[joints])
    return np.einsum("vij,vj->vi", moved[:, :3, :3], points) + moved[:, :3, 3]


class Usda:
    def __init__(self, name):
        text = open(name).read()
        numbers = lambda t: np.array([float(x) for x in re.findall(r"-?\d[\d.eE+-]*", t)])
        skeleton = text[text.index("def Skeleton "):]
        skeleton = skeleton[:skeleton.index("\n    }\n")]
        self.path = re.findall(r'"([^"]*)"', re.search(r"uniform token\[\] joints = \[(.*)\]", skeleton)[1])
        matrix = lambda what: numbers(re.search(what + r" = \[(.*)\]", skeleton)[1]).reshape(-1, 4, 4).transpose(0, 2, 1)
        self.bind = matrix("bindTransforms")
        number = {path: j for j, path in enumerate(self.path)}
        assert len(number) == len(self.path), "two joints of one path"
        self.parent = [number[path.rpartition("/")[0]] if "/" in path else -1 for path in self.path]
        assert all(p < j for j, p in enumerate(self.parent)) and self.parent.count(-1) == 1, self.path
        block = lambda what: re.search(what + r"\.timeSamples = \{\n(.*?)\n *\}", skeleton, re.S)
        samples = lambda found: [numbers(line.split(":", 1)[1]) for line in found[1].split("\n")]
        self.rotation = [s.reshape(-1, 4)[:, [1, 2, 3, 0]] for s in samples(block("rotations"))]
        moving = block("translations")
        still = numbers(re.search(r"translations = \[(.*)\]", skeleton)[1]).reshape(-1, 3) if not moving else None
        self.place = [s.reshape(-1, 3) for s in samples(moving)] if moving else [still] * len(self.rotation)
        root = re.search(r"double3 xformOp:translate = (.*)", text)
        self.root = numbers(root[1]) if root else np.zeros(3)
        self.meshes = []
        for mesh in re.split(r"\n    def Mesh ", text)[1:]:
            array = lambda what: numbers(re.search(what + r" = \[(.*)\]", mesh)[1])
            points = array(r"point3f\[\] points").reshape(-1, 3)
            joints = array(r"skel:jointIndices").astype(int).reshape(len(points), -1)
            weights = array(r"skel:jointWeights").reshape(len(points), -1)
            assert np.abs(weights.sum(axis=1) - 1).max() < 1e-5
            self.meshes.append((points, joints, weights, array(r"faceVertexIndices").astype(int)))

    def corners(self, frame, fps):
        world = np.zeros((len(self.path), 4, 4))
        turn = rotations(self.rotation[frame])
        for j, p in enumerate(self.parent):
            local = np.eye(4)
            local[:3, :3], local[:3, 3] = turn[j], self.place[frame][j]
            world[j] = local if p < 0 else world[p] @ local
        matrices = world @ np.linalg.inv(self.bind)
        return np.concatenate([(blended(p, j, w, matrices) + self.root)[c] for p, j, w, c in self.meshes])


class Glb:
    kinds = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
    widths = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}

    def __init__(self, name):
        data = open(name, "rb").read()
        size = struct.unpack_from("<I", data, 12)[0]
        self.json, self.binary = json.loads(data[20:20 + size]), data[28 + size:]
        assert struct.unpack_from("<I", data, 8)[0] == len(data)
        self.animation = self.json["animations"][0]
        assert self.animation["name"] == "motion"

    def array(self, index):
        accessor = self.json["accessors"][index]
        view, kind, width = self.json["bufferViews"][accessor["bufferView"]], self.kinds[accessor["componentType"]], self.widths[accessor["type"]]
        start, item = view.get("byteOffset", 0) + accessor.get("byteOffset", 0), np.dtype(kind).itemsize * width
        stride = view.get("byteStride", item)
        values = np.ndarray((accessor["count"], width), kind, self.binary, start, (stride, np.dtype(kind).itemsize))
        return np.maximum(values / float(np.iinfo(kind).max), -1) if accessor.get("normalized") else values

    def keyed(self, sampler, time, turns):
        times, values = self.array(sampler["input"])[:, 0], self.array(sampler["output"]).astype(float)
        k = int(np.clip(np.searchsorted(times, time + 1e-6) - 1, 0, len(times) - 1))
        if k == len(times) - 1 or times[k] >= time:
            return values[k]
        share, a, b = (time - times[k]) / (times[k + 1] - times[k]), values[k], values[k + 1]
        if not turns:
            return a + share * (b - a)
        a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
        b = -b if a @ b < 0 else b
        angle = np.arccos(min(1, a @ b))
        return a if angle < 1e-9 else (np.sin((1 - share) * angle) * a + np.sin(share * angle) * b) / np.sin(angle)

    def corners(self, frame, fps):
        nodes = [dict(node) for node in self.json["nodes"]]
        for channel in self.animation["channels"]:
            path = channel["target"]["path"]
            nodes[channel["target"]["node"]][path] = self.keyed(self.animation["samplers"][channel["sampler"]], frame / fps, path == "rotation")
        world = {}

        def place(index, above):
            node, local = nodes[index], np.eye(4)
            if "matrix" in node:
                local = np.array(node["matrix"]).reshape(4, 4).T
            else:
                local[:3, :3] = rotations(np.array(node.get("rotation", [0, 0, 0, 1.0]))) * np.array(node.get("scale", [1, 1, 1]))
                local[:3, 3] = node.get("translation", [0, 0, 0])
            assert index not in world, "a node stands in the scene twice"
            world[index] = above @ local
            for child in node.get("children", []):
                place(child, world[index])

        for index in self.json["scenes"][self.json["scene"]]["nodes"]:
            place(index, np.eye(4))
        found = []
        for index in world:
            node = nodes[index]
            if "mesh" not in node:
                continue
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                of, points = primitive["attributes"], None
                points = self.array(of["POSITION"]).astype(float)
                if "skin" in node:
                    skin = self.json["skins"][node["skin"]]
                    binds = self.array(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
                    matrices = np.array([world[j] for j in skin["joints"]]) @ binds
                    joints, weights = self.array(of["JOINTS_0"]).astype(int), self.array(of["WEIGHTS_0"]).astype(float)
                    points = blended(points, np.minimum(joints, len(matrices) - 1), weights / weights.sum(axis=1, keepdims=True), matrices)
                else:
                    points = points @ world[index][:3, :3].T + world[index][:3, 3]
                corners = self.array(primitive["indices"])[:, 0].astype(int) if "indices" in primitive else np.arange(len(points))
                found.append(points[corners])
        return np.concatenate(found)


def farthest(these, those):
    """Of these from the nearest of those, up to a 300th of their size; infinite beyond. Those are looked for in cells, three in a row at a time."""
    these, those = np.unique(these, axis=0), np.unique(those, axis=0)
    cell = max(np.ptp(those, axis=0).max(), 1e-9) / 300
    low = np.minimum(these.min(axis=0), those.min(axis=0)) - 2 * cell

    def keys(points, across=0, up=0, along=0):
        x, y, z = np.floor((points - low) / cell).astype(np.int64).T
        return ((x + across) << 40) + ((y + up) << 20) + z + along

    of = keys(those)
    order = np.argsort(of, kind="stable")
    those, of = those[order], of[order]
    nearest = np.full(len(these), np.inf)
    for across in (-1, 0, 1):
        for up in (-1, 0, 1):
            at = np.searchsorted(of, keys(these, across, up, -1), "left")
            end = np.searchsorted(of, keys(these, across, up, 1), "right")
            while (some := np.flatnonzero(at < end)).size:
                nearest[some] = np.minimum(nearest[some], np.linalg.norm(those[at[some]] - these[some], axis=1))
                at[some] += 1
    return nearest.max()


def main():
    kind, name, fps, *frames = sys.argv[1:]
    played = {"usda": Usda, "glb": Glb}[kind](name)
    off, moves, start = 0.0, 0.0, None
    for frame, wanted in enumerate(map(obj_corners, frames)):
        found = played.corners(frame, float(fps))
        assert found.shape == wanted.shape, (found.shape, wanted.shape)
        off = max(off, farthest(found, wanted), farthest(wanted, found))
        start = found if start is None else start
        moves = max(moves, np.linalg.norm(found - start, axis=1).max())
    print(f"{off:.3g} {moves:.3g}")


main()
