"""Kept handles in a real window: seen while a tool for lines is active, and dragged without a session before."""
import sys
from collections.abc import Generator

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

import picture as pixels
import scenes
import window
from dragging import applied, is_running, settled, shown, take_tool, taken_back
from pulling import MIDDLE, UP, Steps, begin, draw, move, picture, pull, session, start

STROKE = ((270, 290), (290, 294), (310, 299), (330, 302), (350, 299), (370, 294), (390, 290))  # pixels
PULL, DRAW, SELECT = "reflection_lines.pull_line", "reflection_lines.draw_highlight", "builtin.select_box"


def kept() -> tuple:
    ob = bpy.context.view_layer.objects.active
    return ob.reflection_lines.handles.read(ob.data)


def place_of(driver: window.Window, dot: tuple[float, float, float]) -> np.ndarray:
    """Where a dot of the panel is seen, in pixels of the view."""
    return np.array(location_3d_to_region_2d(driver.region(), driver.region_3d(), dot))


def count_pixels(driver: window.Window, place: np.ndarray, color: tuple) -> Generator[float, None, int]:
    """The pixels of a color within 10 pixels of a place; stripes and other overlays are off meanwhile."""
    space = driver.area().spaces.active
    bpy.context.scene.reflection_lines.stripes.show = space.overlay.show_overlays = False
    seen = yield from pixels.look(driver, 'POST_PIXEL')
    bpy.context.scene.reflection_lines.stripes.show = space.overlay.show_overlays = True
    x, y = place.astype(int)
    near = seen.astype(int)[y - 10:y + 11, x - 10:x + 11, :3]
    return int((np.abs(near - 255.0 * np.array(color[:3])) < 45.0).all(axis=2).sum())


def colors() -> object:
    return sys.modules["reflection_lines"].overlay.handle_marks


def pulled_and_applied(driver: window.Window) -> Generator[float, None, np.ndarray]:
    """A panel with one kept handle; returns the shape before it."""
    before = yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    yield from applied(driver)
    return before


def test_a_kept_handle_is_seen_while_a_tool_for_lines_is_active(driver: window.Window) -> Steps:
    yield from pulled_and_applied(driver)
    own, = kept()
    for name, is_seen in ((SELECT, False), (PULL, True), (DRAW, True), (SELECT, False)):
        yield from take_tool(driver, name)
        count = yield from count_pixels(driver, place_of(driver, own.end), colors().LINE_COLOR)
        assert (count > 60) == is_seen and (count == 0) == (not is_seen), (name, count)
    yield from take_tool(driver, PULL)
    yield from picture("kept_handle")
    with driver.override():
        assert bpy.ops.reflines.delete_handles() == {'FINISHED'}
    assert not (yield from count_pixels(driver, place_of(driver, own.end), colors().LINE_COLOR))


def test_a_kept_handle_is_dragged_by_its_gizmo(driver: window.Window) -> Steps:
    before = yield from pulled_and_applied(driver)
    first, = kept()
    after = shown(driver)
    yield from take_tool(driver, PULL)
    at = place_of(driver, first.end)
    yield from move(driver, *(at + (0, 30)))
    yield from move(driver, *(at + (3, 2)))  # not quite its middle
    yield 0.3
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.3
    assert is_running() and tuple(session().tool.taken) == (0, 0)
    for step in (4, 8, 12):
        yield from move(driver, *(at - (0, step)))
    yield from settled(driver)
    yield from picture("dragged_handle")
    held, = session().handles
    assert session().held == 0 and held.start == first.start and held.end != first.end
    assert np.abs(place_of(driver, held.end) - (at - (0, 12))).max() < 1.5
    driver.event('LEFTMOUSE', 'RELEASE')
    yield from settled(driver)
    yield from applied(driver)
    assert kept() == (held,)
    assert 1e-4 < np.abs(shown(driver) - before).max() < np.abs(after - before).max()
    yield from take_tool(driver, SELECT)


def test_escape_after_the_drag_of_a_gizmo_leaves_no_bit_changed(driver: window.Window) -> Steps:
    yield from pulled_and_applied(driver)
    first, = kept()
    before = scenes.fingerprint(bpy.context.view_layer.objects.active)
    yield from take_tool(driver, PULL)
    at = place_of(driver, first.end)
    yield from pull(driver, tuple(at), tuple(at - (0, 12)))
    assert session().tool.taken[0] == 0 and len(session().handles) == 1
    yield from taken_back(driver)
    assert scenes.fingerprint(bpy.context.view_layer.objects.active) == before and kept() == (first,)
    yield from take_tool(driver, SELECT)


def test_each_dot_of_a_kept_curve_is_taken_and_the_session_goes_on_to_draw(driver: window.Window) -> Steps:
    yield from start(driver, cells=48)
    driver.key('D')
    yield from draw(driver, STROKE)
    yield from applied(driver)
    drawn, = kept()
    yield from take_tool(driver, DRAW)
    at = place_of(driver, drawn.curve[3])
    yield from pull(driver, tuple(at), tuple(at - (0, 6)))
    moved, = session().handles
    assert tuple(session().tool.taken) == (0, 3) and session().draws
    assert [a == b for a, b in zip(drawn.curve, moved.curve, strict=True)] == [True, True, True, False, True]
    yield from taken_back(driver)
    yield from take_tool(driver, SELECT)


def test_handles_that_cannot_be_read_have_no_gizmos(driver: window.Window) -> Steps:
    yield from pulled_and_applied(driver)
    own, = kept()
    yield from take_tool(driver, PULL)
    stored = bpy.context.view_layer.objects.active.reflection_lines.handles
    stored.text = "[{}]"
    assert not (yield from count_pixels(driver, place_of(driver, own.end), colors().LINE_COLOR))
    stored.text = ""
    yield from begin(driver)
    assert not session().handles
    yield from taken_back(driver)
    yield from take_tool(driver, SELECT)
