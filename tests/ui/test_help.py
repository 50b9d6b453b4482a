"""F1 over a button of the sidebar opens its section of the manual, in a real window."""
import webbrowser
from collections.abc import Generator

import bpy

import scenes
import window

Steps = Generator[float, None, None]
TAB, ROW = 25, 12  # pixels between two places to try, along the tabs and down a tab
SECTIONS = {"view-and-light", "reflines.add_view_camera", "reflines.add_light_direction"}  # a setting and two buttons


def test_f1_in_the_sidebar_opens_sections(driver: window.Window) -> Steps:
    """Blender 3.4 does not tell which tab is where, so the mouse tries the tabs one after the other."""
    opened: list[str] = []
    browser, webbrowser.open = webbrowser.open, lambda url, *_, **__: opened.append(url) or True
    scenes.panel()
    driver.area().spaces.active.show_region_ui = True
    yield 0.5
    sidebar = driver.region('UI')
    try:
        for tab in range(20, sidebar.height, TAB):
            if sections(opened) >= SECTIONS:
                break
            yield from press(driver, sidebar.width - 8, sidebar.height - tab)
            yield from ask_down_the_tab(driver, sidebar)
    finally:
        webbrowser.open = browser
    assert sections(opened) >= SECTIONS, opened[-20:]


def ask_down_the_tab(driver: window.Window, sidebar: bpy.types.Region) -> Steps:
    for y in range(10, sidebar.height - 10, ROW):
        point(driver, sidebar.width // 2, sidebar.height - y)
        yield 0.03
        driver.key('F1')
        yield 0.03


def sections(opened: list[str]) -> set[str]:
    """Of the add-on's own manual."""
    return {url.partition("#")[2] for url in opened if url.startswith("file:")}


def point(driver: window.Window, x: float, y: float) -> None:
    """Moves the mouse to pixels of the sidebar."""
    sidebar = driver.region('UI')
    driver.x, driver.y = sidebar.x + int(x), sidebar.y + int(y)
    driver.event('MOUSEMOVE')


def press(driver: window.Window, x: float, y: float) -> Steps:
    point(driver, x, y)
    yield 0.05
    driver.key('LEFTMOUSE')
    yield 0.1


window.run(test_f1_in_the_sidebar_opens_sections)
