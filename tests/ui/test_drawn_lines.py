"""Lines along curves in a real window: drawn, straightened, parallel to the border, kept in the file; typed radii."""
import os
import tempfile

import bpy
import numpy as np

import window
from dragging import applied, settled, shown, struck, taken_back, undone_and_redone
from pulling import MIDDLE, UP, Steps, begin, draw, missed, move, picture, pull, session, start

STROKE = ((270, 290), (290, 294), (310, 299), (330, 302), (350, 299), (370, 294), (390, 290))  # pixels


def shown_line() -> np.ndarray:
    """The line of the last handle, in pixels of the window: #P x 2."""
    return session().screen.find_pixels(session().tracing.trace_handle(len(session().handles) - 1)[-1].points)


def places() -> list[tuple]:
    """Where the handles of the session are, to the last bit."""
    return [(each.start, each.end, each.curve) for each in session().handles]


def bend(line: np.ndarray) -> float:
    """How far a line strays from the straight way between its ends, pixels; without its outer tenths."""
    tenth = len(line) // 10
    inner = line[tenth:len(line) - tenth]
    way = (inner[-1] - inner[0]) / np.linalg.norm(inner[-1] - inner[0])
    return float(np.abs((inner - inner[0]) @ [-way[1], way[0]]).max())


def pixel_of(driver: window.Window, place: tuple[float, float]) -> np.ndarray:
    """Where a place of the panel (x, y) is seen, in pixels of the view: views differ from Blender to Blender."""
    return session().screen.find_pixels(np.array([[*place, 0.0]]))[0] - [driver.region().x, driver.region().y]


def test_a_stroke_becomes_the_course_of_the_line_at_its_start(driver: window.Window) -> Steps:
    before = yield from start(driver, cells=48)
    driver.key('D')
    yield from draw(driver, STROKE)
    own, = session().handles
    assert len(own.curve) == 5 and own.curve[2] == own.end and missed() < 0.05, session().texts
    line, corner = shown_line(), [driver.region().x, driver.region().y]
    for place in STROKE:
        assert np.linalg.norm(line - np.add(place, corner), axis=1).min() < 4.0
    yield from picture("draw_highlight")
    yield from applied(driver)
    after = shown(driver)
    assert np.abs(after - before).max() > 1e-4
    yield from undone_and_redone(driver, before, after)


def test_a_dot_of_the_curve_is_moved_and_moved_back(driver: window.Window) -> Steps:
    yield from start(driver, cells=48)
    driver.key('D')
    yield from draw(driver, STROKE)
    drawn = session().handles[0]
    at = session().screen.find_pixels(session().find_dot(drawn.curve[2])[None])[0] - [driver.region().x,
                                                                                     driver.region().y]
    yield from pull(driver, tuple(at), (at[0], at[1] - 6))
    moved = session().handles[0]
    assert len(session().handles) == 1
    assert [a == b for a, b in zip(drawn.curve, moved.curve, strict=True)].count(False) == 1
    yield from struck(driver, 'Z', ctrl=True)
    assert session().handles == (drawn,)
    yield from taken_back(driver)


def test_a_short_stroke_draws_nothing_and_d_pulls_again(driver: window.Window) -> Steps:
    yield from start(driver)
    driver.key('D')
    yield from draw(driver, (MIDDLE, (332, 290)))
    assert not session().handles and not session().history
    driver.key('D')
    yield from pull(driver, MIDDLE, UP)
    assert len(session().handles) == 1 and not session().handles[0].curve
    yield from taken_back(driver)


def test_the_line_under_the_mouse_becomes_straight(driver: window.Window) -> Steps:
    before = yield from start(driver, cells=48)
    yield from move(driver, *pixel_of(driver, (0.0, 0.1)))
    yield 0.2
    curve, = session().marks.curves
    crooked = bend(session().screen.find_pixels(curve.points))
    yield from struck(driver, 'S')
    own, = session().handles
    dots = session().screen.find_pixels(np.array([session().find_dot(dot) for dot in own.dots]))
    assert crooked > 4.0 and bend(dots) < 1.0
    assert bend(shown_line()) < 0.3 * crooked, (bend(shown_line()), crooked, session().texts)
    yield from picture("straighten")
    assert len(session().handles) == 1 and np.abs(shown(driver) - before).max() > 1e-5
    yield from taken_back(driver)
    assert np.array_equal(shown(driver), before)


def test_the_line_under_the_mouse_follows_the_border(driver: window.Window) -> Steps:
    """The one above it, which is straight, but where the clamped border beside its ends holds it: from there it comes
    gradually."""
    yield from start(driver, cells=48)
    yield from move(driver, 330, 315)
    yield from struck(driver, 'E')
    own, = session().handles
    dots = session().screen.find_pixels(np.array([session().find_dot(dot) for dot in own.dots]))
    assert len(dots) == 9 and np.ptp(dots[2:-2, 1]) < 1.0 and np.ptp(dots[2:-2, 0]) > 50.0, dots
    line = shown_line()
    assert max(np.linalg.norm(line - dot, axis=1).min() for dot in dots) < 3.0, (line, dots)
    assert missed() < 0.02, session().texts
    yield from picture("follow_edge")
    yield from taken_back(driver)


def test_a_radius_is_typed(driver: window.Window) -> Steps:
    yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    for key in ('ZERO', 'PERIOD', 'THREE', 'FIVE'):
        driver.key(key)
        yield 0.1
    assert abs(session().handles[0].radius - 0.35) < 1e-6 and "[0.35|]" in session().texts[0], session().texts
    driver.key('BACK_SPACE')
    yield 0.1
    assert abs(session().handles[0].radius - 0.3) < 1e-6
    yield from struck(driver, 'RET')
    assert session().typed == "" and len(session().handles) == 1
    yield from struck(driver, 'Z', ctrl=True)
    assert session().handles[0].radius != 0.3
    yield from taken_back(driver)


def test_escape_takes_a_typed_radius_back_and_nothing_else(driver: window.Window) -> Steps:
    yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    handles = session().handles
    for key in ('ZERO', 'PERIOD', 'THREE'):
        driver.key(key)
        yield 0.1
    assert session().handles != handles
    yield from struck(driver, 'ESC')
    assert session().handles == handles and session().typed == ""
    yield from taken_back(driver)


def test_the_right_button_takes_a_stroke_back_and_no_other_handle(driver: window.Window) -> Steps:
    yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    handles = session().handles
    driver.key('D')
    yield from move(driver, *STROKE[0])
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.1
    for place in STROKE[1:5]:
        yield from move(driver, *place)
    assert session().stroke
    driver.event('RIGHTMOUSE', 'PRESS')
    yield 0.1
    for button in ('RIGHTMOUSE', 'LEFTMOUSE'):
        driver.event(button, 'RELEASE')
        yield 0.1
    yield from settled(driver)
    assert session().handles == handles and not session().stroke
    yield from taken_back(driver)


def test_handles_come_back_with_the_file(driver: window.Window) -> Steps:
    """Saved, opened, and taken again: the session goes on with the shape before them."""
    before = yield from start(driver, cells=48)
    yield from pull(driver, MIDDLE, UP)
    driver.key('D')
    yield from draw(driver, tuple((x, y - 60) for x, y in STROKE))
    handles = places()
    yield from applied(driver)
    kept = shown(driver)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "handles.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
    yield 1.0
    driver = window.Window()
    assert np.array_equal(shown(driver), kept)
    yield from begin(driver)
    assert places() == handles and np.abs(shown(driver) - kept).max() < 3e-6
    for _ in handles:
        yield from struck(driver, 'X')
    yield from applied(driver)
    assert np.abs(shown(driver) - before).max() < 1e-7
