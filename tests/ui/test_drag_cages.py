"""Drags of a cage below a Subdivision Surface, in a window: it follows by few samples, and is kept by all."""

import bpy
import numpy as np

import scenes
import window
from dragging import Steps, comes_to, dragged_length, ended, executed, panel, press, settled, shown

LEVELS = 3  # from here on a drag leaves samples out


def test_a_cage_follows_and_escape_leaves_no_bit_changed(driver: window.Window) -> Steps:
    ob = panel(driver, levels=LEVELS)
    before = scenes.fingerprint(ob)
    yield from press(driver)
    pressed = shown(driver)
    driver.move(250, 300)
    yield 0.1
    yield from settled(driver)
    assert not np.array_equal(pressed, shown(driver))
    driver.key('ESC')
    yield 0.3
    assert scenes.fingerprint(bpy.data.objects["Panel"]) == before


def test_what_is_kept_is_the_whole_solve_and_what_was_shown_lay_beside_it(driver: window.Window) -> Steps:
    panel(driver, levels=LEVELS)
    bpy.context.scene.reflection_lines.length = 0.5  # with 0, the automatic press, what is shown is what is kept
    start = shown(driver)
    yield from press(driver)
    for x in (380, 300, 500, 250):
        driver.move(x, 300)
        yield 0.1
    yield from settled(driver)
    followed = shown(driver)
    driver.key('RET')
    yield from ended(driver)
    kept, length = shown(driver), dragged_length()
    strength = bpy.context.window_manager.operators[-1].properties.strength
    assert abs(strength - 0.5) < 1e-6
    assert 0.0 < np.abs(followed - kept).max() < 0.03 * np.abs(kept - start).max()
    assert np.array_equal(kept, executed(driver, levels=LEVELS, strength=strength, length=length))


def test_one_undo_takes_the_drag_of_a_cage_back(driver: window.Window) -> Steps:
    panel(driver, levels=LEVELS)
    before = shown(driver)
    yield from press(driver)
    driver.move(300, 300)
    yield 0.3
    driver.key('RET')
    yield from ended(driver)
    after = shown(driver)
    assert not np.array_equal(after, before)
    driver.key('Z', ctrl=True)
    yield from comes_to(driver, before)
    assert [modifier.type for modifier in bpy.data.objects["Panel"].modifiers] == ['SUBSURF']


window.run(test_a_cage_follows_and_escape_leaves_no_bit_changed,
           test_what_is_kept_is_the_whole_solve_and_what_was_shown_lay_beside_it,
           test_one_undo_takes_the_drag_of_a_cage_back)
