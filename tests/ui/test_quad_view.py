"""Quad View: tools work with the view that the mouse is over."""

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

import scenes
import window
from dragging import panel, settled, shown
from pulling import session
from window import Steps

POINT = (0.35, -0.2)  # of the panel


def regions(driver: window.Window) -> list[bpy.types.Region]:
    return [region for region in driver.area().regions if region.type == 'WINDOW']


def toggle(driver: window.Window) -> Steps:
    with driver.override():
        bpy.ops.screen.region_quadview()
    yield 0.5


def four_views(driver: window.Window) -> Steps:
    """All see the panel from above, each from another place and distance."""
    yield from toggle(driver)
    for number, view in enumerate(driver.area().spaces.active.region_quadviews):
        view.view_perspective, view.view_rotation = 'ORTHO', (1.0, 0.0, 0.0, 0.0)
        view.view_distance, view.view_location = 3.0 + number, (0.1 * number, 0.2 - 0.1 * number, 0.0)
    yield 0.3
    assert len(regions(driver)) == 4


def override(driver: window.Window, region: bpy.types.Region) -> object:
    return bpy.context.temp_override(window=driver.window, area=driver.area(), region=region)


def point_at(driver: window.Window, region: bpy.types.Region, x: float, y: float) -> Steps:
    """Moves the mouse to where the region shows a point of the panel."""
    with override(driver, region):
        place = location_3d_to_region_2d(region, bpy.context.region_data, Vector((x, y, scenes.crown(x, y))))
    driver.x, driver.y = region.x + int(place.x), region.y + int(place.y)
    driver.event('MOUSEMOVE')
    yield 0.2


def click(driver: window.Window, value: str = 'PRESS') -> Steps:
    driver.event('LEFTMOUSE', value)
    yield 0.2


def test_a_line_is_pulled_where_the_mouse_is_in_each_view(driver: window.Window) -> Steps:
    panel(driver, cells=24)
    before = shown(driver)
    yield from four_views(driver)
    for number, region in enumerate(regions(driver)):
        yield from point_at(driver, region, *POINT)
        with override(driver, region):
            assert bpy.ops.reflines.pull_line('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}
        yield from settled(driver)
        yield from point_at(driver, region, *POINT)
        yield from click(driver)
        yield from point_at(driver, region, POINT[0], POINT[1] + 0.1)
        handle, = session().handles
        assert np.abs(np.subtract(handle.end[:2], (POINT[0], POINT[1] + 0.1))).max() < 0.03, (number, handle)
        yield from point_at(driver, regions(driver)[number - 1], *POINT)  # another view: the line stays where it is
        assert session().handles == (handle,), number
        yield from click(driver, 'RELEASE')
        driver.key('ESC')
        yield 0.4
        assert np.array_equal(shown(driver), before)
    yield from toggle(driver)


def test_fair_brush_paints_where_the_mouse_is_in_each_view(driver: window.Window) -> Steps:
    panel(driver, cells=24)
    bpy.context.scene.reflection_lines.brush.size = 12
    yield from four_views(driver)
    for number, region in enumerate(regions(driver)):
        yield from point_at(driver, region, *POINT)
        with override(driver, region):
            bpy.ops.wm.tool_set_by_id(name="reflection_lines.fair_brush")
        yield 0.2
        before = shown(driver)
        yield from click(driver)
        moved = np.abs(shown(driver) - before).max(axis=1) > 0.0
        assert moved.any(), number
        assert np.abs(before[moved, :2].mean(axis=0) - POINT).max() < 0.08, (number, before[moved, :2])
        driver.key('ESC')
        yield from click(driver, 'RELEASE')
    with driver.override():
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
    yield from toggle(driver)
