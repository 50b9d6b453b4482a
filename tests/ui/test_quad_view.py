"""Quad View: tools work with the view that the mouse is over, and each view has its own legend and divider."""
import sys

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


def find_sides(driver: window.Window, region: bpy.types.Region) -> tuple[int, int]:
    """What toolbar and sidebar leave of a view, in its own pixels."""
    tools, sidebar = driver.region('TOOLS'), driver.region('UI')
    low = tools.x + tools.width - region.x if tools.width > 1 else 0
    high = sidebar.x - region.x if sidebar.width > 1 else region.width
    return max(low, 0), min(high, region.width)


def find_panel_sides(driver: window.Window, region: bpy.types.Region) -> tuple[float, float]:
    """From where to where a view shows the panel, in its own pixels."""
    with override(driver, region):
        places = [location_3d_to_region_2d(region, bpy.context.region_data, Vector(vertex)).x
                  for vertex in scenes.world(bpy.context.view_layer.objects.active)]
    return min(places), max(places)


def test_each_view_has_legend_and_divider_within_it(driver: window.Window) -> Steps:
    panel(driver, cells=24)
    with driver.override():
        scenes.smooth(length=1.0)
        scenes.object_mode()
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.before, stripes.side_by_side = True, True
    addon = sys.modules["reflection_lines"]
    legend, lefts = addon.overlay.legend, {}
    draw_bar = legend.draw_bar
    legend.draw_bar = lambda mode, left, *rest: lefts.update({bpy.context.region.as_pointer(): left})
    yield from four_views(driver)
    driver.redraw()
    yield 0.8
    dividers = [addon.state.compared.find_divider(region) for region in regions(driver)]
    stripes.before, stripes.mode = False, 'DEVIATION'
    driver.redraw()
    yield 0.5
    legend.draw_bar = draw_bar
    margin = legend.MARGIN * bpy.context.preferences.system.ui_scale
    for number, region in enumerate(regions(driver)):
        low, high = find_sides(driver, region)
        assert lefts[region.as_pointer()] == low + margin, (number, lefts, low)
        left, right = find_panel_sides(driver, region)
        expected = 0.5 * (max(left, low) + min(right, high))
        assert dividers[number] is not None and abs(dividers[number] - expected) < 2.0, (number, dividers, expected)
        assert low < expected < high, number
    stripes.mode = 'REFLECTION'
    yield from toggle(driver)
