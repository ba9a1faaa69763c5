"""blender -b --factory-startup --python-exit-code 1 -P blender.py -- FILE.glb TOLERANCE PICTURE|- FRAME.obj ...

Imports FILE.glb and compares its mesh, as Blender's armature moves it, with our OBJ frames (their number is the last in
the file's name): no vertex may be farther off than TOLERANCE times the height. Armature, skin and animation must be there,
and the mesh must move. PICTURE: the last frame as a PNG, drawn from the side.
"""
import math
import re
import sys

import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that Debian's numpy no longer has
import bpy
import mathutils


def read_obj(name):
    """Vertices in glTF's axes, and those that each part uses, which are the ones Blender keeps, in this order."""
    vertices, parts = [], []
    with open(name) as lines:
        for line in lines:
            if line.startswith("v "):
                vertices.append([float(x) for x in line.split()[1:4]])
            elif line.startswith("g "):
                parts.append(set())
            elif line.startswith("f "):
                parts[-1].update(int(corner.split("/")[0]) - 1 for corner in line.split()[1:])
    return numpy.array(vertices), [v for part in parts for v in sorted(part)]


def mesh_now(mesh_object):
    """The moved vertices in the world, in glTF's axes (Blender's are x, -z, y)."""
    evaluated = mesh_object.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    flat = numpy.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    world = numpy.array(evaluated.matrix_world)
    found = flat.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    return numpy.stack([found[:, 0], found[:, 2], -found[:, 1]], axis=1)


def draw(mesh_object, low, high, picture):
    """A quick drawing: Cycles, which needs no display, with few samples."""
    scene = bpy.context.scene
    middle, size = (low + high) / 2, (high - low).max()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (middle[0], -middle[2] - 2 * size, middle[1])
    camera.rotation_euler = (math.pi / 2, 0, 0)
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 1.1 * size
    camera.data.clip_end = 10 * size
    scene.collection.objects.link(camera)
    light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    light.data.energy = 3
    light.rotation_euler = mathutils.Euler((0.7, 0.2, 0.5))
    scene.collection.objects.link(light)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 8
    scene.cycles.use_denoising = False  # Debian builds Blender without it
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.7, 0.8, 0.9, 1)
    scene.render.resolution_x = scene.render.resolution_y = 700
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


def main():
    name, tolerance, picture, *frames = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 30
    bpy.ops.import_scene.gltf(filepath=name)
    meshes = [o for o in bpy.data.objects if o.type == "MESH" and any(m.type == "ARMATURE" for m in o.modifiers)]
    armatures = [o for o in bpy.data.objects if o.type == "ARMATURE"]
    assert len(meshes) == 1 and len(armatures) == 1, "expected one skinned mesh and one armature"
    assert len(bpy.data.actions) == 1, "expected one animation"
    assert armatures[0].animation_data and armatures[0].animation_data.action, "the armature is not animated"
    worst, start, moved = 0.0, None, 0.0
    for frame in frames:
        vertices, used = read_obj(frame)
        bpy.context.scene.frame_set(int(re.findall(r"\d+", frame)[-1]))
        found, wanted = mesh_now(meshes[0]), vertices[used]
        assert found.shape == wanted.shape, f"{len(found)} vertices, expected {len(wanted)}"
        height = vertices[:, 1].max() - vertices[:, 1].min()
        worst = max(worst, numpy.linalg.norm(found - wanted, axis=1).max() / height)
        start = found if start is None else start
        moved = max(moved, numpy.linalg.norm(found - start, axis=1).max() / height)
    print(
        f"blender: {name.split('/')[-1]}: {len(armatures[0].data.bones)} bones, {len(found)} vertices, "
        f"{len(bpy.data.materials)} materials; moves by {moved:.3g} of the height; off by {worst:.2g} (most {float(tolerance):.2g})"
    )
    assert moved > 1e-3, "the animation moves nothing"
    assert worst <= float(tolerance), "Blender's vertices are not those of the OBJ frames"
    if picture != "-":
        draw(meshes[0], vertices.min(axis=0), vertices.max(axis=0), picture)


main()
