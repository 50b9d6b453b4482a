"""Pick Two Points in a real window: two clicks give a direction, Esc leaves all as it was."""
from collections.abc import Generator

import bpy
import numpy as np

import scenes
import window

Steps = Generator[float, None, None]


def prepare(driver: window.Window) -> None:
    with driver.override():
        for old in list(bpy.data.objects):
            bpy.data.objects.remove(old)
        scenes.panel()
        scenes.look_from_above()
        bpy.context.view_layer.update()
    region_3d = driver.region_3d()
    region_3d.view_perspective = 'ORTHO'
    region_3d.view_rotation = bpy.context.scene.reflection_lines.camera.matrix_world.to_quaternion()
    region_3d.view_distance = 4.0


def click(driver: window.Window, x: int, y: int) -> Steps:
    driver.move(x, y)
    yield 0.1
    driver.key('LEFTMOUSE')
    yield 0.1


def test_two_clicks_are_a_direction(driver: window.Window) -> Steps:
    prepare(driver)
    yield 0.3
    with driver.override():
        bpy.ops.reflines.pick_direction('INVOKE_DEFAULT')
    yield from click(driver, 300, 300)
    yield from click(driver, 400, 350)
    settings = bpy.context.scene.reflection_lines.direction
    assert settings.direction == 'POINTS'
    between = np.array(settings.end) - np.array(settings.start)
    assert abs(between[1] / between[0] - 0.5) < 1e-3  # seen from above, X to the right and Y up
    assert abs(between[2]) < 1e-6


def test_escape_leaves_all_as_it_was(driver: window.Window) -> Steps:
    settings = bpy.context.scene.reflection_lines.direction
    settings.direction = 'MEAN'
    before = tuple(settings.start)
    with driver.override():
        bpy.ops.reflines.pick_direction('INVOKE_DEFAULT')
    yield from click(driver, 500, 300)
    driver.key('ESC')
    yield 0.2
    assert settings.direction == 'MEAN' and tuple(settings.start) == before


def test_clicks_beside_the_view_do_not_count(driver: window.Window) -> Steps:
    """On another editor, and on a header of the view's own."""
    prepare(driver)
    settings, other = bpy.context.scene.reflection_lines.direction, driver.area('PROPERTIES')
    settings.direction = 'MEAN'
    with driver.override():
        bpy.ops.reflines.pick_direction('INVOKE_DEFAULT')
    for region in (other.regions[-1], driver.region('HEADER')):
        driver.x, driver.y = region.x + region.width // 2, region.y + region.height // 2
        driver.event('MOUSEMOVE')
        yield 0.1
        driver.key('LEFTMOUSE')
        yield 0.1
    yield from click(driver, 500, 300)
    assert settings.direction == 'MEAN'
    yield from click(driver, 560, 300)
    assert settings.direction == 'POINTS' and abs(settings.end[1] - settings.start[1]) < 1e-5


def test_a_trackpad_moves_the_view_meanwhile(driver: window.Window) -> Steps:
    prepare(driver)
    with driver.override():
        bpy.ops.reflines.pick_direction('INVOKE_DEFAULT')
    driver.move(400, 300)
    yield 0.1
    before = driver.region_3d().view_matrix.copy()
    driver.event('TRACKPADPAN')
    driver.x += 40
    driver.event('TRACKPADPAN')
    yield 0.5
    driver.key('ESC')
    yield 0.2
    assert driver.region_3d().view_matrix != before


window.run(test_two_clicks_are_a_direction, test_escape_leaves_all_as_it_was,
           test_clicks_beside_the_view_do_not_count, test_a_trackpad_moves_the_view_meanwhile)
