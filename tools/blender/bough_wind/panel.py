"""The panel in the 3D view's sidebar."""
import bpy

from . import operators


class WindPanel(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_bough_wind"
    bl_label = "Bough Wind"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Bough"

    def draw(self, context):
        settings, layout = context.scene.bough_wind, self.layout
        layout.use_property_split = True
        layout.prop(settings, "material")
        row = layout.row(align=True)
        row.operator("bough.simulate", icon="PLAY")
        row.operator("bough.stop", icon="PAUSE")
        for name in ("wind_speed", "wind_direction", "gusts", "seed", "stiffness", "damping"):
            layout.prop(settings, name)
        for run in operators.runs.values():
            layout.label(text=f"{run.name}: {len(run.wood)} bodies")
        layout.separator()
        layout.prop(settings, "settle")
        layout.operator("bough.bake", icon="KEYTYPE_KEYFRAME_VEC")


def register():
    bpy.utils.register_class(WindPanel)


def unregister():
    bpy.utils.unregister_class(WindPanel)
