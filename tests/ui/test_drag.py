"""Tools under the mouse, in a window: a drag, typed numbers, the ways out of it, and what is left of it afterwards."""
import re
import sys

import blf
import bpy
import numpy as np

import scenes
import window
from dragging import (adjust, applied, dragged_length, ended, executed, moved, panel, press, settled, shown, struck,
                      taken_back, undone_and_redone)
from window import Steps

LEVELS = 3  # of cages: from here on a drag leaves samples out


def test_a_drag_follows_and_escape_leaves_no_bit_changed(driver: window.Window) -> Steps:
    for levels in (0, LEVELS):
        ob = panel(driver, levels=levels)
        before = scenes.fingerprint(ob)
        yield from press(driver)
        pressed = shown(driver)
        yield from moved(driver, 250, 300)
        assert np.abs(pressed - shown(driver)).max() > 1e-5
        yield from window.take_picture(driver, f"drag_{levels}")
        yield from taken_back(driver)
        assert scenes.fingerprint(bpy.data.objects["Panel"]) == before


def kept_smoother() -> object:
    kept, = sys.modules["reflection_lines"].state.press_cache._presses.values()
    return kept.smoother


def running_drag() -> object:
    return sys.modules["reflection_lines"].interactive.drag._running[0]


def test_the_header_tells_the_gain_first_as_the_result_will(driver: window.Window) -> Steps:
    """At 100 cells a side it is measured when the mouse rests."""
    for cells in (16, 100):
        panel(driver, cells=cells)
        yield from press(driver)
        yield from moved(driver, 300, 300)
        header, status = running_drag().texts
        for text, most in ((header, driver.area().width), (status, 0.75 * driver.window.width)):
            assert blf.dimensions(0, text)[0] < most, text
        yield from applied(driver)
        told = bpy.context.view_layer.objects.active.reflection_lines.report.headline()
        degrees = told[told.index(": worst ") + len(": worst "):told.index(", moved")]
        assert header.startswith(f"Lines off by {degrees} at worst")


def test_the_header_of_another_tool_tells_how_far_lines_are_off_the_wanted_ones(driver: window.Window) -> Steps:
    panel(driver)
    settings = bpy.context.scene.reflection_lines
    settings.border, settings.direction.angle = 'free', 0.2  # of a clamped border a few per cent are within reach
    yield from press(driver, "direction")
    header = running_drag().texts[0]
    yield from applied(driver)
    settings.property_unset("border")
    report = bpy.context.view_layer.objects.active.reflection_lines.report
    shown, told = (list(map(float, re.match(r"Off the wanted lines by (\S+)\u00b0 \u2192 (\S+)\u00b0,", text).groups()))
                   for text in (header, report.headline()))
    assert shown[0] == told[0] and abs(shown[1] - told[1]) < 0.03 * told[0] and told[1] < 0.7 * told[0], (shown, told)


def test_a_mouse_that_rests_asks_for_no_solve(driver: window.Window) -> Steps:
    """Blender sends moves to the same place after redraws; solving at each would keep the gain from being measured."""
    panel(driver)
    yield from press(driver)
    yield from moved(driver, 300, 300)
    request = running_drag().request
    for _ in range(3):
        driver.move(300, 300)
        yield 0.1
    assert running_drag().request is request
    driver.move(310, 300)
    yield 0.2
    assert running_drag().request is not request
    yield from taken_back(driver)


def test_what_is_shown_and_kept_is_what_the_operator_makes_without_a_mouse(driver: window.Window) -> Steps:
    for lengths in ({}, {"length": 0.5}):  # the automatic press, which keeps what bends, and all that is finer
        panel(driver)
        bpy.context.scene.reflection_lines.length = lengths.get("length", 0.0)
        yield from press(driver)
        for x in (380, 300, 500, 250):
            driver.move(x, 300)
            yield 0.1
        yield from settled(driver)
        dragged = shown(driver)
        yield from applied(driver)
        kept, properties = shown(driver), bpy.context.window_manager.operators[-1].properties
        assert abs(properties.strength - 0.5) < 1e-6 and abs(properties.length - lengths.get("length", 0.0)) < 1e-6
        assert np.array_equal(kept, executed(driver, strength=properties.strength, **lengths))
        assert lengths or np.array_equal(kept, dragged)


def test_of_a_cage_what_is_kept_is_the_whole_solve_and_what_was_shown_lay_beside_it(driver: window.Window) -> Steps:
    panel(driver, levels=LEVELS)
    bpy.context.scene.reflection_lines.length = 0.5  # with 0, the automatic press, what is shown is what is kept
    start = shown(driver)
    yield from press(driver)
    for x in (380, 300, 500, 250):
        driver.move(x, 300)
        yield 0.1
    yield from settled(driver)
    followed = shown(driver)
    yield from applied(driver)
    kept, length = shown(driver), dragged_length()
    strength = bpy.context.window_manager.operators[-1].properties.strength
    assert abs(strength - 0.5) < 1e-6
    assert 0.0 < np.abs(followed - kept).max() < 0.03 * np.abs(kept - start).max()
    assert np.array_equal(kept, executed(driver, levels=LEVELS, strength=strength, length=length))


def test_a_drag_of_the_strength_finds_the_flaws_once(driver: window.Window) -> Steps:
    panel(driver, cells=60)
    yield from press(driver)
    kept = kept_smoother()
    for x in (300, 350):
        yield from moved(driver, x, 300)
    assert kept_smoother() is kept
    yield from struck(driver, 'ESC')


def test_typed_numbers(driver: window.Window) -> Steps:
    expected = executed(driver, strength=0.25, length=0.5)
    panel(driver)
    yield from press(driver)
    for key in ('PERIOD', 'TWO', 'SEVEN', 'BACK_SPACE', 'FIVE', 'TAB', 'NUMPAD_0', 'NUMPAD_PERIOD', 'NUMPAD_5'):
        driver.key(key)
        yield 0.05
    driver.key('NUMPAD_ENTER')
    yield from ended(driver)
    assert np.array_equal(shown(driver), expected)


def test_a_typed_expression_with_a_unit_is_shown_with_its_value(driver: window.Window) -> Steps:
    expected = executed(driver, strength=1.0, length=0.5)
    panel(driver)
    yield from press(driver)
    driver.key('X')  # begins no number
    for key, text in (('THREE', "3"), ('TAB', ""), ('TWO', "2"), ('EIGHT', "*"), ('TWO', "2"), ('FIVE', "5"),
                      ('C', "c"), ('M', "m")):
        driver.event(key, 'PRESS', **({"unicode": text} if text else {}))
        driver.event(key, 'RELEASE')
        yield 0.05
    yield from settled(driver)
    header = running_drag().texts[0]
    assert "Strength: [3|] = 1.000" in header and "> Length: [2*25cm|] = 50 cm" in header, header
    assert blf.dimensions(0, header)[0] < driver.area().width
    yield from window.take_picture(driver, "typed")
    yield from applied(driver)
    assert np.array_equal(shown(driver), expected)


def test_one_undo_takes_a_drag_back_and_redo_brings_it(driver: window.Window) -> Steps:
    for levels in (0, LEVELS):
        panel(driver, levels=levels)
        before = shown(driver)
        yield from press(driver)
        driver.move(300, 300)
        yield 0.3
        driver.key('LEFTMOUSE')
        yield from ended(driver)
        after = shown(driver)
        assert not np.array_equal(after, before)
        yield from undone_and_redone(driver, before, after)


def test_the_redo_panel_starts_from_the_mesh_before_the_drag(driver: window.Window) -> Steps:
    expected = executed(driver, strength=0.5, length=0.9)
    panel(driver)
    yield from press(driver)
    driver.move(300, 300)
    yield 0.3
    yield from applied(driver)
    yield from adjust(driver, length=0.9, strength=0.5)
    assert np.array_equal(shown(driver), expected)


def test_a_change_of_the_mode_by_a_script_ends_the_drag(driver: window.Window) -> Steps:
    """With keys it cannot be done: those are swallowed."""
    ob = panel(driver, cells=40)
    before = shown(driver)
    yield from press(driver)
    driver.key('Z', ctrl=True)
    driver.key('X')
    yield 0.3
    assert bpy.data.objects["Panel"].mode == 'EDIT'
    driver.move(250, 300)
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
    yield 1.0
    driver.key('ESC')
    yield 0.5
    ob = bpy.data.objects["Panel"]
    assert np.array_equal(scenes.positions(ob), before)


def test_escape_while_the_first_factorization_runs(driver: window.Window) -> Steps:
    ob = panel(driver, cells=100)
    before = scenes.fingerprint(ob)
    driver.move(400, 300)
    yield 0.2
    with driver.override():
        bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, follow_mouse=True)
    yield 0.1
    yield from taken_back(driver)
    assert scenes.fingerprint(bpy.data.objects["Panel"]) == before
    yield from press(driver)
    yield from applied(driver)
    kept = shown(driver)
    panel(driver, cells=100)
    with driver.override():
        scenes.smooth()
    assert np.array_equal(kept, shown(driver))


def test_a_closed_path_ends_where_it_began(driver: window.Window) -> Steps:
    """Hysteresis: to 1e-6 of the panel's size, which is what the mesh's single precision resolves."""
    panel(driver, cells=40)
    yield from press(driver)
    yield from moved(driver, 250, 300)
    first = shown(driver)
    for x in (260, 600, 150, 20, 430, 250):
        driver.move(x, 300 + x // 7)
        yield 0.15
    yield from settled(driver)
    hysteresis = np.abs(shown(driver) - first).max() / 2.0
    print(f"hysteresis {hysteresis:.2e} of the panel's size")
    assert hysteresis < 1e-6
    yield from taken_back(driver)


def test_the_panel_moves_no_more_than_the_mouse_asks(driver: window.Window) -> Steps:
    """Kick: strength is linear in the target, so equal steps of the mouse move the panel by nearly equal steps."""
    panel(driver, cells=40)
    yield from press(driver)
    last, moves = shown(driver), []
    for step in range(1, 8):
        yield from moved(driver, 400 - 30 * step, 300)
        now = shown(driver)
        moves.append(np.abs(now - last).max())
        last = now
    print(f"kick: steps of {min(moves):.2e} to {max(moves):.2e}")
    assert max(moves) < 1.5 * min(moves)
    yield from taken_back(driver)
