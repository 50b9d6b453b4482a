"""Blender's preset menu for the look of the stripes."""
import bpy
from bl_ui.utils import PresetPanel


class VIEW3D_PT_reflines_stripe_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Stripes Presets"
    preset_subdir = "reflection_lines/stripes"
    preset_operator = "script.execute_preset"
    preset_add_operator = "reflines.save_stripes_preset"


register, unregister = bpy.utils.register_classes_factory([VIEW3D_PT_reflines_stripe_presets])
