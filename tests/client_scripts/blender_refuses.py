"""blender -b --factory-startup --python-exit-code 1 -P blender_refuses.py -- FILE.glb: its importer must say that it does
not know the extension which the file requires, rather than show something else."""
import sys

import numpy

numpy.bool = bool  # see blender.py
import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
try:
    bpy.ops.import_scene.gltf(filepath=sys.argv[-1])
except RuntimeError as error:
    assert "EXT_mesh_gpu_instancing" in str(error), error
    print("blender:", str(error).strip().splitlines()[-1])
else:
    found = [o.name for o in bpy.data.objects]
    assert not found, f"Blender shows {found}"
