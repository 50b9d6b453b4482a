"""Draw Highlight with the nearest line in a real window: the stroke takes the line that has to change least."""
import numpy as np

import window
from dragging import taken_back
from pulling import Steps, draw, missed, picture, session, start

STROKE = [(270 + 10 * k, 280 + 2 * k) for k in range(13)]  # pixels; it crosses lines, which run from left to right


def draw_stroke(driver: window.Window, *keys: str) -> Steps:
    """Begins a session, presses the keys, and draws the stroke."""
    yield from start(driver, cells=48)
    for key in keys:
        driver.key(key)
        yield 0.1
    yield from draw(driver, STROKE)


def theta_along(state: object) -> np.ndarray:
    """Theta of a shape along the stroke."""
    view = window.Window().region()
    places = [session().screen.find_place(view.x + x, view.y + y) for x, y in STROKE]
    return np.array([session().surface.read_theta(place, state) for place in places])


def theta_of_handle() -> float:
    own, = session().handles
    return session().surface.read_theta(session().find_place(own.start), session().surface.start)


def test_the_nearest_line_changes_those_below_the_stroke_less_than_the_one_at_its_start(driver: window.Window) -> Steps:
    changes = []
    for keys in (('D',), ('D', 'N')):
        yield from draw_stroke(driver, *keys)
        theta, value = theta_along(session().surface.start), theta_of_handle()
        wanted = theta[0] if len(keys) == 1 else theta.mean()
        assert abs(value - wanted) < 0.03 * np.ptp(theta), (value, theta)
        assert missed() < 0.05, session().texts
        changes.append(float(np.sqrt(np.mean((theta_along(session().state) - theta)**2))))
        yield from picture("draw_nearest" if len(keys) == 2 else "draw_start")
        yield from taken_back(driver)
    assert 1e-3 < changes[1] < 0.9 * changes[0], changes


def test_the_status_bar_says_which_line_is_taken(driver: window.Window) -> Steps:
    yield from draw_stroke(driver, 'D')
    assert session().texts[1].startswith("Drag: draw the line at its start   N: the nearest line"), session().texts
    driver.key('N')
    yield 0.2
    assert session().texts[1].startswith("Drag: draw the nearest line   N: the line at its start"), session().texts
    yield from taken_back(driver)


def test_n_does_nothing_while_lines_are_pulled(driver: window.Window) -> Steps:
    yield from start(driver)
    driver.key('N')
    yield 0.1
    assert not session().nearest and session().texts[1].startswith("Drag: pull a line"), session().texts
    yield from taken_back(driver)
