"""Fair Brush in a real window: strokes smooth what they pass over, each is one undo step, and Escape takes it back."""
import sys
from collections.abc import Generator

import bpy
import numpy as np

import scenes
import window
from dragging import panel, shown, take_tool, taken_back, undone_and_redone
from window import Steps

CELLS = 48
LEFT, RIGHT = (250, 290), (390, 290)  # pixels


def settings() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines.brush


def begin(driver: window.Window, **panel_settings: int) -> Generator[float, None, np.ndarray]:
    """A fresh panel with the tool at hand; returns its positions."""
    panel(driver, **{"cells": CELLS, **panel_settings})
    settings().size, settings().strength = 50, 0.8
    yield from take_tool(driver, "reflection_lines.fair_brush", LEFT)
    return shown(driver)


def end(driver: window.Window) -> None:
    with driver.override():
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")


def paint(driver: window.Window, first: tuple[int, int], last: tuple[int, int], *, hold: bool = False,
          **modifiers: bool) -> Steps:
    driver.move(*first)
    yield 0.1
    driver.event('LEFTMOUSE', 'PRESS', **modifiers)
    yield 0.2
    for share in (0.25, 0.5, 0.75, 1.0):
        driver.x, driver.y = (base + int(a + share * (b - a)) for base, a, b in
                              zip((driver.region().x, driver.region().y), first, last, strict=True))
        driver.event('MOUSEMOVE', **modifiers)
        yield 0.2
    if not hold:
        driver.event('LEFTMOUSE', 'RELEASE')
        yield 0.3


def test_a_stroke_smooths_what_it_passes_over_in_one_undo_step(driver: window.Window) -> Steps:
    before = yield from begin(driver)
    yield from window.take_picture(driver, "fair_brush_before")
    yield from paint(driver, LEFT, RIGHT, hold=True)
    yield from window.take_picture(driver, "fair_brush")
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.3
    after = shown(driver)
    moved = np.abs(after - before).max(axis=1) > 0.0
    assert 50 < moved.sum() < 0.5 * len(moved) and np.ptp(before[moved, 0]) > 1.5 * np.ptp(before[moved, 1])
    assert bpy.context.window_manager.operators[-1].bl_idname == "REFLINES_OT_fair_brush"
    yield from undone_and_redone(driver, before, after)
    end(driver)


def test_a_stroke_is_a_result(driver: window.Window) -> Steps:
    """It is told, compared with before, and undone, as a press is."""
    state = sys.modules["reflection_lines"].state
    for levels in (0, 2):
        before = yield from begin(driver, levels=levels, cells=24 if levels else CELLS)
        ob = bpy.data.objects["Panel"]
        bpy.context.scene.reflection_lines.stripes.before = True
        yield from paint(driver, LEFT, RIGHT)
        after, report = shown(driver), ob.reflection_lines.report
        assert report.headline().startswith("Brushed, lines there off by "), report.headline()
        assert report.score_after < 0.8 * report.score_before
        assert abs(report.largest_move - np.abs(after - before)[:, 2].max()) < 1e-6
        last = state.solve_history.find_last_solve(ob.name_full)
        assert np.allclose(last.patch.local, before[last.patch.index], atol=1e-7)
        driver.redraw()
        yield 0.4
        assert state.compared.find_divider(driver.region()) is not None
        yield from window.take_picture(driver, f"brush_compared_{levels}")
        x = state.compared.find_divider(driver.region())
        yield from paint(driver, (x, 290), (x + 30, 290))  # on the line, which the knob alone drags now
        assert state.compared.find_divider(driver.region()) == x and not np.array_equal(shown(driver), after)
        yield from paint(driver, (x, 72), (x + 30, 72))
        assert abs(state.compared.find_divider(driver.region()) - x - 30) <= 1.5
        assert not bpy.ops.reflines.resolve.poll()
        with driver.override():
            bpy.ops.ed.undo()
        yield 0.4
        assert state.solve_history.is_undone(bpy.data.objects["Panel"])
        assert state.compared.find_divider(driver.region()) is None
        bpy.context.scene.reflection_lines.stripes.before = False
        end(driver)


def test_strokes_add_up_and_shift_paints_with_less(driver: window.Window) -> Steps:
    before = yield from begin(driver)
    yield from paint(driver, LEFT, RIGHT, shift=True)
    weak = shown(driver)
    yield from paint(driver, LEFT, RIGHT)
    both = shown(driver)
    least, most = (np.abs(each - before).max() for each in (weak, both))
    assert 0.0 < least < 0.6 * most, (least, most)
    yield from undone_and_redone(driver, weak, both)
    end(driver)


def escape_restores_every_bit(driver: window.Window) -> Steps:
    before = scenes.fingerprint(bpy.data.objects["Panel"])
    yield from paint(driver, LEFT, RIGHT, hold=True)
    assert scenes.fingerprint(bpy.data.objects["Panel"]) != before
    yield from taken_back(driver)
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.2
    assert scenes.fingerprint(bpy.data.objects["Panel"]) == before
    end(driver)


def test_escape_restores_every_bit(driver: window.Window) -> Steps:
    yield from begin(driver)
    yield from escape_restores_every_bit(driver)


def test_f_changes_the_size(driver: window.Window) -> Steps:
    yield from begin(driver)
    driver.key('F')
    yield 0.3
    driver.x += 60
    driver.event('MOUSEMOVE')
    yield 0.2
    driver.key('LEFTMOUSE')
    yield 0.3
    assert settings().size > 80, settings().size
    end(driver)


def test_a_stroke_beside_the_panel_changes_nothing(driver: window.Window) -> Steps:
    before = yield from begin(driver)
    yield from paint(driver, (10, 20), (40, 20))
    assert np.array_equal(shown(driver), before)
    end(driver)


def test_a_stroke_on_a_cage_moves_it_and_escape_restores_every_bit(driver: window.Window) -> Steps:
    before = yield from begin(driver, cells=24, levels=2)
    yield from paint(driver, LEFT, RIGHT, hold=True)
    yield from window.take_picture(driver, "fair_brush_cage")
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.3
    after = shown(driver)
    moved = np.abs(after - before).max(axis=1) > 0.0
    assert 10 < moved.sum() < 0.5 * len(moved) and not (after - before)[:, :2].any()
    yield from undone_and_redone(driver, before, after)
    yield from escape_restores_every_bit(driver)


def test_the_button_takes_the_tool(driver: window.Window) -> Steps:
    panel(driver)
    with driver.override():
        assert bpy.ops.reflines.fair_brush('INVOKE_DEFAULT', True) == {'CANCELLED'}
        yield 0.3
        tool = bpy.context.workspace.tools.from_space_view3d_mode('EDIT_MESH')
    assert tool.idname == "reflection_lines.fair_brush"
    end(driver)
