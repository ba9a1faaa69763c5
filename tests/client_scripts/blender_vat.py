"""blender -b --factory-startup --python-exit-code 1 -P blender_vat.py -- FOLDER_vat exr|png FRAME.obj ...

Imports the mesh of an OpenVAT and moves it by its texture with geometry nodes, which read the pixel of each vertex in each frame; compares it with our
OBJ frames (their number is the last in the file's name): no vertex may be farther off than 1e-3 of the height.
"""
import json
import os
import re
import sys

import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that Debian's numpy no longer has
import bpy


def read_obj(name):
    with open(name) as lines:
        return numpy.array([[float(x) for x in line.split()[1:4]] for line in lines if line.startswith("v ")])


def mesh_now(thing):
    """The moved vertices in the world, in glTF's axes (Blender's are x, -z, y)."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    flat = numpy.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    world = numpy.array(evaluated.matrix_world)
    found = flat.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    return numpy.stack([found[:, 0], found[:, 2], -found[:, 1]], axis=1)


def player(image, remap, uv):
    """Nodes that move each vertex by its pixel of a frame; returns the node that says which."""
    group = bpy.data.node_groups.new("vat", "GeometryNodeTree")
    group.inputs.new("NodeSocketGeometry", "Geometry")
    group.outputs.new("NodeSocketGeometry", "Geometry")
    make, link = group.nodes.new, group.links.new
    inside, outside = make("NodeGroupInput"), make("NodeGroupOutput")
    place = make("GeometryNodeInputNamedAttribute")
    place.data_type = "FLOAT_VECTOR"
    place.inputs["Name"].default_value = uv
    down = make("ShaderNodeVectorMath")
    down.operation = "ADD"
    link(next(s for s in place.outputs if s.enabled), down.inputs[0])
    texture = make("GeometryNodeImageTexture")
    texture.interpolation, texture.extension = "Closest", "EXTEND"
    texture.inputs["Image"].default_value = image
    link(down.outputs[0], texture.inputs["Vector"])
    scale = make("ShaderNodeVectorMath")
    scale.operation = "MULTIPLY_ADD"
    link(texture.outputs["Color"], scale.inputs[0])
    scale.inputs[1].default_value = [high - low for low, high in zip(remap["Min"], remap["Max"])]
    scale.inputs[2].default_value = remap["Min"]
    move = make("GeometryNodeSetPosition")
    link(inside.outputs["Geometry"], move.inputs["Geometry"])
    link(scale.outputs[0], move.inputs["Offset"])
    link(move.outputs["Geometry"], outside.inputs["Geometry"])
    return group, down


def main():
    folder, kind, *frames = sys.argv[sys.argv.index("--") + 1 :]
    name = os.path.join(folder, os.path.basename(folder)[: -len("_vat")])
    with open(name + "-remap_info.json") as text:
        remap = json.load(text)["os-remap"]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=name + ".glb")
    (thing,) = [o for o in bpy.data.objects if o.type == "MESH"]
    image = bpy.data.images.load(f"{os.path.abspath(name)}_vat.{kind}")
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "NONE"
    group, down = player(image, remap, thing.data.uv_layers[1].name)
    thing.modifiers.new("vat", "NODES").node_group = group
    worst, moved, start = 0.0, 0.0, None
    for frame in frames:
        down.inputs[1].default_value = (0, -int(re.findall(r"\d+", frame)[-1]) / image.size[1], 0)
        bpy.context.view_layer.update()
        found, wanted = mesh_now(thing), read_obj(frame)
        assert found.shape == wanted.shape, f"{len(found)} vertices, expected {len(wanted)}"
        height = wanted[:, 1].max() - wanted[:, 1].min()
        worst = max(worst, numpy.linalg.norm(found - wanted, axis=1).max() / height)
        start = found if start is None else start
        moved = max(moved, numpy.linalg.norm(found - start, axis=1).max() / height)
    print(f"blender: {folder} ({kind}): {len(found)} vertices, {image.size[0]}x{image.size[1]}, {remap['Frames']} frames; "
          f"moves by {moved:.3g} of the height; off by {worst:.2g} (most 1e-3)")
    assert moved > 1e-3, "the texture moves nothing"
    assert worst <= 1e-3, "Blender's vertices are not those of the OBJ frames"


main()
