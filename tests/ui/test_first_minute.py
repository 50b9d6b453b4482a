"""A car artist's first minute: from an imported body to a healed bonnet with the mouse, counting clicks and drags."""
import tempfile
from pathlib import Path

import bpy
import numpy as np
from bpy_extras import view3d_utils

import sidebar
import window
from dragging import ended, shown
from newcomer import headline, settings

Steps = sidebar.Steps
CAR = Path(__file__).resolve().parents[2] / "blend_samples" / "car.blend"
ON_BONNET = (0.25, -1.4, 0.87)  # a place of the sample's bonnet
MOST = 6                        # clicks and drags
PANELS = ("Body", "Bonnet", "Doors")


class CountingWindow(window.Window):
    """Counts each press of a mouse button, which begins a click or a drag."""
    presses = 0

    def event(self, kind: str, value: str = 'NOTHING', **modifiers: bool) -> None:
        self.presses += value == 'PRESS' and kind in {'LEFTMOUSE', 'MIDDLEMOUSE', 'RIGHTMOUSE'}
        super().event(kind, value, **modifiers)


def import_body(driver: window.Window, folder: str) -> bpy.types.Object:
    """Makes the scene of somebody who has imported a car: one mesh without modifiers, camera or light."""
    file = str(Path(folder) / "body.obj")
    bpy.ops.wm.open_mainfile(filepath=str(CAR), load_ui=False)
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


def find_tab(driver: window.Window) -> Steps:
    """Finds where the sidebar's tab is, since Blender 3.4 does not tell; the sidebar is closed then, on another tab."""
    places: list[tuple[float, float]] = []
    kept = sidebar.press

    def press(pressed: window.Window, x: float, y: float) -> Steps:
        places.append((x, y))
        yield from kept(pressed, x, y)

    sidebar.press = press
    yield from sidebar.open_tab(driver)
    sidebar.press = kept
    yield from sidebar.press(driver, *places[0])
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


def test_from_an_imported_body_to_a_healed_bonnet(_driver: window.Window) -> Steps:
    """By keys: the view from above, Edit Mode, the faces joined with the one under the mouse, the sidebar. By mouse: a
    drag of the view, the tab, Set Up from This View, Smooth Lines, Reset Custom Normals, which the file brought along.
    """
    bpy.context.preferences.view.smooth_view = 0
    with tempfile.TemporaryDirectory() as folder:
        body = import_body(window.Window(), folder)
    yield 0.5
    driver = CountingWindow()
    tab = yield from find_tab(driver)
    driver.presses = 0
    yield from window.take_picture(driver, "minute_0_imported")
    driver.move(250, 300)
    driver.key('NUMPAD_7')
    yield 0.5
    driver.key('NUMPAD_PERIOD')
    yield 0.7
    driver.key('TAB')
    driver.key('THREE')
    yield 0.3
    driver.redraw()
    yield 0.5
    move_over(driver, ON_BONNET)
    yield 0.3
    driver.key('L')
    yield 0.4
    assert body.mode == 'EDIT' and body.data.total_face_sel == 2 * 6039, body.data.total_face_sel
    driver.key('NUMPAD_PERIOD')
    yield 0.7
    yield from window.take_picture(driver, "minute_1_selected")
    yield from drag_view(driver, 0, 25)  # 1: the bonnet faces the view
    yield from window.take_picture(driver, "minute_2_turned")
    driver.key('N')
    yield 0.4
    yield from sidebar.press(driver, *tab)  # 2
    yield 0.3
    yield from sidebar.press(driver, *(yield from sidebar.find_button(driver, "bpy.ops.reflines.set_up()")))  # 3
    driver.move(200, 300)
    yield from window.take_picture(driver, "minute_3_set_up")
    assert settings().missing() == "" and settings().stripes.show
    before = shown(driver)
    yield from sidebar.press(driver, *(yield from sidebar.find_button(driver, "bpy.ops.reflines.smooth()")))  # 4
    yield from ended(driver)
    driver.move(200, 300)
    yield from window.take_picture(driver, "minute_4_healed")
    reset = "bpy.ops.mesh.customdata_custom_splitnormals_clear()"
    yield from sidebar.press(driver, *(yield from sidebar.find_button(driver, reset)))  # 5
    yield 0.3
    assert not body.data.has_custom_normals
    driver.move(200, 300)
    yield from window.take_picture(driver, "minute_5_shaded")
    print(driver.presses, headline(), flush=True)
    report = body.reflection_lines.report
    assert driver.presses <= MOST, driver.presses
    assert report.healed_area > 0.1 and report.worst_after < 0.2 * report.worst_before, headline()
    assert 1e-3 < np.abs(shown(driver) - before).max() < 5e-3


window.run(test_from_an_imported_body_to_a_healed_bonnet)
