"""What tests of sessions with handles share: their begin, moves of the mouse, and what they show."""
import sys
from collections.abc import Generator

import bpy
import numpy as np

import window
from dragging import panel, settled, shown
from window import Steps

MIDDLE, UP = (330, 290), (330, 312)  # pixels; the lines run from left to right


def session() -> object:
    return sys.modules["reflection_lines"].interactive.drag._running[0]


def begin(driver: window.Window) -> Steps:
    driver.move(10, 20)
    yield 0.1
    with driver.override():
        assert bpy.ops.reflines.pull_line('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}
    yield 0.2
    yield from settled(driver)


def start(driver: window.Window, cells: int = 24, levels: int = 0) -> Generator[float, None, np.ndarray]:
    """A session on a fresh panel; returns its positions. One that a failed test left is ended."""
    if sys.modules["reflection_lines"].interactive.drag._running:
        driver.key('ESC')
        yield 0.5
    panel(driver, cells=cells, levels=levels)
    before = shown(driver)
    yield from begin(driver)
    return before


def move(driver: window.Window, x: float, y: float, **modifiers: bool) -> Steps:
    driver.x, driver.y = driver.region().x + int(x), driver.region().y + int(y)
    driver.event('MOUSEMOVE', **modifiers)
    yield 0.1


def pull(driver: window.Window, first: tuple[int, int], last: tuple[int, int], *, hold: bool = False,
         **modifiers: bool) -> Steps:
    yield from move(driver, *first)
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.1
    for share in (0.3, 0.7, 1.0):
        yield from move(driver, *(a + share * (b - a) for a, b in zip(first, last, strict=True)), **modifiers)
    if not hold:
        driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.1
    yield from settled(driver)


def draw(driver: window.Window, places: tuple[tuple[int, int], ...]) -> Steps:
    """Draws a stroke through places, pixels of the view."""
    yield from move(driver, *places[0])
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.1
    for place in places[1:]:
        yield from move(driver, *place)
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.1
    yield from settled(driver)


def picture(name: str) -> Steps:
    return window.take_picture(window.Window(), name)


def missed() -> float:
    """How far the line of the handle in hand passes beside it, as a share of the spacing of the lines."""
    return float(session().texts[0].split("Line ")[1].split("%")[0]) / 100.0
