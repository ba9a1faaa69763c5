"""blender -b --factory-startup --python-exit-code 1 -P blender_model.py -- DRIVEN.glb OWN PICTURE|-

Imports a user's own model OWN (.glb, .gltf or .fbx) and DRIVEN.glb, which treesim --skin made of it: the same bones,
materials and (but for FBX, whose vertices assimp splits) vertices at the first frame, within 1e-3 of the height; and by
the last frame the mesh has moved. PICTURE: the first and the last frame side by side as a PNG.
"""
import sys

import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that Debian's numpy no longer has
import bpy


def skinned_mesh():
    """The one skinned mesh's moved vertices in the world, Blender's axes."""
    meshes = [o for o in bpy.data.objects if o.type == "MESH" and any(m.type == "ARMATURE" for m in o.modifiers)]
    assert len(meshes) == 1, f"{len(meshes)} skinned meshes, expected one"
    evaluated = meshes[0].evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    flat = numpy.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    world = numpy.array(evaluated.matrix_world)
    return meshes[0], flat.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]


def bones():
    return sorted(b.name for o in bpy.data.objects if o.type == "ARMATURE" for b in o.data.bones)


def load(name):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 30
    bpy.ops.import_scene.fbx(filepath=name) if name.endswith(".fbx") else bpy.ops.import_scene.gltf(filepath=name)


def draw(mesh_object, low, high, picture):
    """First and last frame beside each other; Cycles needs no display."""
    scene = bpy.context.scene
    middle, size = (low + high) / 2, (high - low).max()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (middle[0], middle[1] - 3 * size, middle[2])
    camera.rotation_euler = (1.5707963, 0, 0)
    camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", 1.15 * size, 10 * size
    light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    light.data.energy, light.rotation_euler = 3, (0.7, 0.2, 0.5)
    for thing in (camera, light):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 8, False
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.7, 0.8, 0.9, 1)
    scene.render.resolution_x, scene.render.resolution_y = 500, 700
    for place, frame in (("first", 0), ("last", scene.frame_end)):
        scene.frame_set(frame)
        scene.render.filepath = picture.replace(".png", f".{place}.png")
        bpy.ops.render.render(write_still=True)


def main():
    driven, own, picture = sys.argv[sys.argv.index("--") + 1 :]
    load(own)
    bpy.context.scene.frame_set(0)
    for o in bpy.data.objects:
        o.animation_data_clear()
    _, wanted = skinned_mesh()
    own_bones, own_materials = bones(), [m.name for m in bpy.data.materials]
    load(driven)
    assert len(bpy.data.actions) == 1, f"{len(bpy.data.actions)} animations, expected one"
    scene = bpy.context.scene
    scene.frame_end = int(bpy.data.actions[0].frame_range[1])
    scene.frame_set(0)
    thing, found = skinned_mesh()
    height = wanted[:, 2].max() - wanted[:, 2].min()
    # glTF needs a bone for unweighted vertices; Blender adds one.
    left = set(own_bones) ^ set(bones())
    assert left <= {"neutral_bone"}, f"bones {sorted(left)[:5]} differ"
    if own.endswith(".fbx"):
        off = max(numpy.abs(found.min(0) - wanted.min(0)).max(), numpy.abs(found.max(0) - wanted.max(0)).max()) / height
    else:
        assert found.shape == wanted.shape, f"{len(found)} vertices, expected {len(wanted)}"
        assert [m.name for m in bpy.data.materials] == own_materials, "the materials differ"
        off = numpy.linalg.norm(found - wanted, axis=1).max() / height
    scene.frame_set(scene.frame_end)
    _, last = skinned_mesh()
    moved = numpy.linalg.norm(last - found, axis=1).max() / height
    print(
        f"blender: {driven.split('/')[-1]} of {own.split('/')[-1]}: {len(bones())} bones, {len(found)} vertices, "
        f"{len(own_materials)} materials; first frame off by {off:.2g} of the height; moves by {moved:.3g}"
    )
    assert off <= 1e-3 and moved > 1e-3, "not the user's model, or it does not move"
    if picture != "-":
        draw(thing, numpy.minimum(found.min(0), last.min(0)), numpy.maximum(found.max(0), last.max(0)), picture)


main()
