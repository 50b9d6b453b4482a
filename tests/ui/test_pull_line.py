"""Pull Line in a real window: lines are pulled and pinned with the mouse, taken back, applied, and pulled again."""

import bpy
import numpy as np

import scenes
import window
from dragging import applied, panel, settled, shown, struck, take_tool, taken_back, undone_and_redone
from pulling import MIDDLE, UP, begin, missed, move, picture, pull, session, start
from window import Steps

BESIDE = (330, 315)  # where a pull at MIDDLE still bends the lines; 20 pixels further the bend changes its sign


def test_a_line_follows_the_mouse_and_escape_leaves_no_bit_changed(driver: window.Window) -> Steps:
    yield from start(driver)
    before = scenes.fingerprint(bpy.data.objects["Panel"])
    yield from pull(driver, MIDDLE, UP)
    assert len(session().handles) == 1 and missed() < 0.02, session().texts
    assert 1e-4 < session().largest_move < 0.05
    yield from picture("pull_line")
    yield from taken_back(driver)
    assert scenes.fingerprint(bpy.data.objects["Panel"]) == before


def test_the_line_under_the_mouse_is_shown(driver: window.Window) -> Steps:
    yield from start(driver)
    yield from move(driver, *MIDDLE)
    yield 0.2
    curve, = session().marks.curves
    at = session().screen.find_pixels(curve.points)
    mouse = np.array([driver.x, driver.y])
    assert len(at) > 20 and np.linalg.norm(at - mouse, axis=1).min() < 10.0
    assert np.ptp(at[:, 0]) > 150.0 > np.ptp(at[:, 1])  # from side to side
    yield from picture("hover_line")
    yield from move(driver, 10, 20)
    yield 0.2
    assert not session().marks.curves
    yield from taken_back(driver)


def test_enter_applies_in_one_undo_step_what_the_operator_makes(driver: window.Window) -> Steps:
    before = yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    yield from pull(driver, (280, 330), (280, 318))
    yield from applied(driver)
    kept, done = shown(driver), bpy.context.window_manager.operators[-1]
    assert done.bl_idname == "REFLINES_OT_pull_line" and np.abs(kept - before).max() > 1e-4
    handles = done.properties.handles
    yield from undone_and_redone(driver, before, kept)
    panel(driver, cells=24)
    with driver.override():
        assert bpy.ops.reflines.pull_line('EXEC_DEFAULT', True, handles=handles) == {'FINISHED'}
    assert np.array_equal(shown(driver), kept)


def test_undo_steps_from_handle_to_handle(driver: window.Window) -> Steps:
    before = yield from start(driver)
    shapes = [before]
    for first, last in ((MIDDLE, UP), ((280, 330), (280, 318))):
        yield from pull(driver, first, last)
        shapes.append(shown(driver))
    for shift, expected in ((False, 1), (False, 0), (False, 0), (True, 1), (True, 2)):
        yield from struck(driver, 'Z', ctrl=True, shift=shift)
        assert len(session().handles) == expected
        assert np.abs(shown(driver) - shapes[expected]).max() < 3e-6
    yield from taken_back(driver)
    assert np.array_equal(shown(driver), before)


def test_control_goes_back_to_the_old_line_and_shift_is_finer(driver: window.Window) -> Steps:
    before = yield from start(driver)
    yield from pull(driver, MIDDLE, UP, hold=True)
    own = session().handles[0]
    coarse = np.subtract(own.end, own.start)
    yield from move(driver, UP[0], UP[1] + 1, ctrl=True)
    yield from settled(driver)
    assert session().handles[0].end == own.start
    assert np.abs(shown(driver) - before).max() < 3e-6
    driver.event('RIGHTMOUSE', 'PRESS')
    yield from settled(driver)
    assert not session().handles
    driver.event('LEFTMOUSE', 'RELEASE')
    yield from pull(driver, MIDDLE, UP, shift=True)
    own = session().handles[0]
    assert 0.05 < np.linalg.norm(np.subtract(own.end, own.start)) / np.linalg.norm(coarse) < 0.15
    yield from taken_back(driver)


def test_handles_are_taken_again_muted_and_deleted_and_the_wheel_changes_their_radius(driver: window.Window) -> Steps:
    before = yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    first = session().handles[0]
    yield from pull(driver, UP, (330, 302))
    assert len(session().handles) == 1 and session().handles[0].start == first.start != session().handles[0].end
    pulled = shown(driver)
    for expected in (before, pulled):
        yield from struck(driver, 'M')
        assert np.abs(shown(driver) - expected).max() < 3e-6
        dot, = session().marks.dots
        assert dot.hollow == session().handles[0].muted == (expected is before)
        yield from picture("muted_handle" if dot.hollow else "handle")
    driver.event('WHEELUPMOUSE', 'PRESS')
    yield 0.1
    assert abs(session().handles[0].radius / first.radius - 1.1) < 1e-9
    driver.key('F')
    yield 0.1
    yield from move(driver, 330 - 150, 302)
    driver.key('LEFTMOUSE')
    yield 0.1
    assert abs(session().handles[0].radius / first.radius - 0.55) < 1e-6
    yield from struck(driver, 'X')
    assert not session().handles and np.abs(shown(driver) - before).max() < 3e-6
    driver.key('RET')
    yield 0.3
    assert np.array_equal(shown(driver), before)


def test_a_pinned_line_stays_beside_a_pull(driver: window.Window) -> Steps:
    changes = []
    for pinned in (False, True):
        yield from start(driver, cells=48)
        if pinned:
            yield from move(driver, *BESIDE)
            driver.key('LEFTMOUSE', alt=True)
            yield 0.2
            yield from settled(driver)
            assert [each.is_pin for each in session().handles] == [True]
        line = session()
        place = line.screen.find_place(driver.region().x + BESIDE[0], driver.region().y + BESIDE[1])
        yield from pull(driver, MIDDLE, (330, 300))
        theta = [line.surface.read_theta(place, state) for state in (line.surface.start, line.state)]
        changes.append(abs(theta[1] - theta[0]) / (2.0 * np.pi / bpy.context.scene.reflection_lines.stripes.count))
        yield from picture("pin_line")
        yield from taken_back(driver)
    assert changes[1] < 0.02 and changes[1] < 0.2 * changes[0], changes


def test_a_second_session_shows_the_handles_and_goes_on_from_the_shape_before(driver: window.Window) -> Steps:
    before = yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    yield from applied(driver)
    kept = shown(driver)
    yield from begin(driver)
    assert len(session().handles) == 1 and np.abs(shown(driver) - kept).max() < 3e-6
    yield from pull(driver, UP, (330, 304))
    assert len(session().handles) == 1 and np.abs(shown(driver) - kept).max() > 1e-4
    yield from taken_back(driver)
    assert np.array_equal(shown(driver), kept)
    yield from begin(driver)
    yield from move(driver, *UP)
    yield from struck(driver, 'X')
    yield from applied(driver)
    assert np.abs(shown(driver) - before).max() < 1e-7


def test_a_handle_that_is_refused_says_why_and_loses_no_other(driver: window.Window) -> Steps:
    before = yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    yield from pull(driver, (280, 330), (280, 330))
    good = shown(driver)
    session().change_radius(1e-4)
    yield from settled(driver)
    for key in ('RET', 'NUMPAD_ENTER'):
        yield from struck(driver, key)
        assert len(session().handles) == 2 and "take a larger one" in session().texts[0], session().texts
    assert np.array_equal(shown(driver), good)
    for _ in range(2):
        yield from struck(driver, 'Z', ctrl=True)
    assert not session().handles and np.abs(shown(driver) - before).max() < 3e-6
    yield from taken_back(driver)
    assert np.array_equal(shown(driver), before)


def test_a_cage_follows(driver: window.Window) -> Steps:
    before = yield from start(driver, cells=16, levels=2)
    yield from pull(driver, MIDDLE, UP)
    assert missed() < 0.05, session().texts
    yield from applied(driver)
    assert np.abs(shown(driver) - before).max() > 1e-4


def test_a_large_panel_follows_without_a_solve(driver: window.Window) -> Steps:
    """By smooth motions of the heights within the radius; what Enter keeps is the solve, which is near it."""
    before = yield from start(driver, cells=80)
    yield from pull(driver, MIDDLE, UP)
    assert missed() < 0.01, session().texts
    followed = shown(driver) - before
    assert np.abs(followed).max() > 1e-4
    yield from applied(driver)
    kept = shown(driver) - before
    assert 0.0 < np.abs(kept - followed).max() < 0.15 * np.abs(kept).max()


def test_a_press_with_the_tool_of_the_toolbar_pulls_at_once(driver: window.Window) -> Steps:
    panel(driver, cells=24)
    before = shown(driver)
    yield from take_tool(driver, "reflection_lines.pull_line", MIDDLE)
    yield from pull(driver, MIDDLE, UP)
    assert len(session().handles) == 1 and np.abs(shown(driver) - before).max() > 1e-4
    yield from picture("tool")
    yield from taken_back(driver)
    assert np.array_equal(shown(driver), before)
    with driver.override():
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
