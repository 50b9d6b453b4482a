"""Add-on preferences: the state of the native solver in plain words, and the key of the pie."""
import bpy
import rna_keymap_ui

from .. import native
from . import keymaps, manual_links


class ReflinesPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__.rpartition(".")[0]  # the name of the add-on

    def draw(self, context: bpy.types.Context) -> None:
        if native.STATE.usable:
            self.layout.label(text=f"Native solver {native.reflines.__version__} is ready.", icon='CHECKMARK')
        else:
            self.layout.label(text=native.STATE.problem, icon='ERROR')
            self.layout.label(text=native.STATE.remedy, icon='BLANK1')
        self.layout.operator("wm.url_open", text="Manual", icon='HELP').url = manual_links.PAGE.as_uri()
        config = context.window_manager.keyconfigs.user
        keymap = config.keymaps.get(keymaps.KEYMAP)
        for item in filter(keymaps.is_own, keymap.keymap_items if keymap is not None else ()):
            self.layout.context_pointer_set("keymap", keymap)
            rna_keymap_ui.draw_kmi([], config, keymap, item, self.layout, 0)


register, unregister = bpy.utils.register_classes_factory([ReflinesPreferences])
