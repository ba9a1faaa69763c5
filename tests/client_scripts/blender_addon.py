"""blender -b --factory-startup --python-exit-code 1 -P blender_addon.py -- installed ARCHIVE.zip|curves FOLDER|skin FOLDER|refused FOLDER  PICTURES

The add-on of tools/blender, as its buttons and sliders use it. There is no window, so no timer runs: its tick is called by hand.
"""
import importlib
import math
import sys
import time

import bpy
import numpy as np
from mathutils import Vector


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def operators():
    return importlib.import_module("bough_wind.operators")


def enable(folder):
    sys.path.insert(0, folder)
    check("FINISHED" in bpy.ops.preferences.addon_enable(module="bough_wind"), "the add-on is not enabled")


def empty():
    bpy.ops.bough.stop() if bpy.ops.bough.stop.poll() else None
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="bough_wind")
    bpy.context.scene.render.fps = 30
    return bpy.context.scene.bough_wind


def select(thing):
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def steps(count):
    wrong = operators().step_all(bpy.context.scene, count)
    check(not wrong, f"a step said {wrong}")


def control_points(curve_object):
    """In the world, and which spline each is of."""
    points, of = [], []
    for number, spline in enumerate(curve_object.data.splines):
        for point in spline.bezier_points if spline.type == "BEZIER" else spline.points:
            points.append((curve_object.matrix_world @ point.co.to_3d())[:])
            of.append(number)
    return np.array(points), np.array(of)


def evaluated(thing):
    """Vertices in the world of what Blender makes of it."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    made = thing.evaluated_get(depsgraph)
    mesh = made.to_mesh()
    flat = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    world = np.array(made.matrix_world)
    return flat.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]


def picture(name):
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    camera.location = (0, -26, 5)
    camera.rotation_euler = (math.radians(90), 0, 0)
    scene.camera = camera
    light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    light.data.energy, light.rotation_euler = 4, (0.6, 0.3, 0)
    scene.collection.objects.link(light)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 8, False
    scene.render.resolution_x = scene.render.resolution_y = 400
    scene.render.filepath = name
    bpy.ops.render.render(write_still=True)


def sapling():
    bpy.ops.preferences.addon_enable(module="add_curve_sapling")
    bpy.ops.curve.tree_add(do_update=True, bevel=True, levels=3, showLeaves=False, seed=3)
    tree = next(o for o in bpy.context.scene.objects if o.type == "CURVE")
    check(len(tree.data.splines) > 50, f"Sapling made {len(tree.data.splines)} branches")
    return tree


def leaning(count, skip, where):
    """Mean place of `where()` over so many steps, behind so many others."""
    steps(skip)
    sums = 0
    for _ in range(count):
        steps(2)
        sums = sums + where().mean(0)
    return sums / count


def curves(folder, pictures):
    enable(folder)
    settings = empty()
    tree = sapling()
    select(tree)
    drawn, of = control_points(tree)
    types = [(p.handle_left_type, p.handle_right_type) for s in tree.data.splines for p in s.bezier_points]

    # In still air it stands as it was drawn; in wind it leans with it, the more the stronger, the less the stiffer.
    settings.wind_speed, settings.gusts = 0, 0
    begin = time.monotonic()
    check(bpy.ops.bough.simulate() == {"FINISHED"}, "it is not simulated")
    bodies = len(operators().runs[tree.name].wood)
    check(operators().runs[tree.name].tree.trunks == 1, f"{operators().runs[tree.name].tree.trunks} trunks, expected one tree")
    begun = time.monotonic() - begin
    steps(20)
    points = lambda: control_points(tree)[0]
    height = drawn[:, 2].max()
    check(np.abs(points() - drawn).max() < 1e-4 * height, f"in still air it moves by {np.abs(points() - drawn).max()}")
    lean = {}
    for direction, along in ((0, [1, 0]), (math.pi / 2, [0, 1])):
        settings.wind_direction, settings.wind_speed = direction, 15
        way = leaning(10, 150, points) - drawn.mean(0)
        lean[direction] = way[:2] @ along
        check(lean[direction] > 0.9 * np.linalg.norm(way[:2]) and lean[direction] > 1e-3 * height, f"towards {direction} it leans by {way}")
    settings.stiffness = 10
    stiff = (leaning(10, 150, points) - drawn.mean(0))[1]
    check(0.02 * lean[math.pi / 2] < stiff < 0.4 * lean[math.pi / 2], f"ten times as stiff it leans by {stiff} after {lean[math.pi / 2]}")
    settings.stiffness, settings.gusts = 1, 1
    # Bodies are rigid: what lies on one keeps its distances. Every base stays on its branch as it was drawn on it.
    steps(60)
    run = operators().runs[tree.name]
    now = points()
    check(np.linalg.norm(now[0] - drawn[0]) < 1e-5, "the root has moved")
    splines = [np.flatnonzero(of == k) for k in range(of.max() + 1)]
    length = lambda at, p: np.linalg.norm(np.diff(p[at], axis=0), axis=1).sum()
    changed = max(abs(length(at, now) / length(at, drawn) - 1) for at in splines)
    check(changed < 0.02, f"a branch grew by {100 * changed} %")
    check(np.isfinite(now).all() and np.abs(now - drawn).max() > 1e-2, "nothing moves in gusts")
    shown = time.monotonic()
    for _ in range(20):
        operators().step_all(bpy.context.scene)
        bpy.context.view_layer.update()
    shown = (time.monotonic() - shown) / 20
    picture(f"{pictures}/curves.png")
    # The same run by bough.py alone, from the document: a point that lies on a body goes with it.
    bough = importlib.import_module("bough_wind.library").bough()
    check(np.array_equal(np.array(run.simulation.parents), np.array(run.wood.parents)), "another tree runs")
    # Stopped, everything is as it was.
    bpy.ops.bough.stop()
    check(np.abs(points() - drawn).max() < 1e-6, "stopped, it is not as it was drawn")
    check(types == [(p.handle_left_type, p.handle_right_type) for s in tree.data.splines for p in s.bezier_points], "handles have other types")

    # Baked, the curve that Blender evaluates at a frame is the one that the run showed in its step.
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 5, 28
    settings.settle = False
    check(bpy.ops.bough.bake() == {"FINISHED"}, "it is not baked")
    check(len(tree.data.shape_keys.key_blocks) == 25, f"{len(tree.data.shape_keys.key_blocks)} shape keys, expected 24 and the rest")
    played = {}
    for frame in (5, 13, 28):
        scene.frame_set(frame)
        played[frame] = evaluated(tree)
    tree.shape_key_clear()
    check(np.abs(control_points(tree)[0] - drawn).max() < 1e-5, "the baked curve's own points moved")
    bpy.ops.bough.simulate()
    for frame in range(5, 29):
        if frame > 5:
            steps(1)
        if frame in played:
            bpy.context.view_layer.update()
            wanted = evaluated(tree)
            off = np.abs(wanted - played[frame]).max() / height
            check(off < 1e-4, f"frame {frame} plays {off} of the height off")
    moved = np.abs(played[28] - played[5]).max()
    check(moved > 1e-2, f"baked, it moves by {moved}")
    bpy.ops.bough.stop()
    check(bough.__version__, "")
    print(f"blender: Sapling's {len(splines)} branches: {bodies} bodies; begun in {begun:.2f} s, {1000 * shown:.1f} ms a step shown; leans by {lean[0]:.3f} m "
          f"in 15 m/s, {stiff:.3f} m ten times as stiff; baked to 24 shape keys")


def trunk_and_branch():
    """The same tree twice: an armature with a skinned mesh, and a curve. Trunk of eight bones of 0.5 m, a side branch of four."""
    lines = [[Vector((0, 0, 0.5 * k)) for k in range(9)], [Vector((0.35 * k, 0.1 * k, 2.5 + 0.25 * k)) for k in range(5)]]
    radii = [[0.06 - 0.005 * k for k in range(9)], [0.02 - 0.003 * k for k in range(5)]]
    data = bpy.data.armatures.new("rig")
    rig = bpy.data.objects.new("rig", data)
    bpy.context.scene.collection.objects.link(rig)
    rig.rotation_euler, rig.location = (0, 0, 0.7), (3, -2, 0)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    made = [[], []]
    for number, line in enumerate(lines):
        for k in range(len(line) - 1):
            bone = data.edit_bones.new(f"{'trunk' if number == 0 else 'side'}{k}")
            bone.head, bone.tail = line[k], line[k + 1]
            bone.roll = 0.3 * k
            if k > 0:
                bone.parent, bone.use_connect = made[number][-1], True
            elif number == 1:
                bone.parent = made[0][4]
            made[number].append(bone)
    bpy.ops.object.mode_set(mode="OBJECT")
    vertices, faces, groups = [], [], []
    for number, (line, thick) in enumerate(zip(lines, radii)):
        for k in range(len(line) - 1):
            way = (line[k + 1] - line[k]).normalized()
            x = way.orthogonal().normalized()
            y = way.cross(x)
            first = len(vertices)
            for end in (0, 1):
                for corner in range(8):
                    turn = 2 * math.pi * corner / 8
                    vertices.append(line[k + end] + thick[k + end] * (math.cos(turn) * x + math.sin(turn) * y))
                    groups.append(f"{'trunk' if number == 0 else 'side'}{k}")
            faces += [(first + c, first + (c + 1) % 8, first + 8 + (c + 1) % 8, first + 8 + c) for c in range(8)]
    mesh = bpy.data.meshes.new("bark")
    mesh.from_pydata(vertices, [], faces)
    bark = bpy.data.objects.new("bark", mesh)
    bpy.context.scene.collection.objects.link(bark)
    for number, name in enumerate(groups):
        group = bark.vertex_groups.get(name) or bark.vertex_groups.new(name=name)
        group.add([number], 1, "REPLACE")
    bark.parent = rig
    bark.modifiers.new("rig", "ARMATURE").object = rig
    curve = bpy.data.curves.new("lines", "CURVE")
    curve.dimensions, curve.bevel_depth = "3D", 1
    for line, thick in zip(lines, radii):
        spline = curve.splines.new("POLY")
        spline.points.add(len(line) - 1)
        for point, place, radius in zip(spline.points, line, thick):
            point.co, point.radius = (*place, 1), radius
    twin = bpy.data.objects.new("twin", curve)
    bpy.context.scene.collection.objects.link(twin)
    twin.matrix_world = rig.matrix_world.copy()
    twin.rotation_euler, twin.location = rig.rotation_euler, rig.location
    bpy.context.view_layer.update()
    return rig, bark, twin


def skin(folder, pictures):
    enable(folder)
    settings = empty()
    rig, bark, twin = trunk_and_branch()
    drawn = evaluated(bark)
    settings.wind_speed, settings.wind_direction = 15, 0.4
    for thing in (bark, twin):
        select(thing)
        check(bpy.ops.bough.simulate() == {"FINISHED"}, f"{thing.name} is not simulated")
    check(set(operators().runs) == {"rig", "twin"}, f"{set(operators().runs)} run")
    # Tips of the bones and of the curve, which lie on the same wood, go the same way.
    tips = lambda: np.array([rig.matrix_world @ rig.pose.bones[name].tail for name in ("trunk7", "side3")])
    ends = lambda: np.array([twin.matrix_world @ spline.points[-1].co.to_3d() for spline in twin.data.splines])
    rest = ends()
    bpy.context.view_layer.update()
    check(np.abs(tips() - rest).max() < 1e-5, "bones and curve are not drawn alike")
    apart, way = 0, 0
    for _ in range(90):
        steps(1)
        bpy.context.view_layer.update()
        apart = max(apart, np.linalg.norm(tips() - ends(), axis=1).max())
        way = max(way, np.linalg.norm(ends() - rest, axis=1).max())
    check(way > 0.02, f"in 15 m/s the tips go {way} m")
    check(apart < 0.12 * way, f"bones and curve are {apart} m apart, moving by {way} m")
    skinned = evaluated(bark)
    followed, here = np.linalg.norm(skinned - drawn, axis=1).max(), np.linalg.norm(tips() - rest, axis=1).max()
    check(here > 1e-3 and abs(followed - here) < 0.2 * here, f"the mesh goes {followed} m with bones that go {here} m")
    foot = drawn[:, 2] < 0.01
    check(np.abs(skinned[foot] - drawn[foot]).max() < 0.02, "the foot has moved")
    picture(f"{pictures}/skin.png")
    bpy.ops.bough.stop()
    bpy.context.view_layer.update()
    check(np.abs(evaluated(bark) - drawn).max() < 1e-6, "stopped, it is not as it was drawn")

    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, settings.settle = 1, 20, False
    select(rig)
    check(bpy.ops.bough.bake() == {"FINISHED"}, "it is not baked")
    played = {}
    for frame in (1, 9, 20):
        scene.frame_set(frame)
        played[frame] = evaluated(bark)
    rig.animation_data_clear()
    select(rig)
    bpy.ops.bough.simulate()
    for frame in range(1, 21):
        if frame > 1:
            steps(1)
        if frame in played:
            bpy.context.view_layer.update()
            off = np.abs(evaluated(bark) - played[frame]).max()
            check(off < 1e-4, f"frame {frame} plays {off} m off")
    check(np.abs(played[20] - played[1]).max() > 1e-3, "baked, it stands still")
    settings.settle = True
    check(bpy.ops.bough.bake() == {"FINISHED"}, "it is not baked from the sway")
    scene.frame_set(1)
    check(np.abs(evaluated(bark) - drawn).max() > 5e-3, "baked from the sway it begins as drawn")
    print(f"blender: 12 bones: tips go {way:.3f} m, those of the same tree as a curve {apart:.4f} m beside; baked to {20 * 12} rotations")


def refused(folder, pictures):
    enable(folder)
    settings = empty()

    def says(thing, words):
        select(thing)
        try:
            bpy.ops.bough.simulate()
        except RuntimeError as error:
            check(words in str(error), f"{thing.name}: says {error}")
            return
        raise AssertionError(f"{thing.name}: is simulated")

    bpy.ops.mesh.primitive_cube_add()
    says(bpy.context.active_object, "an armature moves")
    curve = bpy.data.curves.new("dot", "CURVE")
    curve.splines.new("POLY")
    dot = bpy.data.objects.new("dot", curve)
    bpy.context.scene.collection.objects.link(dot)
    says(dot, "no spline of two points")
    bones = bpy.data.objects.new("none", bpy.data.armatures.new("none"))
    bpy.context.scene.collection.objects.link(bones)
    says(bones, "has no bones")
    # Each wood that the panel lists is one of the library's.
    properties = importlib.import_module("bough_wind.properties")
    rig, bark, twin = trunk_and_branch()
    select(twin)
    for name in properties.MATERIALS:
        settings.material = name
        check(bpy.ops.bough.simulate() == {"FINISHED"}, name)
    # Points that are added while it moves: it is let go of, as it was drawn, the new ones beside those that they were drawn from.
    bpy.ops.bough.stop()
    for kind in ("BEZIER", "POLY"):
        curve = bpy.data.curves.new(kind, "CURVE")
        curve.dimensions, curve.bevel_depth = "3D", 0.05
        points = getattr(curve.splines.new(kind), "bezier_points" if kind == "BEZIER" else "points")
        points.add(5)
        for k, point in enumerate(points):
            point.co[:3] = 0.1 * k, 0, 0.8 * k
        grown = bpy.data.objects.new(kind, curve)
        bpy.context.scene.collection.objects.link(grown)
        before = control_points(grown)[0]
        select(grown)
        settings.wind_speed, settings.wind_direction = 15, 0
        bpy.ops.bough.simulate()
        steps(30)
        bent = control_points(grown)[0]
        check(np.abs(bent - before).max() > 1e-3, f"{kind}: does not move")
        points.add(1)
        points[-1].co[:3] = tuple(bent[-1] + [0, 0, 0.1])
        wrong = operators().step_all(bpy.context.scene)
        check(len(wrong) == 1 and "its points are others" in wrong[0] and not operators().runs, f"{kind}: {wrong}")
        off = np.abs(control_points(grown)[0] - np.vstack([before, before[-1] + [0, 0, 0.1]])).max(1)
        check(off.max() < 1e-5, f"{kind}: points are left {off} m off")
    # So are bones that go, by Stop and by a step.
    select(rig)
    for gone, end in (("side3", bpy.ops.bough.stop), ("side2", lambda: operators().step_all(bpy.context.scene))):
        bpy.ops.bough.simulate()
        steps(10)
        bpy.ops.object.mode_set(mode="EDIT")
        rig.data.edit_bones.remove(rig.data.edit_bones[gone])
        bpy.ops.object.mode_set(mode="OBJECT")
        said = end()
        check("FINISHED" in said or "has other bones" in said[0], f"{said}")
        check(not operators().runs and max(abs(bone.rotation_quaternion.angle) for bone in rig.pose.bones) < 1e-6, "bones are left turned")
    select(twin)
    bpy.ops.bough.simulate()
    # An object that goes away while it moves is let go of; others move on.
    select(rig)
    bpy.ops.bough.simulate()
    bpy.data.objects.remove(twin)
    wrong = operators().step_all(bpy.context.scene)
    check(len(wrong) == 1 and "twin" in wrong[0] and set(operators().runs) == {"rig"}, f"{wrong}")
    steps(3)
    bpy.ops.preferences.addon_disable(module="bough_wind")
    check(not hasattr(bpy.types.Scene, "bough_wind"), "disabled, it is still there")
    bpy.ops.preferences.addon_enable(module="bough_wind")
    print(f"blender: three objects that are no trees are refused; {len(properties.MATERIALS)} woods")


def installed(archive, pictures):
    bpy.ops.preferences.addon_install(filepath=archive)
    check("FINISHED" in bpy.ops.preferences.addon_enable(module="bough_wind"), "the archive's add-on is not enabled")
    module = sys.modules["bough_wind"]
    check("bough_wind" in module.__file__ and module.bl_info["blender"] <= bpy.app.version, module.__file__)
    bough = importlib.import_module("bough_wind.library").bough()
    check(bough.__name__ == "bough_wind.bough", f"{bough.__name__} is taken")
    print(f"blender: {bpy.app.version_string}, Python {sys.version.split()[0]}: the archive is installed, bough {bough.__version__}")


def main():
    what, given, pictures = sys.argv[sys.argv.index("--") + 1 :]
    {"installed": installed, "curves": curves, "skin": skin, "refused": refused}[what](given, pictures)


main()
