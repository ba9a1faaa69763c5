"""blender -b --factory-startup --python-exit-code 1 -P cycles.py -- FILE.glb PICTURE.png WIDTHxHEIGHT SAMPLES [ZOOM]

Imports FILE.glb as a user would and draws it with Cycles on the CPU: Blender's own sky with the sun in it, a lawn that takes the shadow, a camera at a
man's height that sees the whole tree. Above ZOOM 1 the camera sees that much less of it, about its middle. The .glb's materials are left as they come.
"""
import math
import sys

import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that Debian's numpy no longer has
import bpy
import mathutils

file, picture, size, samples, *zoom = sys.argv[sys.argv.index("--") + 1:]
width, height = map(int, size.split("x"))
zoom = float(zoom[0]) if zoom else 1.0

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=file)
scene = bpy.context.scene
shown = bpy.context.evaluated_depsgraph_get()
corners = [o.matrix_world @ mathutils.Vector(c) for o in scene.objects if o.type == "MESH" for c in o.evaluated_get(shown).bound_box]
if not corners:
    sys.exit(f"cycles: {file} holds no mesh")
low, high = (mathutils.Vector(f(c[k] for c in corners) for k in range(3)) for f in (min, max))
middle, tall, wide = (low + high) / 2, high.z - low.z, max(high.x - low.x, high.y - low.y)

bpy.ops.mesh.primitive_plane_add(size=400 * tall, location=(middle.x, middle.y, low.z + 0.005 * tall))
lawn = bpy.data.materials.new("lawn")
lawn.use_nodes = True
lawn.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.10, 0.13, 0.05, 1)
lawn.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 1
bpy.context.object.data.materials.append(lawn)

world = scene.world = bpy.data.worlds.new("sky")
world.use_nodes = True
sky = world.node_tree.nodes.new("ShaderNodeTexSky")
sky.sun_elevation, sky.sun_rotation, sky.sun_intensity = math.radians(38), math.radians(135), 0.35
world.node_tree.links.new(sky.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.1

angle = math.radians(28)
distance = 1.12 * max(tall, wide * height / width) / (2 * math.tan(angle / 2)) + wide / 2
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (middle.x, middle.y - distance, low.z + min(1.7, 0.3 * tall))
camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.sensor_fit = "VERTICAL"
camera.data.angle = 2 * math.atan(math.tan(angle / 2) / zoom)
camera.data.clip_end = 100 * distance
scene.collection.objects.link(camera)
scene.camera = camera

scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = int(samples)
scene.cycles.use_denoising = False  # Debian's Blender is built without a denoiser
scene.cycles.transparent_max_bounces = 32  # a crown is many cut-out leaves behind one another
scene.view_settings.view_transform = "Filmic"
scene.view_settings.look = "Medium High Contrast"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
