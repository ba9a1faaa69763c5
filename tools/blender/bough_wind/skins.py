"""An armature with the mesh that it moves as a tree, and its bones turned with the tree's bodies."""
import math

import numpy as np

from . import branches
from .axes import TO_BOUGH, Places, quaternions
from .curves import NotATree, new_action, set_keys

THIN = 0.05  # of a bone's length: its radius where no mesh says


def armature_of(blender_object):
    """The armature that the object is, or is skinned to; None where there is none."""
    if blender_object is None or blender_object.type == "ARMATURE":
        return blender_object
    for modifier in blender_object.modifiers:
        if modifier.type == "ARMATURE" and modifier.object:
            return modifier.object
    return None


def radii_of(armature, meshes, unit):
    """[m] Of each bone, by name: the median of the distances of the vertices that are chiefly its own from its axis, up to twice their lower quartile:
    twigs without a bone of their own stand farther off."""
    off = {}
    for mesh in meshes:
        names = {group.index: group.name for group in mesh.vertex_groups}
        to_world = np.array(mesh.matrix_world)
        for vertex in mesh.data.vertices:
            best = max(vertex.groups, key=lambda g: g.weight, default=None)
            if best is None or names.get(best.group) not in armature.data.bones:
                continue
            off.setdefault(names[best.group], []).append(to_world[:3, :3] @ np.array(vertex.co) + to_world[:3, 3])
    found, world = {}, np.array(armature.matrix_world)
    for name, points in off.items():
        bone = armature.data.bones[name]
        head, tail = (world[:3, :3] @ np.array(end) + world[:3, 3] for end in (bone.head_local, bone.tail_local))
        way = tail - head
        share = np.clip((np.array(points) - head) @ way / max(way @ way, 1e-30), 0, 1)
        away = np.linalg.norm(head + share[:, None] * way - points, axis=1)
        found[name] = unit * float(np.median(away[away <= 2 * np.quantile(away, 0.25)]))
    return found


def radii_at_ends(middle):
    """(n + 1) of pieces whose middles have these (n): between two their mean, beyond the first and last as it goes on."""
    if len(middle) == 1:
        return np.array([1, 0.5]) * middle[0]
    inner = (middle[1:] + middle[:-1]) / 2
    return np.concatenate([[2 * middle[0] - inner[0]], inner, [max(2 * middle[-1] - inner[-1], middle[-1] / 2)]])


class SkinTree:
    def __init__(self, armature, unit, meshes):
        self.name = armature.name
        self.places = Places(armature.matrix_world, unit)
        bones = list(armature.data.bones)  # parents before children
        if not bones:
            raise NotATree(f"{self.name}: has no bones")
        self.bones = [bone.name for bone in bones]
        known = radii_of(armature, meshes, unit)
        heads = self.places.to_bough(np.array([bone.head_local for bone in bones]))
        tails = self.places.to_bough(np.array([bone.tail_local for bone in bones]))
        lengths = np.linalg.norm(tails - heads, axis=1)
        number = {name: k for k, name in enumerate(self.bones)}
        parent = [number[bone.parent.name] if bone.parent else -1 for bone in bones]
        radius = np.array([known.get(name, 0) for name in self.bones])
        radius = np.where(radius > 0, radius, np.maximum(THIN * lengths, 1e-5))
        bears = [1] * len(bones)
        for k in range(len(bones) - 1, -1, -1):
            if parent[k] >= 0:
                bears[parent[k]] += bears[k]
                radius[parent[k]] = max(radius[parent[k]], radius[k])
        goes_on = {}  # of the children at a bone's tail the thickest, of those as thick the one that bears most: its branch goes on in it
        weight = lambda k: (round(20 * math.log(radius[k])), bears[k])
        for k, p in enumerate(parent):
            if p >= 0 and np.linalg.norm(heads[k] - tails[p]) <= 0.05 * lengths[p] and (p not in goes_on or weight(k) > weight(goes_on[p])):
                goes_on[p] = k
        follows = set(goes_on.values())
        self.branch, chains, found = [0] * len(bones), [], []
        for k in range(len(bones)):
            if k in follows:
                continue
            chain = [k]
            while chain[-1] in goes_on:
                chain.append(goes_on[chain[-1]])
            points = [heads[k]] + [tails[j] for j in chain]
            found.append(branches.Branch(points, radii_at_ends(radius[chain])))
            chains.append(chain)
        for chain, one in zip(chains, found):
            p = parent[chain[0]]
            if p < 0:
                continue
            which = next(j for j, other in enumerate(chains) if p in other)
            one.parent, before = found[which], sum(lengths[j] for j in chains[which][:chains[which].index(p)])
            way = tails[p] - heads[p]
            share = np.clip((heads[chain[0]] - heads[p]) @ way / max(way @ way, 1e-30), 0, 1)
            one.at = float(min(1, (before + share * lengths[p]) / max(one.parent.length(), 1e-30)))
        self.trunks = sum(one.parent is None for one in found)
        self.document, ordered = branches.document(found, self.name)
        place = {id(one): k for k, one in enumerate(ordered)}
        for chain, one in zip(chains, found):
            for k in chain:
                self.branch[k] = place[id(one)]
        self.middles, self.parent = (heads + tails) / 2, np.array(parent)
        self.bone_rest = np.array([np.array(bone.matrix_local)[:3, :3] for bone in bones])
        world = np.array(armature.matrix_world)[:3, :3]
        self.axes = TO_BOUGH @ (world / np.linalg.norm(world, axis=0))
        self.modes = None

    def bind(self, run):
        self.body = branches.bodies_at(run, self.middles, np.array(self.branch))

    def shape(self, turned):
        """(bones, 4) rotations in their own axes, w x y z: B^-1 D_parent^-1 D B, D how the body has turned, B the bone at rest."""
        D = self.axes.T @ turned(self.body) @ self.axes
        D_parent = np.where((self.parent >= 0)[:, None, None], D[self.parent], np.eye(3))
        back = self.bone_rest.transpose(0, 2, 1)
        return quaternions(back @ D_parent.transpose(0, 2, 1) @ D @ self.bone_rest)

    def begin(self, armature):
        if self.modes is None:
            self.modes = [(bone.rotation_mode, tuple(bone.rotation_quaternion), tuple(bone.rotation_euler)) for bone in self._pose(armature)]
        for bone in self._pose(armature):
            bone.rotation_mode = "QUATERNION"

    def _pose(self, armature):
        """The bones, in self.bones' order; None for one that is gone."""
        return [armature.pose.bones.get(name) for name in self.bones]

    def show(self, armature, shape):
        if None in self._pose(armature):
            raise NotATree(f"{self.name}: has other bones than when it began to move; simulate it again")
        for bone, rotation in zip(self._pose(armature), shape):
            bone.rotation_quaternion = rotation
        armature.update_tag()

    def end(self, armature):
        for bone, (mode, quaternion, euler) in zip(self._pose(armature), self.modes or []):
            if bone is not None:
                bone.rotation_mode, bone.rotation_quaternion, bone.rotation_euler = mode, quaternion, euler
        armature.update_tag()

    def bake(self, armature, frames, shapes):
        """Keys of every bone's rotation."""
        self.begin(armature)
        values = np.array(shapes)
        flips = np.cumprod(np.where((values[1:] * values[:-1]).sum(-1) < 0, -1, 1), 0)  # the shorter way from frame to frame
        values[1:] *= flips[..., None]
        armature.animation_data_create()
        action = armature.animation_data.action = new_action(f"{self.name} in the wind")
        for k, name in enumerate(self.bones):
            for part in range(4):
                fcurve = action.fcurves.new(f'pose.bones["{name}"].rotation_quaternion', index=part, action_group=name)
                set_keys(fcurve, frames, values[:, k, part])
