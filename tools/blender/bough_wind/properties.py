"""What the sliders set; kept with Blender's scene."""
import bpy

from . import operators

MATERIALS = ("red-maple", "sugar-maple", "black-cherry", "black-willow", "quaking-aspen", "paper-birch", "northern-red-oak",
             "apple", "douglas-fir", "eastern-white-pine", "loblolly-pine", "coconut-palm")


class Settings(bpy.types.PropertyGroup):
    wind_speed: bpy.props.FloatProperty(name="Wind", description="Mean speed at 10 m", default=8, min=0, soft_max=25, max=80, unit="VELOCITY",
                                        update=operators.wind_changed)
    wind_direction: bpy.props.FloatProperty(name="Towards", description="From +x to +y", default=0, subtype="ANGLE", update=operators.wind_changed)
    gusts: bpy.props.FloatProperty(name="Gusts", description="0: steady; 1: gusts and turbulence as over open land", default=1, min=0, max=2,
                                   update=operators.wind_changed)
    seed: bpy.props.IntProperty(name="Seed", description="Of the turbulence", default=0, min=0, update=operators.wind_changed)
    stiffness: bpy.props.FloatProperty(name="Stiffness", description="Times the wood's own", default=1, min=0.01, soft_max=10, max=1000,
                                       update=operators.wood_changed)
    damping: bpy.props.FloatProperty(name="Damping", description="Times the wood's own", default=1, min=0.01, soft_max=10, max=100,
                                     update=operators.wood_changed)
    material: bpy.props.EnumProperty(name="Wood", description="Taken when Simulate is pressed",
                                     items=[(name, name.replace("-", " ").capitalize(), "") for name in MATERIALS], default="red-maple")
    settle: bpy.props.BoolProperty(name="Begin in the sway", description="Bake from a tree that the wind has moved for a while", default=True)


def register():
    bpy.utils.register_class(Settings)
    bpy.types.Scene.bough_wind = bpy.props.PointerProperty(type=Settings)


def unregister():
    del bpy.types.Scene.bough_wind
    bpy.utils.unregister_class(Settings)
