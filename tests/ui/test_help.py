"""F1 over a button of the sidebar opens its section of the manual, in a real window."""
import webbrowser

import scenes
import sidebar
import window

ROW = 12  # pixels between two places to try down a tab


def test_f1_in_the_sidebar_opens_sections(driver: window.Window) -> sidebar.Steps:
    opened: list[str] = []
    browser, webbrowser.open = webbrowser.open, lambda url, *_, **__: opened.append(url) or True
    scenes.panel()
    try:
        yield from sidebar.open_tab(driver)
        yield from ask_down_the_tab(driver, opened, "reflines.set_up")
        scenes.look_from_above()
        driver.redraw()
        yield 0.3
        yield from ask_down_the_tab(driver, opened, "reflines.smooth")
    finally:
        webbrowser.open = browser
    assert sections(opened) >= {"reflines.set_up", "reflines.smooth"}, opened[-20:]


def ask_down_the_tab(driver: window.Window, opened: list[str], wanted: str) -> sidebar.Steps:
    """Presses F1 on each place down the tab, until a section has been opened."""
    region = driver.region('UI')
    for y in range(10, region.height - 10, ROW):
        if wanted in sections(opened):
            break
        sidebar.point(driver, region.width // 2, region.height - y)
        yield 0.03
        driver.key('F1')
        yield 0.03


def sections(opened: list[str]) -> set[str]:
    """Returns the sections of the add-on's own manual among the opened addresses."""
    return {url.partition("#")[2] for url in opened if url.startswith("file:")}
