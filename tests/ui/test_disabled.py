"""Disabling the add-on takes back what runs, and what Blender goes on to call afterwards raises nothing."""

import bpy
import numpy as np

import installation
import scenes
import window
from dragging import applied, panel, shown, take_tool
from errors import read_errors
from pulling import MIDDLE, UP, pull, start
from window import Steps


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
    yield from take_tool(driver, "reflection_lines.fair_brush", (300, 290))
    written = yield from read_errors(without_the_addon(driver))
    assert "Traceback" not in written, written


def test_a_swept_light_is_turned_back(driver: window.Window) -> Steps:
    panel(driver)
    light = bpy.context.scene.reflection_lines.light
    before = np.array(light.matrix_world)
    driver.move(300, 290)
    with driver.override():
        assert bpy.ops.reflines.sweep_light('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}
    yield 0.2
    driver.move(400, 290)
    yield 0.2
    assert not np.array_equal(np.array(light.matrix_world), before)
    written = yield from read_errors(without_the_addon(driver))
    assert np.array_equal(np.array(light.matrix_world), before) and "Traceback" not in written, written


def test_a_stroke_is_taken_back(driver: window.Window) -> Steps:
    panel(driver, cells=24)
    before = shown(driver)
    yield from take_tool(driver, "reflection_lines.fair_brush", MIDDLE)
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.3
    assert not np.array_equal(shown(driver), before)
    written = yield from read_errors(without_the_addon(driver))
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.2
    assert np.array_equal(shown(driver), before) and "Traceback" not in written, written


def test_a_bake_is_taken_back(driver: window.Window) -> Steps:
    yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    yield from applied(driver)
    ob, scene = bpy.context.view_layer.objects.active, bpy.context.scene
    handle = ob.reflection_lines.handles.kept[0]
    for frame in (1, 900):
        handle.keyframe_insert("radius", frame=frame)
    scene.frame_set(901)  # none of the bake's
    before = scenes.fingerprint(ob)
    driver.move(300, 290)
    with driver.override():
        assert bpy.ops.reflines.bake_handles('INVOKE_DEFAULT', True, step=1) == {'RUNNING_MODAL'}
    for _ in range(100):
        yield 0.1
        if scene.frame_current != 901:
            break
    assert ob.mode == 'OBJECT' and scene.frame_current < 900, (ob.mode, scene.frame_current)
    written = yield from read_errors(without_the_addon(driver))
    assert ob.mode == 'EDIT' and scene.frame_current == 901 and scenes.fingerprint(ob) == before
    assert "Traceback" not in written, written
