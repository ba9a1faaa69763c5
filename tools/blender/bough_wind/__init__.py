"""Bough Wind: a curve tree, or a mesh skinned to an armature, moves in the wind while its sliders are dragged, and is baked to shape keys or to the
armature's keys. The wood is bough's: bough.py does the physics (library.py says where it is looked for)."""
bl_info = {
    "name": "Bough Wind",
    "author": "bough",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Bough",
    "description": "Trees that move as wood moves: curves and skinned meshes in the wind",
    "category": "Animation",
}

from . import operators, panel, properties


def register():
    properties.register()
    operators.register()
    panel.register()


def unregister():
    operators.stop_all()
    panel.unregister()
    operators.unregister()
    properties.unregister()
