"""Add-on preferences: the state of the native solver in plain words, links to the web, and the key of the pie."""
import bpy
import rna_keymap_ui

from .. import bl_info, native
from . import keymaps, manual_links

# Texts of buttons, and the keys of bl_info that hold their addresses, where the project has some.
# bl_info is imported, not looked up when drawing, because Blender removes it from an extension that it enables.
LINKS = (("Website", "website"), ("Report a Problem", "tracker_url"))


def draw_links(layout: bpy.types.UILayout) -> None:
    """Draws a button for each address of the project that the package has."""
    for text, key in LINKS:
        if bl_info.get(key):
            layout.operator("wm.url_open", text=text, icon='URL').url = bl_info[key]


class ReflinesPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__.rpartition(".")[0]  # the name of the add-on

    def draw(self, context: bpy.types.Context) -> None:
        if native.STATE.usable:
            self.layout.label(text=f"Native solver {native.reflines.__version__} is ready.", icon='CHECKMARK')
        else:
            self.layout.label(text=native.STATE.problem, icon='ERROR')
            self.layout.label(text=native.STATE.remedy, icon='BLANK1')
        row = self.layout.row()
        row.operator("wm.url_open", text="Manual", icon='HELP').url = manual_links.PAGE.as_uri()
        draw_links(row)
        config = context.window_manager.keyconfigs.user
        keymap = config.keymaps.get(keymaps.KEYMAP)
        for item in filter(keymaps.is_own, keymap.keymap_items if keymap is not None else ()):
            self.layout.context_pointer_set("keymap", keymap)
            rna_keymap_ui.draw_kmi([], config, keymap, item, self.layout, 0)
