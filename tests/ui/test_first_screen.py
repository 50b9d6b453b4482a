"""What an artist sees first of the tab, in a window of 1280 x 900: few controls, and all of them without scrolling."""
from collections.abc import Callable, Generator
from pathlib import Path

import bpy

import sidebar
import window
from recording import Stand
from window import Steps

CAR = Path(__file__).resolve().parents[2] / "blend_samples" / "car.blend"
MOST = 9
PARTS = ("draw", "draw_header", "draw_header_preset")


def noting(draw: Callable, drawn: dict[str, list[str]], place: str) -> Callable:
    """Returns a panel's function that also notes the controls that it draws."""
    def draw_and_note(self: bpy.types.Panel, context: bpy.types.Context) -> None:
        stand = Stand(type(self), self.layout)
        draw(stand, context)
        drawn[place] = stand.layout.list_controls()
    return draw_and_note


def read_controls(driver: window.Window) -> Generator[float, None, list[str]]:
    """Returns the controls of the panels as Blender draws them in the sidebar: of folded ones those of the header."""
    drawn: dict[str, list[str]] = {}
    kinds = [getattr(bpy.types, name) for name in dir(bpy.types) if name.startswith("VIEW3D_PT_reflines")]
    kept = [(kind, part, vars(kind).get(part), getattr(kind, part)) for kind in kinds for part in PARTS
            if hasattr(kind, part)]
    for kind, part, _, function in kept:
        setattr(kind, part, noting(function, drawn, f"{kind.__name__}.{part}"))
    driver.redraw()
    while len(drawn) < 3:  # the large button's panel, and both ends of a folded header; Blender draws all at once
        yield 0.05
    for kind, part, own, _ in kept:
        delattr(kind, part) if own is None else setattr(kind, part, own)
    return [control for controls in drawn.values() for control in controls]


def all_is_seen(driver: window.Window) -> Steps:
    """The sidebar does not scroll, so that none of its panels goes on below it."""
    assert driver.window.width <= 1280 and driver.window.height <= 900
    region = driver.region('UI')
    sidebar.point(driver, region.width // 2, region.height - 20)
    before = region.view2d.region_to_view(0, 0)
    for _ in range(3):
        driver.event('WHEELDOWNMOUSE', 'PRESS')
    yield 0.3
    assert region.view2d.region_to_view(0, 0) == before


def test_a_new_scene_begins_with_the_set_up(driver: window.Window) -> Steps:
    yield from sidebar.open_tab(driver)
    controls = yield from read_controls(driver)
    yield from window.take_picture(driver, "first_screen_new")
    assert controls[0] == "reflines.set_up" and len(controls) <= MOST, controls
    yield from all_is_seen(driver)


def test_the_car_begins_with_smooth_lines(_driver: window.Window) -> Steps:
    bpy.ops.wm.open_mainfile(filepath=str(CAR), load_ui=True)
    yield 1.0
    driver = window.Window()
    controls = yield from read_controls(driver)
    yield from window.take_picture(driver, "first_screen_car")
    assert controls[0] == "reflines.smooth" and len(controls) <= MOST, controls
    yield from all_is_seen(driver)
