"""The operator Save Stripes Preset."""
import bpy
from bl_operators.presets import AddPresetBase

# The look: what belongs to a scene, as its collection, image and frozen eye, is no part of a preset.
LOOK = ("mode", "eye", "scope", "image_rotation", "count", "width", "softness", "color", "gap_color")


class REFLINES_OT_save_stripes_preset(AddPresetBase, bpy.types.Operator):
    """Save the look of the stripes as a preset for all files, or remove one"""
    bl_idname = "reflines.save_stripes_preset"
    bl_label = "Save Stripes Preset"
    preset_menu = "VIEW3D_PT_reflines_stripe_presets"
    preset_subdir = "reflection_lines/stripes"
    # Whole paths and no names of its own: Blender 4.3 with Python 3.13 evaluates the values where it cannot see them.
    preset_defines = []
    preset_values = [f"bpy.context.scene.reflection_lines.stripes.{name}" for name in LOOK]
