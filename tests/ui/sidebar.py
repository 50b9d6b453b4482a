"""The add-on's tab of the sidebar, and its buttons, as a hand finds them."""
from collections.abc import Generator

import bpy
import window
from window import Steps

TAB, ROW = 25, 9   # pixels between two places to try: along the tabs, and down the tab
TAB_STRIP = 8      # pixels from the sidebar's right edge to the middle of its tabs


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


def open_tab(driver: window.Window) -> Steps:
    """Blender 3.4 does not tell which tab is where, so the mouse tries one after the other until a panel is drawn."""
    drawn: list[bool] = []
    driver.area().spaces.active.show_region_ui = True
    panel, note = bpy.types.VIEW3D_PT_reflines_smooth, lambda *_: drawn.append(True)
    panel.append(note)
    yield 0.3
    sidebar = driver.region('UI')
    for tab in range(20, sidebar.height, TAB):
        driver.redraw()
        yield 0.1
        if drawn:
            break
        yield from press(driver, sidebar.width - TAB_STRIP, sidebar.height - tab)
    panel.remove(note)
    assert drawn, "no tab of the sidebar has the add-on's panels"


def shows_tab(driver: window.Window) -> Generator[float, None, bool]:
    """Returns whether the add-on's tab is the one in front of the open sidebar."""
    drawn: list[bool] = []
    panel, note = bpy.types.VIEW3D_PT_reflines_smooth, lambda *_: drawn.append(True)
    panel.append(note)
    driver.redraw()
    yield 0.5
    panel.remove(note)
    return bool(drawn)


def read_button(driver: window.Window) -> Generator[float, None, str]:
    """Returns the command of the button under the mouse, which Ctrl C copies; empty where there is none."""
    manager = bpy.context.window_manager
    manager.clipboard = " "
    driver.key('C', ctrl=True)
    yield 0.02
    return manager.clipboard.strip()


def find_button(driver: window.Window, command: str) -> Generator[float, None, tuple[int, int]]:
    """Returns where a button is, in pixels of the sidebar, turning the wheel as far as needed."""
    sidebar = driver.region('UI')
    for _ in range(40):
        for y in range(sidebar.height - 30, 10, -ROW):
            for x in (sidebar.width // 2, sidebar.width - 40):
                point(driver, x, y)
                yield 0.02
                if (yield from read_button(driver)) == command:
                    return x, y
        for _ in range(5):
            driver.event('WHEELDOWNMOUSE', 'PRESS')
        yield 0.1
    raise AssertionError(f"the sidebar has no button {command}")
