"""blender -b --factory-startup --python-exit-code 1 -P blender_cache.py -- REST.obj CACHE.pc2,CACHE.mdd FRAME.obj ...

Imports REST.obj as it comes, moves it by each point cache with Blender's modifier Mesh Cache, its axes as they are, and
compares the mesh with our OBJ frames (their number is the last in the file's name). Then imports those frames as
the add-on Stop-motion-OBJ does (the older importer with split_mode OFF), and by the newer importer: one mesh a file, the same vertices, faces and materials.
"""
import re
import sys

import bpy
import numpy


def read_obj(name):
    with open(name) as lines:
        return numpy.array([[float(x) for x in line.split()[1:4]] for line in lines if line.startswith("v ")])


def in_world(mesh_object, mesh):
    """Vertices in the world, in glTF's axes (Blender's are x, -z, y)."""
    flat = numpy.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    world = numpy.array(mesh_object.matrix_world)
    found = flat.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    return numpy.stack([found[:, 0], found[:, 2], -found[:, 1]], axis=1)


def imported(name, legacy=False):
    before = set(bpy.data.objects)
    if legacy:
        bpy.ops.import_scene.obj(filepath=name, split_mode="OFF")
    else:
        bpy.ops.wm.obj_import(filepath=name)
    made = [o for o in bpy.data.objects if o not in before]
    assert len(made) == 1 and made[0].type == "MESH", f"{name} gave {len(made)} objects"
    return made[0]


def farthest(found, wanted):
    assert found.shape == wanted.shape, f"{len(found)} vertices, expected {len(wanted)}"
    height = wanted[:, 1].max() - wanted[:, 1].min()
    return numpy.linalg.norm(found - wanted, axis=1).max() / height


def check_cache(rest, cache, frames):
    modifier = rest.modifiers.new("cache", "MESH_CACHE")
    modifier.cache_format = cache[-3:].upper()
    modifier.filepath = cache
    worst, start, moved = 0.0, None, 0.0
    for frame in frames:
        bpy.context.scene.frame_set(int(re.findall(r"\d+", frame)[-1]))
        evaluated = rest.evaluated_get(bpy.context.evaluated_depsgraph_get())
        found = in_world(evaluated, evaluated.to_mesh())
        worst = max(worst, farthest(found, read_obj(frame)))
        start = found if start is None else start
        moved = max(moved, farthest(found, start))
    rest.modifiers.remove(modifier)
    print(f"blender: {cache.split('/')[-1]}: {len(found)} vertices; moves by {moved:.3g} of the height; off by {worst:.2g}")
    assert moved > 1e-3, "the cache moves nothing"
    assert worst < 1e-5, "Blender's vertices are not those of the OBJ frames"


def check_sequence(frames, legacy):
    kept = None
    for frame in frames:
        mesh_object = imported(frame, legacy)
        mesh = mesh_object.data
        assert farthest(in_world(mesh_object, mesh), read_obj(frame)) < 1e-5, f"{frame}: vertices in another order"
        says = ([tuple(p.vertices) for p in mesh.polygons], [p.material_index for p in mesh.polygons],
                [m.name.split(".")[0] for m in mesh.materials])
        assert kept in (None, says), f"{frame}: faces or materials change"
        kept = says
        bpy.data.objects.remove(mesh_object)
    print(f"blender: {len(frames)} frames by the {'older' if legacy else 'newer'} importer: {len(kept[0])} faces, "
          f"materials {', '.join(kept[2])}")


def main():
    rest_name, caches, *frames = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="io_scene_obj")
    rest = imported(rest_name)
    for cache in caches.split(","):
        check_cache(rest, cache, frames)
    for legacy in (False, True):
        check_sequence(frames, legacy)


main()
