"""A script starts a second tool while one is dragged: the upper one hears the mouse, and the lower one goes on below.
Whatever way both end, what was left has changed no bit.
"""
import sys
from collections.abc import Generator

import bpy
import numpy as np

import installation
import window
from dragging import is_running, panel, press, settled, shown, struck
from pulling import MIDDLE, UP, begin, pull
from window import Steps


def press_half(driver: window.Window) -> Steps:
    """Begins a drag of Smooth with the strength 0.5, which is typed: the mouse does not change it."""
    yield from press(driver)
    for key in ('PERIOD', 'FIVE'):
        yield from struck(driver, key)


def start_both(driver: window.Window) -> Generator[float, None, np.ndarray]:
    """Pull Line over a drag of Smooth, each of which has moved the panel; returns the positions before both."""
    panel(driver, cells=24)
    before = shown(driver)
    yield from press_half(driver)
    smoothed = shown(driver)
    yield from begin(driver)
    assert len(sys.modules["reflection_lines"].interactive.drag._running) == 2
    yield from pull(driver, MIDDLE, UP)
    yield from settled(driver)
    assert not np.array_equal(smoothed, before) and not np.array_equal(shown(driver), smoothed)
    return before


def left(driver: window.Window, times: int) -> Steps:
    for _ in range(times):
        driver.key('ESC')
        yield 0.5
        yield from settled(driver)


def test_both_are_left_one_after_the_other(driver: window.Window) -> Steps:
    before = yield from start_both(driver)
    yield from left(driver, 1)
    assert is_running() and not np.array_equal(shown(driver), before)
    yield from left(driver, 1)
    assert not is_running() and np.array_equal(shown(driver), before)


def test_disabling_the_add_on_takes_both_back(driver: window.Window) -> Steps:
    before = yield from start_both(driver)
    with driver.override():
        bpy.ops.preferences.addon_disable(module=installation.NAME)
    yield 0.5
    driver.move(200, 300)
    driver.key('RET')
    yield 0.3
    after = shown(driver)
    with driver.override():
        installation.install()
    yield 0.3
    assert np.array_equal(after, before)


def keep(driver: window.Window) -> Steps:
    driver.key('RET')
    yield 0.5
    yield from settled(driver)


def test_the_lower_one_is_kept_after_the_upper_one_was_left(driver: window.Window) -> Steps:
    """What is kept is what the lower one alone would have made: nothing of the pull is left in it."""
    yield from start_both(driver)
    yield from left(driver, 1)
    yield from keep(driver)
    assert not is_running()
    kept = shown(driver)
    panel(driver, cells=24)
    yield from press_half(driver)
    yield from keep(driver)
    assert np.abs(kept - shown(driver)).max() < 1e-6
