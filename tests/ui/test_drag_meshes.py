"""Drags of meshes that are not plain: shape keys, hidden faces, several pieces; and of ones that change meanwhile."""
import sys
from collections.abc import Callable

import bmesh
import bpy
import numpy as np

import scenes
import window
from dragging import applied, dragged_length, ended, moved, panel, press, shown
from window import Steps

Prepare = Callable[[bpy.types.Object], None]

CELLS = 16


def prepared(driver: window.Window, prepare: Prepare) -> bpy.types.Object:
    ob = panel(driver, CELLS)
    with driver.override():
        prepare(ob)
        bpy.ops.ed.undo_push(message="Prepared")
    return ob


def is_dragged_well(driver: window.Window, prepare: Prepare) -> Steps:
    """It follows, Escape leaves no bit changed, and what is kept is what the operator makes without a mouse."""
    ob = prepared(driver, prepare)
    before, start = scenes.fingerprint(ob), shown(driver).copy()
    for way_out in ('ESC', 'RET'):
        yield from press(driver)
        yield from moved(driver, 250, 300)
        assert np.abs(shown(driver) - start).max() > 1e-5
        driver.key(way_out)
        yield 0.3
        if way_out == 'ESC':
            assert scenes.fingerprint(bpy.data.objects["Panel"]) == before
    yield from ended(driver)
    kept, length = scenes.fingerprint(bpy.data.objects["Panel"]), dragged_length()
    prepared(driver, prepare)
    with driver.override():
        scenes.smooth(strength=0.5, length=length)
    assert scenes.fingerprint(bpy.data.objects["Panel"]) == kept


def give_shape_keys(ob: bpy.types.Object) -> None:
    """The second key, which differs from the basis, is the one that is edited."""
    bpy.ops.object.mode_set(mode='OBJECT')
    ob.shape_key_add(name="Basis")
    lifted = ob.shape_key_add(name="Lifted")
    for point in lifted.data:
        point.co.z += 0.02 * point.co.x
    ob.active_shape_key_index = 1
    bpy.ops.object.mode_set(mode='EDIT')


def hide_a_corner(ob: bpy.types.Object) -> None:
    mesh = bmesh.from_edit_mesh(ob.data)
    for face in mesh.faces:
        if face.calc_center_median().x > 0.5:
            face.hide_set(True)
    bmesh.update_edit_mesh(ob.data)


def cut_in_two(ob: bpy.types.Object) -> None:
    """Two regions with unselected faces between them."""
    scenes.select_faces(ob, lambda face: scenes.inner(CELLS)(face) and face % CELLS not in (7, 8))


def test_a_shape_key(driver: window.Window) -> Steps:
    yield from is_dragged_well(driver, give_shape_keys)
    basis = bpy.data.objects["Panel"].data.shape_keys.key_blocks["Basis"]
    z = [scenes.rippled(point.co.x, point.co.y) for point in basis.data]
    np.testing.assert_allclose([point.co.z for point in basis.data], z, atol=1e-7)


def test_hidden_faces(driver: window.Window) -> Steps:
    yield from is_dragged_well(driver, hide_a_corner)


def test_two_pieces(driver: window.Window) -> Steps:
    yield from is_dragged_well(driver, cut_in_two)


def split(ob: bpy.types.Object) -> None:
    """More vertices and faces than before."""
    mesh = bmesh.from_edit_mesh(ob.data)
    bmesh.ops.subdivide_edges(mesh, edges=list(mesh.edges)[:4], cuts=1)
    bmesh.update_edit_mesh(ob.data)


def thin_out(ob: bpy.types.Object) -> None:
    mesh = bmesh.from_edit_mesh(ob.data)
    bmesh.ops.delete(mesh, geom=list(mesh.faces)[-40:], context='FACES')
    bmesh.update_edit_mesh(ob.data)


def is_noticed(driver: window.Window, change: Prepare) -> Steps:
    """The drag ends by itself and leaves the mesh as it was changed."""
    panel(driver, CELLS)
    yield from press(driver)
    change(bpy.data.objects["Panel"])
    left = shown(driver).copy()
    driver.move(250, 300)
    yield 1.0
    driver.move(350, 300)
    yield 1.0
    assert np.array_equal(shown(driver), left)
    with driver.override():
        assert scenes.smooth(strength=1.0) == {'FINISHED'}  # on the mesh as it is now
    assert not np.array_equal(shown(driver), left)


def test_new_topology_ends_a_drag(driver: window.Window) -> Steps:
    yield from is_noticed(driver, split)
    yield from is_noticed(driver, thin_out)


def test_new_topology_after_a_drag_is_taken_in(driver: window.Window) -> Steps:
    """The optimizer that the drag kept does not serve the new mesh."""
    ob = panel(driver, CELLS)
    yield from press(driver)
    yield from applied(driver)
    split(ob)
    with driver.override():
        bpy.ops.ed.undo_push(message="Split")
        assert scenes.smooth(length=0.9) == {'FINISHED'}
    again = shown(driver).copy()
    sys.modules["reflection_lines"].state.optimizer_cache._optimizers.clear()
    with driver.override():
        bpy.ops.ed.undo()
        assert scenes.smooth(length=0.9) == {'FINISHED'}
    assert np.array_equal(shown(driver), again)
