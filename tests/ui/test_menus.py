"""Menus, pie and key in a real window."""
import os
import tempfile

import bpy
import numpy as np

import scenes
import window
from dragging import executed, panel, shown, struck, taken_back
from window import Steps

MODIFIERS = ("ctrl", "alt", "shift", "oskey")


def own_key() -> bpy.types.KeyMapItem:
    keymap = bpy.context.window_manager.keyconfigs.addon.keymaps["3D View"]
    return next(item for item in keymap.keymap_items if item.idname == "wm.call_menu_pie"
                and item.properties.name == "VIEW3D_MT_reflines_pie")


def test_the_key_collides_with_nothing(_: window.Window) -> Steps:
    """In no keymap of Blender's that can be active over a 3D view."""
    own, compared, taken = own_key(), 0, []
    for keymap in bpy.context.window_manager.keyconfigs.default.keymaps:
        if keymap.is_modal or keymap.space_type not in {'EMPTY', 'VIEW_3D'}:  # modal: only while walking, flying ...
            continue
        for item in keymap.keymap_items:
            compared += 1
            same = all(bool(getattr(item, name)) == bool(getattr(own, name)) for name in MODIFIERS) or item.any
            if item.type == own.type and same:
                taken.append(f"{keymap.name}: {item.idname}")
    assert compared > 1000
    assert not taken, taken
    yield 0.0


def opened_without_error(driver: window.Window, name: str) -> Steps:
    with tempfile.TemporaryFile(mode="w+") as errors:
        kept = os.dup(2)
        os.dup2(errors.fileno(), 2)
        try:
            with driver.override():
                call = bpy.ops.wm.call_menu_pie if name.endswith("pie") else bpy.ops.wm.call_menu
                call('INVOKE_DEFAULT', name=name)
            yield 0.3
            driver.key('ESC')
            yield 0.2
        finally:
            os.dup2(kept, 2)
        errors.seek(0)
        written = errors.read()
    assert "Error" not in written and "unknown" not in written and "not found" not in written, written


def test_menus_open_in_both_modes(driver: window.Window) -> Steps:
    driver.move(400, 400)
    with driver.override():
        ob = scenes.panel()
        scenes.look_from_above()
    for _ in range(2):
        for name in ("VIEW3D_MT_reflines", "VIEW3D_MT_reflines_pie", "VIEW3D_MT_reflines_drag",
                     "VIEW3D_MT_reflines_drag_pie", "VIEW3D_MT_reflines_export"):
            yield from opened_without_error(driver, name)
        with driver.override():
            scenes.edit_inner(ob)
    yield from opened_without_error(driver, "VIEW3D_MT_edit_mesh_context_menu")


def test_the_key_opens_the_pie(driver: window.Window) -> Steps:
    """Show Stripes lies in the south."""
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.show = False
    driver.move(400, 400)
    yield 0.2
    driver.key('R', ctrl=True, alt=True, shift=True)
    yield 0.4
    driver.move(400, 300)
    yield 0.2
    driver.key('LEFTMOUSE')
    yield 0.3
    assert stripes.show


def test_the_second_pie_drags_what_the_first_presses(driver: window.Window) -> Steps:
    """Smooth lies in the west of both; the drag begins with the sidebar's value where the mouse is then."""
    whole, before = executed(driver, length=0.5), None
    for pie, change in (("VIEW3D_MT_reflines_pie", True), ("VIEW3D_MT_reflines_drag_pie", False)):
        panel(driver)
        bpy.context.scene.reflection_lines.length = 0.5
        before = shown(driver)
        driver.move(400, 300)
        with driver.override():
            bpy.ops.wm.call_menu_pie('INVOKE_DEFAULT', name=pie)
        yield 0.4
        driver.move(300, 300)
        yield 0.2
        yield from struck(driver, 'LEFTMOUSE')
        assert np.abs(shown(driver) - whole).max() < 1e-5
        yield from taken_back(driver)
        assert np.array_equal(shown(driver), whole if change else before)
