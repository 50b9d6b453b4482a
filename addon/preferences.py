"""Add-on preferences: the state of the native solver in plain words."""
import bpy

from . import native


class ReflinesPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    def draw(self, _context: bpy.types.Context) -> None:
        if native.STATE.usable:
            self.layout.label(text=f"Native solver {native.reflines.__version__} is ready.", icon='CHECKMARK')
        else:
            self.layout.label(text=native.STATE.problem, icon='ERROR')
            self.layout.label(text=native.STATE.remedy, icon='BLANK1')


register, unregister = bpy.utils.register_classes_factory([ReflinesPreferences])
