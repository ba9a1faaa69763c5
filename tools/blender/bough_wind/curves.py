"""A curve object as a tree, and its control points moved with the tree's bodies."""
import numpy as np

from . import branches
from .axes import Places

SAMPLES = 6  # of a Bezier segment


class NotATree(Exception):
    """The object is no tree that can be simulated; the message says why."""


def handles(spline):
    """(control points (n, k, 3), radii (n)): k 3, point and both handles, of Bezier splines, 1 of others."""
    points = spline.bezier_points if spline.type == "BEZIER" else spline.points
    radii = np.empty(len(points))
    points.foreach_get("radius", radii)
    if spline.type == "BEZIER":
        parts = []
        for name in ("co", "handle_left", "handle_right"):
            flat = np.empty(3 * len(points))
            points.foreach_get(name, flat)
            parts.append(flat.reshape(-1, 3))
        return np.stack(parts, 1), radii
    flat = np.empty(4 * len(points))
    points.foreach_get("co", flat)
    return flat.reshape(-1, 1, 4)[..., :3].copy(), radii


def polyline(spline, points, radii):
    """The curve through (or for NURBS along) its control points, with radii."""
    if spline.type != "BEZIER":
        return points[:, 0], radii
    t = (np.arange(SAMPLES) / SAMPLES)[:, None]
    line, thick = [], []
    for k in range(len(points) - 1):
        a, b, c, d = points[k, 0], points[k, 2], points[k + 1, 1], points[k + 1, 0]
        line.append((1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d)
        thick.append((1 - t[:, 0]) * radii[k] + t[:, 0] * radii[k + 1])
    return np.concatenate(line + [points[-1:, 0]]), np.concatenate(thick + [radii[-1:]])


class CurveTree:
    """Holds an object by its name: Blender may move its memory between two calls."""

    def __init__(self, curve_object, unit):
        self.name = curve_object.name
        self.places = Places(curve_object.matrix_world, unit)
        curve = curve_object.data
        thick = curve.bevel_depth if curve.bevel_depth > 0 else 1.0
        self.sizes = [(spline.type, len(spline.bezier_points) or len(spline.points)) for spline in curve.splines]
        self.splines, self.rest = [], []  # numbers of the curve's own splines; their control points
        found = []
        for number, spline in enumerate(curve.splines):
            points, radii = handles(spline)
            line, radius = polyline(spline, points, radii)
            line = self.places.to_bough(line)
            keep = np.concatenate([[True], np.linalg.norm(np.diff(line, axis=0), axis=1) > 1e-9])
            if keep.sum() < 2:
                continue
            found.append(branches.Branch(line[keep], np.maximum(radius[keep] * thick * self.places.scale, 1e-5)))
            self.splines.append(number)
            self.rest.append(points)
        if not found:
            raise NotATree(f"{self.name}: has no spline of two points that differ, expected the branches of a tree")
        self.trunks = branches.connect(found)
        self.document, ordered = branches.document(found, self.name)
        number = {id(branch): k for k, branch in enumerate(ordered)}
        self.branch = [number[id(branch)] for branch in found]
        self.shown = self.rest
        self.handle_types = [[(p.handle_left_type, p.handle_right_type) for p in curve.splines[k].bezier_points] for k in self.splines]

    def bind(self, run):
        """Which body each control point goes with, where the run stands as it is drawn."""
        points = np.concatenate([rest[:, 0] for rest in self.rest])
        of = np.repeat(self.branch, [len(rest) for rest in self.rest])
        bodies = branches.bodies_at(run, self.places.to_bough(points), of)
        self.body = np.concatenate([np.repeat(part, rest.shape[1]) for part, rest in zip(
            np.split(bodies, np.cumsum([len(rest) for rest in self.rest])[:-1]), self.rest)])
        self.drawn = self.places.to_bough(np.concatenate([rest.reshape(-1, 3) for rest in self.rest]))

    def shape(self, moved):
        """Control points, as rest has them, where moved(bodies, drawn places) takes them."""
        now = self.places.from_bough(moved(self.body, self.drawn))
        parts = np.split(now, np.cumsum([rest.shape[0] * rest.shape[1] for rest in self.rest])[:-1])
        return [part.reshape(rest.shape) for part, rest in zip(parts, self.rest)]

    def show(self, curve_object, shape):
        if not self._as_begun(curve_object.data):
            raise NotATree(f"{self.name}: its points are others than when it began to move; simulate it again")
        for number, points in zip(self.splines, shape):
            self._set(curve_object.data.splines[number], points)
        self.shown = shape
        self._changed(curve_object)

    def _as_begun(self, curve):
        return self.sizes == [(spline.type, len(spline.bezier_points) or len(spline.points)) for spline in curve.splines]

    def _set(self, spline, points):
        if spline.type == "BEZIER":
            for part, name in enumerate(("co", "handle_left", "handle_right")):
                spline.bezier_points.foreach_set(name, np.ascontiguousarray(points[:, part]).ravel())
        else:
            spline.points.foreach_set("co", self._with_weights(spline, points).ravel())

    @staticmethod
    def _changed(curve_object):
        curve_object.data.update_tag()
        curve_object.update_tag()

    @staticmethod
    def _with_weights(spline, points):
        flat = np.empty(4 * len(points))
        spline.points.foreach_get("co", flat)
        flat = flat.reshape(-1, 4)
        flat[:, :3] = points[:, 0]
        return flat

    def begin(self, curve_object):
        """Handles that Blender would set by itself are let be."""
        for number in self.splines:
            for point in curve_object.data.splines[number].bezier_points:
                point.handle_left_type = point.handle_right_type = "FREE"

    def end(self, curve_object):
        """As it was; where points came or went meanwhile, each is taken back as the one is that was shown nearest to it."""
        if not self._as_begun(curve_object.data):
            self._take_back(curve_object)
            return
        for number, types in zip(self.splines, self.handle_types):
            for point, (left, right) in zip(curve_object.data.splines[number].bezier_points, types):
                point.handle_left_type, point.handle_right_type = left, right
        self.show(curve_object, self.rest)

    def _take_back(self, curve_object):
        shown = np.concatenate([points[:, 0] for points in self.shown])
        way = np.concatenate([points[:, 0] for points in self.rest]) - shown
        for spline in curve_object.data.splines:
            points, _ = handles(spline)
            nearest = [np.linalg.norm(shown - point, axis=1).argmin() for point in points[:, 0]]
            self._set(spline, points + way[nearest][:, None])
            for point in spline.bezier_points:  # that Blender would set by itself from here on
                point.handle_left_type = point.handle_right_type = "ALIGNED"
        self._changed(curve_object)

    def bake(self, curve_object, frames, shapes):
        """A shape key a frame, one after another by the curve's evaluation time."""
        self.begin(curve_object)
        self.show(curve_object, self.rest)
        if curve_object.data.shape_keys:
            curve_object.shape_key_clear()
        curve_object.shape_key_add(name="Bough rest", from_mix=False).interpolation = "KEY_LINEAR"
        first = np.cumsum([0] + [len(spline.bezier_points) or len(spline.points) for spline in curve_object.data.splines])
        times = []
        for frame, shape in zip(frames, shapes):
            key = curve_object.shape_key_add(name=f"Bough {frame}", from_mix=False)
            for number, points in zip(self.splines, shape):
                for k, point in enumerate(points):
                    place = key.data[int(first[number]) + k]
                    place.co = point[0]
                    if len(point) == 3:
                        place.handle_left, place.handle_right = point[1], point[2]
            key.interpolation = "KEY_LINEAR"
            times.append(key.frame)
        keys = curve_object.data.shape_keys
        keys.use_relative = False
        keys.animation_data_create()
        action = keys.animation_data.action = new_action(f"{self.name} in the wind")
        set_keys(action.fcurves.new("eval_time"), frames, times)


def new_action(name):
    import bpy
    return bpy.data.actions.new(name)


def set_keys(fcurve, frames, values):
    """Keys with straight lines between them."""
    fcurve.keyframe_points.add(len(frames))
    fcurve.keyframe_points.foreach_set("co", np.stack([frames, values], 1).astype(float).ravel())
    for point in fcurve.keyframe_points:
        point.interpolation = "LINEAR"
    fcurve.update()
