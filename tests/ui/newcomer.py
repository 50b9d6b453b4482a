"""A newcomer, who goes through README's first use with the mouse: first on a sample, then on a model of their own."""
import tempfile
from collections.abc import Callable, Generator
from pathlib import Path

import bpy
import numpy as np
from bpy_extras import view3d_utils

import sidebar
import window
from dragging import ended, shown, struck
from window import Steps

Note = Callable[[str], Steps]  # what is done after a step, with its name
SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "car.blend"
PANELS = ("Body", "Bonnet", "Doors")
BONNET_FACES = 2 * 6039         # of the sample's bonnet and its mirrored half
ON_BONNET = (0.25, -1.4, 0.87)  # a place of it


def settings() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines


def headline() -> str:
    return bpy.context.view_layer.objects.active.reflection_lines.report.headline()


def press_button(driver: window.Window, command: str) -> Steps:
    x, y = yield from sidebar.find_button(driver, f"bpy.ops.reflines.{command}()")
    yield from sidebar.press(driver, x, y)
    yield 0.3


def scroll_up(driver: window.Window) -> Steps:
    region = driver.region('UI')
    sidebar.point(driver, region.width // 2, region.height - 20)  # the wheel below the last panel is the view's
    for _ in range(40):
        driver.event('WHEELUPMOUSE', 'PRESS')
    yield 0.3


def use_sample(note: Note) -> Steps:
    """Steps 2 and 3: opens the car, smooths its bonnet, and takes that back."""
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLE), load_ui=True)
    yield 1.5
    driver = window.Window()
    assert driver.area().spaces.active.show_region_ui  # no key N: that would close the sidebar
    assert (yield from sidebar.shows_tab(driver))
    yield from scroll_up(driver)
    yield from note("sample")
    before = shown(driver)
    yield from press_button(driver, "smooth")
    yield from ended(driver)
    after = shown(driver)
    assert np.abs(after - before).max() > 1e-4
    assert headline().startswith("Flaws healed on ") and ", moved at most 2." in headline(), headline()
    driver.move(300, 300)
    yield from note("smoothed")
    yield from struck(driver, 'Z', ctrl=True)
    assert np.array_equal(shown(driver), before)


class CountingWindow(window.Window):
    """Counts each press of a mouse button, which begins a click or a drag."""
    presses = 0

    def event(self, kind: str, value: str = 'NOTHING', **modifiers: bool) -> None:
        self.presses += value == 'PRESS' and kind in {'LEFTMOUSE', 'MIDDLEMOUSE', 'RIGHTMOUSE'}
        super().event(kind, value, **modifiers)


def import_body(driver: window.Window, folder: str) -> bpy.types.Object:
    """Makes the scene of somebody who has imported a car: one mesh without modifiers, camera or light."""
    file = str(Path(folder) / "body.obj")
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLE), load_ui=False)
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
        for ob in bpy.data.objects:
            ob.select_set(ob.name in PANELS)
            if "Subdivision" in ob.modifiers:
                ob.modifiers["Subdivision"].levels = 1  # of 130,000 faces each redraw takes long
        bpy.ops.wm.obj_export(filepath=file, export_selected_objects=True, export_materials=False)
        bpy.ops.wm.read_homefile(use_empty=True, load_ui=False)
    with driver.override():
        bpy.ops.wm.obj_import(filepath=file)
        bpy.context.view_layer.objects.active = bpy.context.selected_objects[0]
        bpy.ops.object.join()
        bpy.ops.object.transform_apply()
    return bpy.context.view_layer.objects.active


def prepare_window(driver: window.Window) -> Generator[float, None, tuple[float, float]]:
    """Closes the sidebar on another tab; returns where the add-on's is, which Blender 3.4 does not tell."""
    places: list[tuple[float, float]] = []
    kept = sidebar.press

    def press(pressed: window.Window, x: float, y: float) -> Steps:
        places.append((x, y))
        yield from kept(pressed, x, y)

    driver.area().spaces.active.show_region_ui = True
    yield 0.3
    region = driver.region('UI')
    first = region.width - sidebar.TAB_STRIP, region.height - 20
    yield from kept(driver, *first)
    sidebar.press = press
    yield from sidebar.open_tab(driver)
    sidebar.press = kept
    yield from kept(driver, *first)
    driver.area().spaces.active.show_region_ui = False
    yield 0.3
    return places[-1]


def move_over(driver: window.Window, place: tuple[float, float, float]) -> None:
    driver.move(*view3d_utils.location_3d_to_region_2d(driver.region(), driver.region_3d(), place))


def drag_view(driver: window.Window, across: int, up: int) -> Steps:
    """Turns the view with the middle mouse button."""
    driver.event('MIDDLEMOUSE', 'PRESS')
    x, y = driver.x - driver.region().x, driver.y - driver.region().y
    for share in (0.25, 0.5, 0.75, 1.0):
        driver.move(x + share * across, y + share * up)
        yield 0.05
    driver.event('MIDDLEMOUSE', 'RELEASE')
    yield 0.2


def select_bonnet(driver: window.Window) -> Steps:
    """By keys: the view from above, Edit Mode, and the faces that are joined with the one under the mouse."""
    driver.move(250, 300)
    for key in ('NUMPAD_7', 'NUMPAD_PERIOD', 'TAB', 'THREE'):
        driver.key(key)
        yield 0.3
    driver.redraw()
    yield 0.5
    move_over(driver, ON_BONNET)
    yield 0.3
    driver.key('L')
    yield 0.4
    assert bpy.context.object.data.total_face_sel == BONNET_FACES, bpy.context.object.data.total_face_sel
    driver.key('NUMPAD_PERIOD')
    yield 0.5


def sweep_light(driver: window.Window, note: Note) -> Steps:
    """Turns the light by the button, a move and a click."""
    turn = settings().light_turn
    yield from press_button(driver, "sweep_light")
    for x in (200, 300):
        driver.move(x, 300)
        yield 0.3
    yield from note("swept")
    driver.key('LEFTMOUSE')
    yield 0.3
    assert abs(settings().light_turn - turn) > 0.3


def use_own_model(note: Note) -> Generator[float, None, int]:
    """Step 4: from an imported body to a healed bonnet. Returns how often a mouse button was pressed, for a click or a
    drag.
    """
    bpy.context.preferences.view.smooth_view = 0
    with tempfile.TemporaryDirectory() as folder:
        body = import_body(window.Window(), folder)
    yield 0.5
    driver = CountingWindow()
    tab = yield from prepare_window(driver)
    driver.presses = 0
    yield from select_bonnet(driver)
    yield from drag_view(driver, 0, 25)  # the bonnet faces the view
    yield from note("camera")
    driver.key('N')
    yield 0.4
    yield from sidebar.press(driver, *tab)
    yield from press_button(driver, "set_up")
    assert settings().missing() == "" and settings().stripes.show
    driver.move(200, 300)
    yield from note("stripes")
    yield from sweep_light(driver, note)
    before = shown(driver)
    yield from press_button(driver, "smooth")
    yield from ended(driver)
    driver.move(200, 300)
    yield from note("own_smoothed")
    report = body.reflection_lines.report
    assert report.healed_area > 0.1 and report.worst_after < 0.2 * report.worst_before, headline()
    assert 1e-3 < np.abs(shown(driver) - before).max() < 5e-3
    return driver.presses
