"""The keymap: Ctrl Alt Shift R in a 3D view opens the pie menu; Blender's own keymap leaves that key free."""
import bpy

KEYMAP = "3D View"
PIE = "VIEW3D_MT_reflines_pie"
KEY = {"type": 'R', "value": 'PRESS', "ctrl": True, "alt": True, "shift": True}


def is_own(item: bpy.types.KeyMapItem) -> bool:
    return item.idname == "wm.call_menu_pie" and item.properties is not None and item.properties.name == PIE


def register() -> None:
    config = bpy.context.window_manager.keyconfigs.addon
    if config is None:  # in the background
        return
    keymap = config.keymaps.new(name=KEYMAP, space_type='VIEW_3D')
    keymap.keymap_items.new("wm.call_menu_pie", **KEY).properties.name = PIE


def unregister() -> None:
    config = bpy.context.window_manager.keyconfigs.addon
    keymap = config.keymaps.get(KEYMAP) if config is not None else None
    for item in list(keymap.keymap_items) if keymap is not None else ():
        if is_own(item):
            keymap.keymap_items.remove(item)
