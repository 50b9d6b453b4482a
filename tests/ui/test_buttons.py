"""Buttons in a real window: the tool's button solves at once, the handle beside it drags, and F3 does as the button."""
import sys
from collections.abc import Generator

import bpy
import numpy as np

import sidebar
import window
from dragging import dragged_length, ended, executed, moved, panel, settled, shown, taken_back, undone_and_redone
from window import Steps

HANDLE = "bpy.ops.reflines.smooth(follow_mouse=True)"
STEP = 6  # pixels between two places to try along a row: a third of a handle's width


def prepared(driver: window.Window) -> Steps:
    """A panel to work on, the tab open, and the mouse where a hand has it then."""
    panel(driver)
    yield 0.3
    yield from sidebar.open_tab(driver)


def find_handle(driver: window.Window, y: int) -> Generator[float, None, int]:
    """Returns how far the handle at the end of a row is from the sidebar's left edge, in pixels."""
    for x in range(driver.region('UI').width - 20, 100, -STEP):
        sidebar.point(driver, x, y)
        yield 0.05
        if (yield from sidebar.read_button(driver)) == HANDLE:
            return x
    raise AssertionError(f"the row at {y} has no handle")


def test_the_button_solves_at_once_wherever_the_mouse_goes_then(driver: window.Window) -> Steps:
    expected = executed(driver)
    yield from prepared(driver)
    before = shown(driver)
    x, y = yield from sidebar.find_button(driver, "bpy.ops.reflines.smooth()")
    yield from sidebar.press(driver, x, y)
    yield from ended(driver)
    assert np.array_equal(shown(driver), expected)
    driver.move(300, 300)  # into the view and a click there, as a hand does that expects a drag
    yield 0.2
    driver.key('MIDDLEMOUSE')
    yield 0.3
    assert np.array_equal(shown(driver), expected)
    assert bpy.context.active_operator.bl_idname == "REFLINES_OT_smooth"
    assert any(region.type == 'HUD' and region.height > 1 for region in driver.area().regions)
    yield from undone_and_redone(driver, before, expected)


def test_the_handle_drags_from_the_present_value_wherever_the_mouse_is(driver: window.Window) -> Steps:
    """The mouse is put into the middle of the view; what is kept becomes the sidebar's setting."""
    yield from prepared(driver)
    bpy.context.scene.reflection_lines.strength = 0.8
    _, y = yield from sidebar.find_button(driver, "bpy.ops.reflines.smooth()")
    handle = yield from find_handle(driver, y)
    yield from sidebar.press(driver, handle, y)
    yield from settled(driver)
    begun = shown(driver)
    yield from window.take_picture(driver, "handle")
    middle = sys.modules["reflection_lines"].view.view_region.find_view_middle(driver.area())[0] - driver.region().x
    assert 100 < middle < driver.region('UI').x - driver.region().x - 100
    yield from moved(driver, middle - 150, 300)
    driver.key('LEFTMOUSE')
    yield from ended(driver)
    assert abs(bpy.context.scene.reflection_lines.strength - 0.3) < 1e-6
    assert bpy.context.scene.reflection_lines.length == 0.0  # not touched: still automatic
    kept, length = shown(driver), dragged_length()
    assert np.abs(begun - executed(driver, strength=0.8, length=length)).max() < 1e-5
    assert np.abs(kept - executed(driver, strength=0.3, length=length)).max() < 1e-6


def test_escape_leaves_the_settings_too(driver: window.Window) -> Steps:
    panel(driver)
    bpy.context.scene.reflection_lines.strength = 0.7
    driver.move(400, 300)
    with driver.override():
        assert bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, follow_mouse=True) == {'RUNNING_MODAL'}
    yield from settled(driver)
    yield from moved(driver, 250, 300)
    yield from taken_back(driver)
    assert abs(bpy.context.scene.reflection_lines.strength - 0.7) < 1e-6
