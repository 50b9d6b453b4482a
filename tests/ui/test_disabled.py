"""What Blender goes on to call after the add-on was disabled raises nothing."""
from collections.abc import Generator

import bpy

import installation
import window
from dragging import panel
from errors import read_errors

Steps = Generator[float, None, None]


def without_the_addon(driver: window.Window) -> Steps:
    """The mouse moves over the view while the add-on is disabled."""
    with driver.override():
        bpy.ops.preferences.addon_disable(module=installation.NAME)
    for x in (300, 320, 340):
        driver.move(x, 290)
        driver.redraw()
        yield 0.2
    with driver.override():
        installation.install()
    yield 0.2


def test_the_cursor_of_fair_brush_is_not_drawn(driver: window.Window) -> Steps:
    panel(driver)
    driver.move(300, 290)
    with driver.override():
        assert bpy.ops.wm.tool_set_by_id(name="reflection_lines.fair_brush") == {'FINISHED'}
    driver.redraw()
    yield 0.3
    written = yield from read_errors(without_the_addon(driver))
    assert "Traceback" not in written, written


window.run(test_the_cursor_of_fair_brush_is_not_drawn)
