"""Drags that lose what they work on: a script or another window removes the view camera, or changes a mesh."""
from collections.abc import Callable, Generator

import bmesh
import bpy
import numpy as np
from mathutils import Matrix

import scenes
import window
from dragging import is_running, moved, panel, press, settled, shown, taken_back
from errors import read_errors
from pulling import MIDDLE, UP, move, pull, session, start
from window import Steps

CHANGED = "Panel was changed while it was dragged: it is left as it is now"


def remove_camera() -> None:
    bpy.data.objects.remove(bpy.context.scene.reflection_lines.camera)


def press_pattern(driver: window.Window) -> Steps:
    image = bpy.data.images.new("Image", 64, 64)
    image.generated_type = 'COLOR_GRID'
    bpy.context.scene.reflection_lines.pattern.image = image
    yield from press(driver, "pattern")


def press_direction(driver: window.Window) -> Steps:
    bpy.context.scene.reflection_lines.direction.direction = 'ANGLE'
    yield from press(driver, "direction")


def fresh(driver: window.Window) -> Generator[float, None, bpy.types.Object]:
    """A panel; a drag that a failed test left is ended."""
    yield from taken_back(driver)
    return panel(driver)


def move_on(driver: window.Window) -> Steps:
    for x in (360, 350):
        driver.move(x, 300)
        yield 0.3


def test_a_tool_whose_camera_is_removed_takes_all_back_and_says_so(driver: window.Window) -> Steps:
    for begin in (press_direction, press_pattern, press):
        yield from fresh(driver)
        before = shown(driver)
        yield from begin(driver)
        yield from moved(driver, 380, 300)
        assert is_running() and not np.array_equal(shown(driver), before)
        remove_camera()
        yield from move_on(driver)
        assert not is_running() and np.array_equal(shown(driver), before), begin.__name__
        assert driver.read_last_report().startswith("No view camera: press Set Up from This View")


def test_a_session_whose_camera_is_removed_takes_all_back_and_says_so(driver: window.Window) -> Steps:
    before = yield from start(driver)
    yield from pull(driver, MIDDLE, UP)
    assert not np.array_equal(shown(driver), before)
    remove_camera()
    driver.event('LEFTMOUSE', 'PRESS')
    yield from move(driver, UP[0], UP[1] + 5)
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.3
    assert not is_running() and np.array_equal(shown(driver), before)
    assert driver.read_last_report().startswith("No view camera: press Set Up from This View")


def test_an_error_in_a_drag_ends_it_in_order(driver: window.Window) -> Steps:
    """An error of ours that nobody expected: Blender prints it and drops the operator."""
    yield from fresh(driver)
    before = shown(driver)
    yield from press(driver)
    assert not np.array_equal(shown(driver), before)
    del session().values
    written = yield from read_errors(move_on(driver))
    assert not is_running() and np.array_equal(shown(driver), before)
    assert "AttributeError" in written, written


def rename(ob: bpy.types.Object) -> None:
    ob.name = "Renamed"


def delete_vertex(ob: bpy.types.Object) -> None:
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.verts.ensure_lookup_table()
    bmesh.ops.delete(mesh, geom=[mesh.verts[0]], context='VERTS')
    bmesh.update_edit_mesh(ob.data)


def raise_vertices(ob: bpy.types.Object) -> None:
    mesh = bmesh.from_edit_mesh(ob.data)
    bmesh.ops.translate(mesh, verts=mesh.verts, vec=(0.0, 0.0, 1.0))
    bmesh.update_edit_mesh(ob.data)


def enter(driver: window.Window) -> Steps:
    driver.key('RET')
    yield 0.3


def test_a_change_by_something_else_ends_a_drag_at_rest(driver: window.Window) -> Steps:
    """The next move of the mouse or Enter finds it, whose positions stay."""
    changes: tuple[Callable[[bpy.types.Object], object], ...] = (rename, bpy.data.objects.remove, delete_vertex,
                                                                raise_vertices)
    for change in changes:
        for go_on in (move_on, enter):
            ob = yield from fresh(driver)
            yield from press(driver, "direction")
            yield from move_on(driver)
            yield from settled(driver)
            change(ob)
            kept = shown(driver) if change is raise_vertices else None
            yield from go_on(driver)
            assert not is_running(), change
            assert driver.read_last_report() == CHANGED
            assert kept is None or np.array_equal(shown(driver), kept)


def test_the_other_panels_of_a_drag_are_restored(driver: window.Window) -> Steps:
    first = yield from fresh(driver)
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
        second = scenes.panel("Second")
        second.data.transform(Matrix.Translation((3.0, 0.0, 0.0)))
        scenes.edit_inner(second)
        scenes.edit_inner(first)
    before = scenes.positions(second)
    yield from press(driver)
    assert not np.array_equal(scenes.positions(second), before)
    raise_vertices(first)
    yield from move_on(driver)
    assert not is_running() and np.array_equal(scenes.positions(second), before)
