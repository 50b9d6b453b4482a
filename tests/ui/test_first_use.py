"""README's first use with the mouse, and the tools by F3's search, in a real window."""

import bpy
import numpy as np

import newcomer
import window
from dragging import ended, executed, panel, shown
from window import Steps


def search(driver: window.Window, text: str) -> Steps:
    """Types a text into F3's search and takes the first it finds."""
    driver.move(300, 300)
    yield 0.1
    driver.key('F3')
    yield 0.5
    for letter in text:
        driver.window.event_simulate(type=letter.upper() if letter != " " else 'SPACE', value='PRESS', x=driver.x,
                                     y=driver.y, unicode=letter)
        driver.event(letter.upper() if letter != " " else 'SPACE', 'RELEASE')
        yield 0.05
    yield 0.3
    yield from window.take_picture(driver, f"search_{text[:5]}")
    driver.key('RET')
    yield 0.5


def test_search_finds_the_tools_and_solves_at_once(driver: window.Window) -> Steps:
    expected = executed(driver)
    panel(driver)
    yield from search(driver, "reflection smooth")
    yield from ended(driver)
    assert np.array_equal(shown(driver), expected)


def test_search_finds_stripes_by_the_trades_words(driver: window.Window) -> Steps:
    panel(driver)
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.show = False
    yield from search(driver, "zebra")
    assert stripes.show
    for text, mode in (("isophote", 'ISOPHOTE'), ("highlight lines", 'HIGHLIGHT')):
        yield from search(driver, text)
        assert stripes.mode == mode, (text, stripes.mode)


def noted(name: str) -> Steps:
    """Takes a picture of a step of the first use, where one is asked for."""
    yield from window.take_picture(window.Window(), f"first_use_{name}")


def test_the_newcomer_smooths_a_sample(_driver: window.Window) -> Steps:
    yield from newcomer.use_sample(noted)


def test_from_an_imported_body_to_a_healed_bonnet_in_six_clicks_and_drags(_driver: window.Window) -> Steps:
    presses = yield from newcomer.use_own_model(noted)
    assert presses <= 6, presses
