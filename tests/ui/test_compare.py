"""Compare with Before: a divider that the mouse drags over the panel, wherever there is a difference to be seen."""
import json
import sys
from collections.abc import Generator

import bpy
import numpy as np

import scenes
import window
from picture import CELLS, Steps, captured, striped_panel


def stripes() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines.stripes


def divider(driver: window.Window) -> float | None:
    """Where the line between before and after stands, pixels of the view; None where there is none."""
    return sys.modules["reflection_lines"].state.compared.find_divider(driver.region())


def pressed(driver: window.Window, name: str, *, levels: int = 0, result: str = 'MESH') -> Generator[float, None, None]:
    """A panel after a press of Smooth Lines in Object Mode, with Compare on."""
    ob = striped_panel(driver, name)
    if levels:
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = levels
    with driver.override():
        scenes.edit_inner(ob, CELLS)
        scenes.smooth(strength=0.0)  # stores the region
        scenes.object_mode()
        bpy.ops.ed.undo_push(message="Start")
        bpy.context.scene.reflection_lines.result = result
        bpy.ops.reflines.smooth('EXEC_DEFAULT', True, length=1.0)
        bpy.context.scene.reflection_lines.result = 'MESH'
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
        stripes().before = False
    driver.redraw()
    yield 0.3
    stripes().before, stripes().side_by_side = True, True
    driver.redraw()
    yield 0.5


def drag(driver: window.Window, start: float, end: float, *keys: str) -> Steps:
    """Drags from one place to another, both across the view's middle, and presses keys before the button is let go."""
    height = driver.region().height // 2
    driver.move(start, height)
    yield 0.3
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.2
    for share in (0.3, 0.7, 1.0):
        driver.move(start + share * (end - start), height)
        yield 0.1
    for key in keys:
        driver.key(key)
        yield 0.2
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.3


def test_the_divider_is_dragged_over_the_panel(driver: window.Window) -> Steps:
    yield from pressed(driver, "Dragged")
    began = divider(driver)
    panel = driver.region().width / 2  # where prepare puts it
    assert abs(began - panel) < 30, (began, panel)
    yield from drag(driver, began, began + 90)
    both = yield from captured(driver)
    yield from window.take_picture(driver, "compare")
    x = round(divider(driver))
    assert abs(x - began - 90) <= 1.5, (x, began)
    stripes().side_by_side = False
    before = yield from captured(driver)
    stripes().before = False
    after = yield from captured(driver)
    assert np.array_equal(both[:, :x - 1], before[:, :x - 1]) and np.array_equal(both[:, x + 1:], after[:, x + 1:])
    changed = (before != after).any(axis=0)
    assert changed[x - 80:x].mean() > 0.9  # where it was dragged over
    stripes().before, stripes().side_by_side = True, True
    driver.redraw()
    yield 0.3
    assert divider(driver) == began  # switched on anew it begins in the middle


def test_escape_puts_it_back_and_a_press_beside_it_selects(driver: window.Window) -> Steps:
    yield from pressed(driver, "Beside")
    began, ob = divider(driver), bpy.data.objects["Beside"]
    yield from drag(driver, began + 3, began - 90, 'ESC')
    assert divider(driver) == began
    ob.select_set(False)
    driver.move(began + 20, driver.region().height // 2)
    yield 0.2
    driver.key('LEFTMOUSE')
    yield 0.4
    assert ob.select_get() and divider(driver) == began


def test_it_stays_over_the_panel_as_the_view_moves(driver: window.Window) -> Steps:
    yield from pressed(driver, "Moved")
    began = divider(driver)
    scale = driver.region().width / (2.0 * driver.region_3d().view_distance)
    driver.region_3d().view_location[0] -= 0.2
    driver.region_3d().view_distance *= 1.3
    driver.redraw()
    yield 0.4
    assert 20 < divider(driver) - began < scale * 0.4, (divider(driver), began)


def test_undo_takes_the_divider_away_and_redo_brings_it_back(driver: window.Window) -> Steps:
    for name, levels in (("Mesh", 0), ("Cage", 2)):
        yield from pressed(driver, name, levels=levels)
        assert divider(driver) is not None, name
        for step, there in (("undo", False), ("redo", True)):
            with driver.override():
                getattr(bpy.ops.ed, step)()
            driver.redraw()
            yield 0.5
            assert (divider(driver) is not None) == there, (name, step)


def test_a_shape_key_is_compared_at_any_strength_but_none(driver: window.Window) -> Steps:
    yield from pressed(driver, "Key", result='SHAPE_KEY')
    key = bpy.data.objects["Key"].data.shape_keys.key_blocks["Reflection Lines"]
    for value, there in ((1.0, True), (0.5, True), (0.0, False)):
        key.value = value
        driver.redraw()
        yield 0.4
        assert (divider(driver) is not None) == there, value


def test_a_pulled_line_is_compared(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Pulled")
    stripes().before, stripes().side_by_side = True, True
    driver.redraw()
    yield 0.4
    assert divider(driver) is None
    with driver.override():
        scenes.edit_inner(ob, CELLS)
        handle = {"start": (0.1, 0.2, 0.0), "end": (0.1, 0.3, 0.0), "radius": 0.5, "pinned": [], "muted": False}
        assert bpy.ops.reflines.pull_line('EXEC_DEFAULT', True, handles=json.dumps([handle])) == {'FINISHED'}
    driver.redraw()
    yield 0.5
    assert divider(driver) is not None
