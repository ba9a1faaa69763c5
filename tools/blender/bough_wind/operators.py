"""Simulate, Stop, Bake: and the timer that steps what is simulated, on Blender's main thread."""
import time

import bpy
from bpy.app.handlers import persistent

from .curves import NotATree
from .library import Missing, bough
from .run import Run, tree_of

runs = {}  # by the object's name
clock = {"last": None, "owed": 0.0}


def refusals():
    try:
        return (bough().Error, NotATree, Missing)
    except Missing:
        return (NotATree, Missing)


def stop(name, scene):
    run = runs.pop(name, None)
    if run:
        run.end(run.found(scene))


def stop_all():
    for name in list(runs):
        stop(name, bpy.context.scene)


def step_all(scene, steps=1):
    """Every run so many steps on, and shown. What fails is stopped; returns what was wrong."""
    wrong = []
    for name, run in list(runs.items()):
        blender_object = run.found(scene)
        try:
            if blender_object is None:
                raise NotATree(f"{name}: is gone")
            for _ in range(steps):
                run.step()
            run.show(blender_object)
        except refusals() as error:
            wrong.append(str(error))
            stop(name, scene)
    return wrong


def tick():
    """Of Blender's timer: the steps that the time since the last tick asks for; what there is no time for is left out."""
    if not runs:
        return None
    step = 1 / max(run.rate for run in runs.values())
    now = time.monotonic()
    clock["owed"] = min(clock["owed"] + (now - clock["last"] if clock["last"] is not None else step), 2 * step)
    clock["last"] = now
    steps = int(clock["owed"] / step + 1e-6)
    clock["owed"] -= steps * step
    for text in step_all(bpy.context.scene, steps):
        print(f"Bough Wind: {text}")
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
    return max(0.001, step - (time.monotonic() - now))


def wind_changed(settings, context):
    for run in runs.values():
        run.change_wind(settings)


def wood_changed(settings, context):
    for run in runs.values():
        run.change_wood(settings)


@persistent
def file_loads(*_):
    runs.clear()  # their objects are another file's


@persistent
def file_is_saved(*_):
    stop_all()  # trees are saved as they were drawn


class Simulate(bpy.types.Operator):
    """The selected tree moves in the wind, while the sliders are dragged"""
    bl_idname = "bough.simulate"
    bl_label = "Simulate"

    @classmethod
    def poll(cls, context):
        return context.active_object is not None

    def execute(self, context):
        try:
            target, _ = tree_of(context.active_object, context.scene)
            stop(target.name, context.scene)
            run = Run(target, context.scene, context.scene.bough_wind)
        except refusals() as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        runs[run.name] = run
        run.show(target)
        clock.update(last=None, owed=0.0)
        if not bpy.app.background and not bpy.app.timers.is_registered(tick):
            bpy.app.timers.register(tick)
        self.report({"INFO"}, f"{run.name}: {len(run.wood)} bodies, {run.tree.trunks} on the ground")
        return {"FINISHED"}


class Stop(bpy.types.Operator):
    """All trees stand as they were drawn"""
    bl_idname = "bough.stop"
    bl_label = "Stop"

    @classmethod
    def poll(cls, context):
        return bool(runs)

    def execute(self, context):
        stop_all()
        return {"FINISHED"}


class Bake(bpy.types.Operator):
    """The selected tree's motion over the scene's frames becomes keys: a curve's shape keys, an armature's rotations"""
    bl_idname = "bough.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.active_object is not None

    def execute(self, context):
        scene, settings = context.scene, context.scene.bough_wind
        try:
            target, _ = tree_of(context.active_object, scene)
            stop(target.name, scene)
            run = Run(target, scene, settings)
        except refusals() as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        frames, shapes = range(scene.frame_start, scene.frame_end + 1), []
        context.window_manager.progress_begin(0, len(frames))
        try:
            if settings.settle:
                run.simulation.settle()
            for k, _ in enumerate(frames):
                if k:
                    run.step()
                shapes.append(run.shape())
                context.window_manager.progress_update(k)
        except refusals() as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            context.window_manager.progress_end()
            run.end(target)
        run.tree.bake(target, list(frames), shapes)
        self.report({"INFO"}, f"{run.name}: {len(shapes)} frames")
        return {"FINISHED"}


classes = (Simulate, Stop, Bake)


def register():
    for one in classes:
        bpy.utils.register_class(one)
    bpy.app.handlers.load_pre.append(file_loads)
    bpy.app.handlers.save_pre.append(file_is_saved)


def unregister():
    bpy.app.handlers.load_pre.remove(file_loads)
    bpy.app.handlers.save_pre.remove(file_is_saved)
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
    for one in reversed(classes):
        bpy.utils.unregister_class(one)
