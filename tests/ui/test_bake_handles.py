"""Kept handles keyed by hand in a real window, baked frame by frame, and played."""
import sys
from collections.abc import Generator

import bpy
import numpy as np
import pytest

import scenes
import sidebar
import window
from dragging import applied, settled, shown
from pulling import MIDDLE, UP, picture, pull, start
from window import Steps


def kept() -> bpy.types.PropertyGroup:
    return bpy.context.view_layer.objects.active.reflection_lines.handles.kept[0]


def keys_of_place() -> int:
    """The number of keys of the handle's height on the screen."""
    ob = bpy.context.view_layer.objects.active
    data, compat = ob.animation_data, sys.modules["reflection_lines"].blender.compat
    curves = compat.find_action_curves(data) if data is not None and data.action is not None else None
    curve = curves.find("reflection_lines.handles.kept[0].place", index=1) if curves is not None else None
    return 0 if curve is None else len(curve.keyframe_points)


def raise_panel(driver: window.Window) -> Steps:
    """Lets the panel of the handles stand open on top of the tab, where no other panel has to be unfolded first."""
    kind = bpy.types.VIEW3D_PT_reflines_handles
    bpy.utils.unregister_class(kind)
    del kind.bl_parent_id
    kind.bl_order = -1
    bpy.utils.register_class(kind)
    yield from sidebar.open_tab(driver)


def key_by_hand(driver: window.Window) -> Steps:
    """Presses I over the fields of the panel, from the bottom up, until the place has a key more."""
    wanted, region = keys_of_place() + 1, driver.region('UI')
    for y in range(20, region.height, 8):
        sidebar.point(driver, 0.6 * region.width, y)
        yield 0.05
        driver.key('I')
        yield 0.1
        if keys_of_place() == wanted:
            break
    yield from picture("keyed_place")
    assert keys_of_place() == wanted, "no field of the panel has keyed the place"


def keyed(driver: window.Window, *, by_hand: bool = False) -> Generator[float, None, list[np.ndarray]]:
    """A line pulled by hand, its handle keyed in frames 1 and 11, by hand or by a script; returns the shapes of both.
    """
    yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    yield from applied(driver)
    if by_hand and hasattr(bpy.types.VIEW3D_PT_reflines_handles, "bl_parent_id"):
        yield from raise_panel(driver)
    scene, shapes = bpy.context.scene, []
    for frame, way in ((1, 0.0), (11, -0.04)):
        scene.frame_set(frame)
        kept().place[1] += way
        if by_hand:
            yield from key_by_hand(driver)
        else:
            kept().keyframe_insert("place")
        with driver.override():
            assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
        shapes.append(shown(driver))
    assert np.abs(shapes[1] - shapes[0]).max() > 1e-4
    return shapes


def seen() -> np.ndarray:
    ob = bpy.context.view_layer.objects.active
    mesh = ob.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return np.array([vertex.co for vertex in mesh.vertices], dtype=np.float32)


def baking(driver: window.Window, step: int) -> None:
    driver.move(300, 300)
    with driver.override():
        assert bpy.ops.reflines.bake_handles('INVOKE_DEFAULT', True, step=step) == {'RUNNING_MODAL'}


def baked(ob: bpy.types.Object) -> list[str]:
    keys = ob.data.shape_keys
    return [] if keys is None else [each.name for each in keys.key_blocks[1:]]


def test_a_handle_is_keyed_baked_and_played(driver: window.Window) -> Steps:
    first, last = yield from keyed(driver, by_hand=True)
    ob, scene = bpy.context.view_layer.objects.active, bpy.context.scene
    scene.frame_set(4)
    baking(driver, step=2)
    for _ in range(200):
        yield 0.05
        if baked(ob):
            break
    yield 0.2
    assert len(baked(ob)) == 6 and scene.frame_current == 4 and ob.mode == 'OBJECT'
    scene.frame_start, scene.frame_end, played = 1, 11, {}
    scene.frame_set(1)
    with driver.override():
        bpy.ops.screen.animation_play()
    for _ in range(40):
        yield 0.05
        played.setdefault(scene.frame_current, seen())
    with driver.override():
        bpy.ops.screen.animation_cancel(restore_frame=False)
    yield 0.2
    assert len(played) > 3, sorted(played)
    assert all(np.abs(shape - first).max() < np.abs(last - first).max() * 1.01 for shape in played.values())
    moves = [np.abs(played[frame] - first).max() for frame in sorted(played)]
    assert moves == sorted(moves) and moves[-1] > moves[0] + 1e-5
    scene.frame_set(11)
    assert np.abs(seen() - last).max() < 3e-7
    yield from picture("played_last")
    scene.frame_set(1)
    assert np.abs(seen() - first).max() < 3e-7
    driver.move(300, 300)
    with driver.override(), pytest.raises(RuntimeError, match="drag in Edit Mode, or mute them"):
        bpy.ops.reflines.pull_line('INVOKE_DEFAULT', True)
    yield from picture("played_first")
    driver.move(300, 300)
    driver.key('Z', ctrl=True)
    yield 0.6
    assert not baked(bpy.context.view_layer.objects.active)


def test_escape_leaves_no_bit_changed(driver: window.Window) -> Steps:
    yield from keyed(driver)
    ob, scene = bpy.context.view_layer.objects.active, bpy.context.scene
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
    scene.frame_set(4)
    before = scenes.fingerprint(ob)
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 1, 900
    baking(driver, step=1)
    yield 0.2
    yield from picture("baking")
    driver.key('ESC')
    yield 0.5
    assert scenes.fingerprint(ob) == before and scene.frame_current == 4
    scene.use_preview_range = False
    yield from settled(driver)


def remove_camera() -> None:
    bpy.data.objects.remove(bpy.context.scene.reflection_lines.camera)


def break_bake() -> None:
    """An error of ours that nobody expected."""
    kind = sys.modules["reflection_lines"].interactive.handle_bake.HandleBake
    right = kind.find_scene

    def fail(bake: object) -> None:
        kind.find_scene = right
        raise ZeroDivisionError
    kind.find_scene = fail


def test_a_bake_that_cannot_go_on_takes_all_back_and_says_so(driver: window.Window) -> Steps:
    for how, told in ((remove_camera, "No view camera: press Set Up"), (break_bake, "ZeroDivisionError")):
        yield from keyed(driver)
        ob, scene = bpy.context.view_layer.objects.active, bpy.context.scene
        scene.frame_set(7)
        before = scenes.fingerprint(ob)
        baking(driver, step=1)
        assert ob.mode == 'OBJECT'
        how()
        yield 1.0
        assert ob.mode == 'EDIT' and scene.frame_current == 7 and scenes.fingerprint(ob) == before
        assert told in driver.read_last_report()
