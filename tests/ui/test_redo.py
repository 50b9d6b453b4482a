"""Adjust Last Operation and undo, in a window, with the operator started by a key as an artist does."""
import sys

import bpy
import numpy as np

import scenes
import window
from dragging import adjust, applied, comes_to, panel, shown, struck, undone_and_redone
from window import Steps


def smoothed(driver: window.Window, **settings: object) -> np.ndarray:
    """What the operator makes of a fresh panel with these settings."""
    panel(driver)
    with driver.override():
        scenes.smooth(**settings)
    return shown(driver)


def press_smooth(driver: window.Window) -> Steps:
    keymap = bpy.context.window_manager.keyconfigs.addon.keymaps.new(name="3D View", space_type='VIEW_3D')
    item = keymap.keymap_items.new("reflines.smooth", 'Y', 'PRESS', ctrl=True, alt=True)
    driver.move(300, 300)
    yield 0.2
    yield from struck(driver, 'Y', ctrl=True, alt=True)
    yield from applied(driver)
    keymap.keymap_items.remove(item)


def test_other_settings_start_from_the_mesh_before(driver: window.Window) -> Steps:
    """Those of a given length, and those of the automatic one."""
    automatic = smoothed(driver)
    for changed in ({"length": 0.9, "strength": 0.5}, {"lights": 'SINGLE', "symmetric": False}):
        expected = smoothed(driver, **changed)
        panel(driver)
        before = shown(driver)
        yield from press_smooth(driver)
        assert not any(np.array_equal(each, other) for each, other in ((shown(driver), before), (automatic, expected)))
        yield from adjust(driver, **changed)
        assert np.array_equal(shown(driver), expected)


def test_another_strength_is_that_of_a_fresh_press(driver: window.Window) -> Steps:
    expected = smoothed(driver, strength=0.4)
    panel(driver)
    yield from press_smooth(driver)
    presses = sys.modules["reflection_lines"].state.press_cache._presses
    kept, = presses.values()
    yield from adjust(driver, strength=0.4)
    assert [press.smoother for press in presses.values()] == [kept.smoother]
    assert np.array_equal(shown(driver), expected)


def test_resolve_after_ctrl_z_in_edit_mode_presses_again(driver: window.Window) -> Steps:
    """The run outlives the undo there, its region does not: that is the selection."""
    panel(driver)
    before = shown(driver)
    yield from press_smooth(driver)
    after = shown(driver)
    driver.key('Z', ctrl=True)
    yield from comes_to(driver, before)
    with driver.override():
        assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert bpy.context.mode == 'EDIT_MESH' and np.array_equal(shown(driver), after)
    yield from undone_and_redone(driver, before, after)
