"""Blender's preset menu for the look of the stripes."""
import bpy
from bl_ui.utils import PresetPanel


class VIEW3D_PT_reflines_stripe_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Stripes Presets"
    preset_subdir = "reflection_lines/stripes"
    preset_operator = "script.execute_preset"
    preset_add_operator = "reflines.save_stripes_preset"

    def draw(self, context: bpy.types.Context) -> None:
        """Draws the artist's own presets."""
        if bpy.utils.preset_paths(self.preset_subdir):
            super().draw(context)
        else:  # Blender would say that paths are missing
            self.draw_first(context.window_manager)

    def draw_first(self, manager: bpy.types.WindowManager) -> None:
        """Draws the row that saves the first preset, as Blender draws it below others."""
        row = self.layout.row()
        row.emboss = 'NORMAL'
        row.prop(manager, "preset_name", text="")
        row.operator(self.preset_add_operator, text="", icon='ADD', emboss=False).name = manager.preset_name
