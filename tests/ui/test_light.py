"""Turning the light in a real window without leaving Edit Mode: by the sidebar, and by Sweep Light."""
from math import radians

import bpy
import numpy as np

import scenes
import window
from picture import captured, striped_panel
from scenes import settings
from window import Steps


def edited_panel(driver: window.Window, name: str) -> bpy.types.Object:
    """A panel with stripes, in Edit Mode; the light is at the turn 0 and the tilt 30 degrees."""
    ob = striped_panel(driver, name)
    with driver.override():
        scenes.edit(ob)
    return ob


def angle_between(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.degrees(np.arccos(np.clip(one @ other, -1.0, 1.0))))


def test_the_sidebar_turns_the_light_in_edit_mode(driver: window.Window) -> Steps:
    ob = edited_panel(driver, "Turned")
    before = yield from captured(driver)
    settings().light_turn, settings().light_tilt = radians(30.0), radians(20.0)
    after = yield from captured(driver)
    c = np.cos(radians(20.0))
    wanted = np.array([c * np.cos(radians(30.0)), c * np.sin(radians(30.0)), np.sin(radians(20.0))])
    # The camera looks along -Z with X to the right.
    assert angle_between(scenes.axis_z(settings().light), wanted) < 1e-3
    assert abs(settings().light_turn - radians(30.0)) < 1e-5 and abs(settings().light_tilt - radians(20.0)) < 1e-5
    settings().light_dial = (0.0, 1.0, 0.0)
    with driver.override():
        bpy.context.view_layer.update()
    assert angle_between(scenes.axis_z(settings().light), np.array([0.0, 1.0, 0.0])) < 1e-3
    assert ob.mode == 'EDIT' and (np.abs(before - after) > 0.1).sum() > 5000


def test_sweep_light_in_edit_mode(driver: window.Window) -> Steps:
    ob = edited_panel(driver, "Swept")
    start = np.array(settings().light.matrix_world)
    for key in ('ESC', 'RET'):
        driver.move(300, 300)
        yield 0.1
        with driver.override():
            bpy.ops.reflines.sweep_light('INVOKE_DEFAULT')
        before = yield from captured(driver)
        driver.move(400, 300)
        yield 0.2
        driver.event('WHEELDOWNMOUSE', 'PRESS')
        turned = yield from captured(driver)
        assert (np.abs(before - turned) > 0.1).sum() > 5000
        driver.key(key)
        yield 0.3
        with driver.override():
            bpy.context.view_layer.update()
        assert np.array_equal(np.array(settings().light.matrix_world), start) == (key == 'ESC')
    assert ob.mode == 'EDIT'
    print("turn and tilt, degrees", np.degrees([settings().light_turn, settings().light_tilt]))
    assert abs(settings().light_turn - radians(30.0)) < 1e-4  # 0.3 degrees a pixel, from the horizontal
    assert abs(settings().light_tilt - radians(30.0 - 2.0)) < 1e-4  # which stood at 60 degrees from the view
    with driver.override():
        assert bpy.ops.reflines.sweep_light(turn=0.5) == {'FINISHED'}  # by a script, the tilt as it is
    assert abs(settings().light_turn - 0.5) < 1e-4 and abs(settings().light_tilt - radians(28.0)) < 1e-4


def test_sweep_view_walks_around_the_panel(driver: window.Window) -> Steps:
    ob = edited_panel(driver, "Walked")
    stripes, light = settings().stripes, np.array(settings().light.matrix_world)
    for key in ('ESC', 'RET'):
        view, start = driver.region_3d(), driver.region_3d().view_rotation.copy()
        driver.move(300, 300)
        yield 0.1
        with driver.override():
            bpy.ops.reflines.sweep_view('INVOKE_DEFAULT')
        before = yield from captured(driver)
        driver.move(400, 300)
        yield 0.2
        turned = yield from captured(driver)
        assert (np.abs(before - turned) > 0.1).sum() > 5000 and stripes.eye == 'VIEWPORT'
        driver.key(key)
        yield 0.3
        turn = view.view_rotation.rotation_difference(start).angle
        wanted = radians(0.0 if key == 'ESC' else 30.0)  # 0.3 degrees a pixel
        assert abs(turn - wanted) < 1e-3 and (stripes.eye == 'CAMERA') == (key == 'ESC')
    stripes.eye = 'CAMERA'
    assert ob.mode == 'EDIT' and np.array_equal(np.array(settings().light.matrix_world), light)


def test_turn_and_tilt_can_be_typed_while_the_light_is_swept(driver: window.Window) -> Steps:
    """With units and expressions, as in the drag of a tool; the tilt's limit of 85 degrees is applied."""
    edited_panel(driver, "Typed")
    driver.move(300, 300)
    yield 0.1
    with driver.override():
        bpy.ops.reflines.sweep_light('INVOKE_DEFAULT')
    yield 0.1
    for key, text in (('TWO', "2"), ('EIGHT', "*"), ('TWO', "2"), ('FIVE', "5"), ('FOUR', "4"), ('BACK_SPACE', ""),
                      ('D', "d"), ('TAB', ""), ('NINE', "9"), ('ZERO', "0")):
        driver.event(key, 'PRESS', **({"unicode": text} if text else {}))
        driver.event(key, 'RELEASE')
        yield 0.05
    driver.move(500, 300)  # what is typed stays
    yield 0.1
    yield from window.take_picture(driver, "sweep_typed")
    driver.key('NUMPAD_ENTER')
    yield 0.3
    assert abs(settings().light_turn - radians(50.0)) < 1e-4, np.degrees(settings().light_turn)
    assert abs(settings().light_tilt - radians(85.0)) < 1e-4, np.degrees(settings().light_tilt)


def test_another_light_picked_meanwhile_ends_the_sweep_and_stays(driver: window.Window) -> Steps:
    edited_panel(driver, "Picked")
    swept, start = settings().light, np.array(settings().light.matrix_world)
    other = bpy.data.objects.new("Other", None)
    other.location = (7.0, 8.0, 9.0)
    bpy.context.collection.objects.link(other)
    driver.move(300, 300)
    yield 0.1
    with driver.override():
        bpy.ops.reflines.sweep_light('INVOKE_DEFAULT')
    driver.move(400, 300)
    yield 0.2
    assert not np.array_equal(np.array(swept.matrix_world), start)
    settings().light = other
    for event in (lambda: driver.move(420, 300), lambda: driver.key('ESC')):
        event()
        yield 0.3
        assert np.array_equal(np.array(swept.matrix_world), start)
        assert tuple(other.location) == (7.0, 8.0, 9.0) and not any(other.rotation_euler)
