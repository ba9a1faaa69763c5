"""Branches as bough takes them: polylines with radii, each on its parent; a bough-splines document of them (formats/documents/README.md)."""
import json

import numpy as np


class Branch:
    """points (n, 3) [m], radii (n) [m]; parent: another Branch or None; at: where on its axis, a fraction of its length."""

    def __init__(self, points, radii):
        self.points, self.radii = np.asarray(points, float), np.asarray(radii, float)
        self.parent, self.at = None, 0.0

    def length(self):
        return np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum()


class Segments:
    """The pieces of many branches' axes, in the order of the branches."""

    def __init__(self, branches):
        self.a = np.concatenate([branch.points[:-1] for branch in branches])
        self.way = np.concatenate([np.diff(branch.points, axis=0) for branch in branches])
        self.length = np.maximum(np.linalg.norm(self.way, axis=1), 1e-30)
        self.r0 = np.concatenate([branch.radii[:-1] for branch in branches])
        self.r1 = np.concatenate([branch.radii[1:] for branch in branches])
        self.before = np.concatenate([np.concatenate([[0], np.cumsum(lengths)[:-1]]) for lengths in
                                      (np.linalg.norm(np.diff(branch.points, axis=0), axis=1) for branch in branches)])
        self.first = np.cumsum([0] + [len(branch.points) - 1 for branch in branches])

    def nearest(self, point, start, stop):
        """(distance to the axis [m], radius there, which of the branches, how far along it [m]) of the place whose bark is nearest, among the branches
        from number start to before stop."""
        at = slice(self.first[start], self.first[stop])
        share = np.clip(((point - self.a[at]) * self.way[at]).sum(1) / self.length[at] ** 2, 0, 1)
        off = np.linalg.norm(self.a[at] + share[:, None] * self.way[at] - point, axis=1)
        radius = self.r0[at] + share * (self.r1[at] - self.r0[at])
        k = int(np.argmin(off - radius))
        segment = self.first[start] + k
        branch = int(np.searchsorted(self.first, segment, "right")) - 1
        return off[k], radius[k], branch, self.before[segment] + share[k] * self.length[segment]


def connect(branches):
    """Finds each one's parent: of those thicker at the base, the one whose bark its own base is nearest to; where that is farther than the bark's radius
    and a twentieth of its own length, it stands on the ground. Returns how many do."""
    order = sorted(branches, key=lambda branch: -branch.radii[0])
    segments = Segments(order)
    for rank, own in enumerate(order):
        own.parent, own.at = None, 0.0
        if rank == 0:
            continue
        off, radius, other, along = segments.nearest(own.points[0], 0, rank)
        if off <= radius + own.length() / 20:
            own.parent, own.at = order[other], float(np.clip(along / max(order[other].length(), 1e-30), 0, 1))
    return sum(branch.parent is None for branch in branches)


def document(branches, name):
    """(bytes of the document, the branches in its order: parents before children)."""
    ordered, known = [], set()

    def put(branch):
        if id(branch) in known:
            return
        chain = [branch]
        while chain[-1].parent is not None and id(chain[-1].parent) not in known:
            chain.append(chain[-1].parent)
        for one in reversed(chain):
            known.add(id(one))
            ordered.append(one)

    for branch in branches:
        put(branch)
    number = {id(branch): k for k, branch in enumerate(ordered)}
    level = []
    for branch in ordered:
        level.append(0 if branch.parent is None else level[number[id(branch.parent)]] + 1)
    first = np.cumsum([0] + [len(branch.points) for branch in ordered])
    text = json.dumps({
        "format": "bough-splines", "version": 1, "name": name,
        "parent": [-1 if branch.parent is None else number[id(branch.parent)] for branch in ordered],
        "parent_at": [float(branch.at) for branch in ordered], "level": level, "first_point": first.tolist(),
        "point": np.concatenate([branch.points for branch in ordered]).ravel().tolist(),
        "radius": np.concatenate([branch.radii for branch in ordered]).tolist()})
    return text.encode(), ordered


def bodies_at(run, points, branch_of_point):
    """The body of each point: of those of its branch, the one whose axis at rest is nearest."""
    branches, kinds = np.array(run.branches), np.array(run.kinds)
    places = np.array(run.positions)[:len(branches)]
    ends = np.array(run.tips)
    found = np.zeros(len(points), int)
    for branch in np.unique(branch_of_point):
        bodies = np.flatnonzero((branches == branch) & (kinds == 0))
        if len(bodies) == 0:  # merged into another: the nearest of all
            bodies = np.flatnonzero(kinds == 0)
        mine = np.flatnonzero(branch_of_point == branch)
        a, way = places[bodies], ends[bodies] - places[bodies]
        share = np.clip(((points[mine][:, None] - a) * way).sum(-1) / np.maximum((way**2).sum(-1), 1e-30), 0, 1)
        off = np.linalg.norm(a + share[..., None] * way - points[mine][:, None], axis=-1)
        found[mine] = bodies[np.argmin(off, 1)]
    return found
