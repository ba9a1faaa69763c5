"""One tree of Blender's in bough: made of an object, stepped, shown, baked."""
import math

import numpy as np

from .axes import matrices
from .curves import CurveTree, NotATree
from .library import bough
from .skins import SkinTree, armature_of


def tree_of(blender_object, scene):
    """(what is moved, a CurveTree or SkinTree of it). NotATree where the object is neither."""
    unit = scene.unit_settings.scale_length
    if blender_object is not None and blender_object.type == "CURVE":
        return blender_object, CurveTree(blender_object, unit)
    armature = armature_of(blender_object)
    if armature is None:
        raise NotATree("select a curve whose splines are branches, or a mesh that an armature moves")
    meshes = [other for other in scene.objects if other.type == "MESH" and armature_of(other) == armature]
    return armature, SkinTree(armature, unit, meshes)


def wind_of(settings):
    """bough.Wind: along Blender's ground, direction from +x to +y."""
    wind, angle = bough().wind_preset("gusty"), settings.wind_direction
    wind.velocity = [settings.wind_speed * math.cos(angle), 0, -settings.wind_speed * math.sin(angle)]
    wind.turbulence *= settings.gusts
    wind.gust_factor = 1 + (wind.gust_factor - 1) * settings.gusts
    wind.seed = settings.seed
    return wind


def frame_rate(scene):
    return scene.render.fps / scene.render.fps_base


class Run:
    """bough.Error, NotATree or library.Missing where it cannot be."""

    def __init__(self, blender_object, scene, settings):
        self.object, self.tree = tree_of(blender_object, scene)
        self.name = self.object.name
        library = bough()
        splines = library.read_splines(self.tree.document)
        self.wood = library.convert(splines, material=settings.material if settings.material != "OWN" else None)
        place = library.Scene(wind=wind_of(settings))
        place.add(self.wood)
        self.rate = frame_rate(scene)
        self.simulation = library.Simulation(place, step=1 / self.rate, precision="single")
        self.start, self.start_turn = np.array(self.simulation.positions), matrices(self.simulation.rotations)
        self.tree.bind(self.simulation)
        self.change_wood(settings)
        self.tree.begin(self.object)

    def found(self, scene):
        """The object, by its name; None where it has gone."""
        return scene.objects.get(self.name)

    def change_wind(self, settings):
        self.simulation.set_wind(wind_of(settings))

    def change_wood(self, settings):
        self.simulation.set_wood(settings.stiffness, settings.damping)

    def step(self):
        self.simulation.step()

    def shape(self):
        places, turns = np.array(self.simulation.positions), matrices(self.simulation.rotations)

        def turned(bodies):  # since the start
            return turns[bodies] @ self.start_turn[bodies].transpose(0, 2, 1)

        def moved(bodies, drawn):
            return places[bodies] + np.einsum("nij,nj->ni", turned(bodies), drawn - self.start[bodies])

        return self.tree.shape(turned if isinstance(self.tree, SkinTree) else moved)

    def show(self, blender_object):
        self.tree.show(blender_object, self.shape())

    def end(self, blender_object):
        if blender_object is not None:
            self.tree.end(blender_object)
