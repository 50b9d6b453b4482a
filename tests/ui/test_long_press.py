"""A press on many faces in a real window: Blender goes on, Esc takes it back, the result is the operator's."""
import sys
import time
from collections.abc import Generator

import bmesh
import bpy
import numpy as np
from mathutils import Matrix

import scenes
import window
from dragging import at_rest, panel, shown, taken_back, undone_and_redone
from test_across_gap import bent, half, start_several
from window import Steps

CELLS = 80  # 6,084 selected faces
PATIENCE = 120.0  # seconds


def prepare(driver: window.Window) -> None:
    """Makes a panel whose vertices are noisy, which a press heals, and of which no earlier press is kept."""
    sys.modules["reflection_lines"].state.press_cache._presses.clear()
    ob = panel(driver, CELLS)
    random = np.random.default_rng(3)
    mesh = bmesh.from_edit_mesh(ob.data)
    for vertex in mesh.verts:
        vertex.co.z += 2e-4 * random.standard_normal()
    bmesh.update_edit_mesh(ob.data)
    with driver.override():
        bpy.ops.ed.undo_push(message="Noise")


def press(driver: window.Window, **settings: object) -> Steps:
    """Presses Smooth as its button does; returns while it is at work."""
    driver.move(300, 300)
    yield 0.1
    with driver.override():
        assert bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, **settings) == {'RUNNING_MODAL'}


def wait(limit: float = PATIENCE) -> Generator[float, None, float]:
    """Waits until the press has ended; returns the longest time in which Blender did nothing else."""
    longest, before, begun = 0.0, time.monotonic(), time.monotonic()
    while not at_rest() and before - begun < limit:
        yield 0.01
        longest, before = max(longest, time.monotonic() - before), time.monotonic()
    yield 0.2
    return longest


def test_a_long_press_lets_blender_go_on_and_gives_the_result_of_the_operator(driver: window.Window) -> Steps:
    """One undo step; nothing is shown before the end."""
    prepare(driver)
    with driver.override():
        begun = time.monotonic()
        scenes.smooth()
        whole = time.monotonic() - begun
    expected = shown(driver)
    prepare(driver)
    before = shown(driver)
    yield from press(driver)
    yield 0.05
    assert np.array_equal(shown(driver), before)
    longest = yield from wait()
    assert np.array_equal(shown(driver), expected) and (expected != before).any()
    assert longest < max(0.5 * whole, 0.4), f"Blender stood still for {longest:.2f} s of a press of {whole:.2f} s"
    assert bpy.context.view_layer.objects.active.reflection_lines.report.termination == "converged"
    yield from undone_and_redone(driver, before, expected)


def test_escape_takes_a_long_press_back(driver: window.Window) -> Steps:
    prepare(driver)
    before = scenes.fingerprint(bpy.data.objects["Panel"])
    yield from press(driver)
    yield from taken_back(driver)
    yield from wait()
    assert scenes.fingerprint(bpy.data.objects["Panel"]) == before
    assert bpy.data.objects["Panel"].reflection_lines.report.termination == ""


def test_a_long_press_of_several_objects_gives_the_result_of_the_operator(driver: window.Window) -> Steps:
    """An object that looks away from the view is left by both."""
    results = []
    for long in (False, True):
        with driver.override():
            sys.modules["reflection_lines"].state.press_cache._presses.clear()
            bpy.ops.object.mode_set(mode='OBJECT')
            bpy.data.batch_remove(list(bpy.data.objects))
            left = half("Left", -1.0, -0.002, bent, 30)
            right = half("Right", 0.002, 1.0, lambda x, y: bent(-x, y), 30)
            away = half("Away", 3.0, 4.0, bent, 6)
            away.data.flip_normals()
            start_several(left, right, away)
            before = np.concatenate([scenes.world(ob) for ob in (left, right)])
        if long:
            yield from press(driver, border='follow')
            yield from wait()
        else:
            with driver.override():
                assert scenes.smooth(border='follow') == {'FINISHED'}
        results.append(np.concatenate([scenes.world(ob) for ob in (left, right)]))
        assert np.abs(results[-1] - before).max() > 1e-3
    assert np.array_equal(*results)


def test_other_tools_press_beside_blender_too(driver: window.Window) -> Steps:
    results = []
    for long in (False, True):
        panel(driver, CELLS)
        with driver.override():
            how = 'INVOKE_DEFAULT' if long else 'EXEC_DEFAULT'
            ended = bpy.ops.reflines.direction(how, True, density=1.1)
        assert ended == {'RUNNING_MODAL' if long else 'FINISHED'}
        yield from wait()
        results.append(shown(driver))
    assert np.array_equal(*results)


def test_panels_of_different_size_keep_their_own_lengths(driver: window.Window) -> Steps:
    """The automatic length is a share of a panel's size: with that of the last panel the first moved as that one."""
    results = []
    for long in (True, False):
        ob = panel(driver, 60)
        with driver.override():
            scenes.object_mode()
            other = scenes.panel("Other", cells=24)
            other.data.transform(Matrix.Scale(0.3, 4))
            scenes.activate(ob)
            scenes.edit_inner(ob, 60)
            scenes.select_faces(other, scenes.inner(24))
            how = 'INVOKE_DEFAULT' if long else 'EXEC_DEFAULT'
            ended = bpy.ops.reflines.smooth(how, True, directional=True)
        assert ended == {'RUNNING_MODAL' if long else 'FINISHED'}
        yield from wait()
        results.append([scenes.positions(each) for each in (ob, other)])
    for beside, blocking in zip(*results, strict=True):
        assert np.array_equal(beside, blocking)
