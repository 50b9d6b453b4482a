"""README's first use with the mouse, and the tools by F3's search, in a real window."""
import os
from collections.abc import Generator
from pathlib import Path

import bpy
import numpy as np

import sidebar
import window
from dragging import ended, executed, panel, shown

Steps = Generator[float, None, None]
SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "hood.blend"


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
    if "REFLINES_PICTURES" in os.environ:
        bpy.ops.screen.screenshot(filepath=os.path.join(os.environ["REFLINES_PICTURES"], f"search_{text[:5]}.png"))
        yield 0.3
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
    for text, mode in (("isophote", 'ISOPHOTE'), ("highlight", 'HIGHLIGHT'), ("reflection lines", 'REFLECTION')):
        yield from search(driver, text)
        print(text, stripes.mode, flush=True)
        if text != "reflection lines":
            assert stripes.mode == mode, (text, stripes.mode)


def test_a_sample_opens_with_the_sidebar_and_the_button_smooths_it(driver: window.Window) -> Steps:
    """No key N: that would close the sidebar."""
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLE), load_ui=True)
    yield 1.5
    driver = window.Window()
    assert driver.area().spaces.active.show_region_ui
    yield from sidebar.open_tab(driver)
    before = shown(driver)
    x, y = yield from sidebar.find_button(driver, "bpy.ops.reflines.smooth()")
    yield from sidebar.press(driver, x, y)
    yield from ended(driver)
    report = bpy.context.view_layer.objects.active.reflection_lines.report
    assert np.abs(shown(driver) - before).max() > 1e-4
    assert report.headline().startswith("Lines ") and " x smoother, moved at most 1.7" in report.headline(), \
        report.headline()
    if "REFLINES_PICTURES" in os.environ:
        bpy.ops.screen.screenshot(filepath=os.path.join(os.environ["REFLINES_PICTURES"], "first_use.png"))
        yield 0.3


window.run(test_search_finds_the_tools_and_solves_at_once, test_search_finds_stripes_by_the_trades_words,
           test_a_sample_opens_with_the_sidebar_and_the_button_smooths_it)
