"""Look Through and Set Up from This View in a real window."""

import bpy
import numpy as np
from mathutils import Euler

import scenes
import window
from picture import striped_panel
from scenes import settings
from window import Steps


def axes(driver: window.Window) -> np.ndarray:
    return np.array(driver.region_3d().view_matrix)[:3, :3].T


def look(driver: window.Window) -> Steps:
    with driver.override():
        assert bpy.ops.reflines.look_through() == {'FINISHED'}
    yield 0.8  # Blender's smooth view


def test_through_the_camera_and_back(driver: window.Window) -> Steps:
    striped_panel(driver, "Through")
    space, region_3d = driver.area().spaces.active, driver.region_3d()
    region_3d.view_perspective, region_3d.view_rotation = 'PERSP', Euler((0.6, 0.1, 0.4)).to_quaternion()
    yield 0.3
    before, scenes_own = axes(driver), bpy.context.scene.camera
    yield from look(driver)
    assert region_3d.view_perspective == 'CAMERA' and space.camera == settings().camera
    assert np.abs(axes(driver) - np.array(settings().camera.matrix_world)[:3, :3]).max() < 1e-5
    assert bpy.context.scene.camera == scenes_own
    yield from look(driver)
    assert region_3d.view_perspective == 'PERSP' and not space.use_local_camera
    assert np.abs(axes(driver) - before).max() < 1e-5


def add_camera(name: str) -> bpy.types.Object:
    camera = bpy.data.objects.new(name, bpy.data.cameras.new(name))
    bpy.context.collection.objects.link(camera)
    return camera


def describe(driver: window.Window) -> tuple:
    space = driver.area().spaces.active
    return space.region_3d.view_perspective, space.use_local_camera, space.camera


def test_back_to_another_camera(driver: window.Window) -> Steps:
    """The scene's own, and one of this view alone, also where the view was turned away in between."""
    striped_panel(driver, "Others")
    space, region_3d, bpy.context.scene.camera = driver.area().spaces.active, driver.region_3d(), add_camera("Own")
    for local in (None, add_camera("Local")):
        space.use_local_camera = local is not None
        if local is not None:
            space.camera = local
        region_3d.view_perspective = 'CAMERA'
        yield 0.3
        before = describe(driver)
        assert before == ('CAMERA', local is not None, local or bpy.context.scene.camera)
        yield from look(driver)
        assert describe(driver) == ('CAMERA', True, settings().camera)
        yield from look(driver)
        assert describe(driver) == before
        yield from look(driver)
        region_3d.view_perspective = 'ORTHO'
        yield from look(driver)
        assert describe(driver) == ('CAMERA', True, settings().camera)
        yield from look(driver)
        assert describe(driver) == ('ORTHO', *before[1:])
    space.use_local_camera = False


def test_the_camera_takes_this_view_in_edit_mode(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "From View")
    driver.region_3d().view_rotation = Euler((0.5, 0.0, 0.3)).to_quaternion()
    with driver.override():
        scenes.edit(ob)
    yield 0.3
    with driver.override():
        assert bpy.ops.reflines.set_up() == {'FINISHED'}
        bpy.context.view_layer.update()
    assert np.abs(axes(driver) - np.array(settings().camera.matrix_world)[:3, :3]).max() < 1e-5
    assert ob.mode == 'EDIT'
