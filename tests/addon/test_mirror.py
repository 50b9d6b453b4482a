"""Symmetric regions stay so to the last bit; the seam of a Mirror modifier stays in its plane and does not kink."""
from math import radians

import bpy
import numpy as np
import pytest
from mathutils import Matrix

import scenes

CELLS = 12


def dented(x: float, y: float) -> float:
    """Symmetric about x = 0; every step is one that a change of x's sign changes no bit of."""
    fade = (1.0 - x * x) ** 2 * (1.0 - y * y) ** 2
    return -0.15 * x * x - 0.1 * y * y + 0.004 * fade * np.cos(9.0 * abs(x)) * np.cos(8.0 * y + 0.5)


def half() -> bpy.types.Object:
    """x from 0 to 1, with its image by a Mirror modifier."""
    ob = scenes.panel("Half", lambda x, y: 0.0, cells=CELLS)
    for vertex in ob.data.vertices:
        x = 0.5 * (vertex.co.x + 1.0)
        vertex.co = (x, vertex.co.y, dented(x, vertex.co.y))
    ob.modifiers.new("Mirror", 'MIRROR')
    return ob


def edit_half(ob: bpy.types.Object) -> None:
    """All but the outer borders: up to the seam."""
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face % CELLS < CELLS - 1 and 0 < face // CELLS < CELLS - 1)


def seen(light: tuple[float, float, float]) -> None:
    bpy.ops.reflines.set_up(part='CAMERA', direction=(0.0, 0.0, 1.0))
    bpy.ops.reflines.set_up(part='LIGHT', direction=light)


def columns(ob: bpy.types.Object) -> np.ndarray:
    """Rows x columns x 3; the first column is the seam."""
    return scenes.positions(ob).astype(float).reshape(CELLS + 1, CELLS + 1, 3)


EVEN = [(0.0, 0.9, 0.4), (1.0, 0.0, 0.0)]
UNEVEN = (0.7, 0.3, 0.4)


@pytest.mark.parametrize("light", EVEN)
@pytest.mark.parametrize("border", ['clamped', 'free'])
def test_the_half_gets_what_the_whole_gets(light, border) -> None:
    """Whether the modifier is applied or not, the seam is in the middle of one surface; quads are cut differently."""
    ob = half()
    seen(light)
    edit_half(ob)
    before = columns(ob)
    scenes.smooth(length=0.5, border=border)
    move = columns(ob) - before
    assert not columns(ob)[:, 0, 0].any()
    assert np.abs(move[:, 0]).max() > 5e-4
    scenes.object_mode()
    bpy.data.objects.remove(ob)
    whole = half()
    bpy.ops.object.modifier_apply(modifier="Mirror")
    faces = len(whole.data.polygons) // 2
    scenes.edit(whole)
    scenes.select_faces(whole, lambda face: face % faces % CELLS < CELLS - 1 and 0 < face % faces // CELLS < CELLS - 1)
    start = scenes.positions(whole)[:before.size // 3]
    scenes.smooth(length=0.5, border=border)
    other = scenes.positions(whole)[:before.size // 3] - start
    assert np.abs(other.reshape(move.shape) - move).max() < 0.05 * np.abs(move).max()


@pytest.mark.parametrize("border", ['clamped', 'free'])
def test_lit_unevenly_the_seam_and_its_tangents_stay(border) -> None:
    ob = half()
    seen(UNEVEN)
    edit_half(ob)
    before = columns(ob)
    assert scenes.smooth(border=border, length=0.5) == {'FINISHED'}
    assert np.abs(columns(ob) - before).max() > 5e-4
    assert np.array_equal(columns(ob)[:, :2], before[:, :2])


def about_an_empty(ob: bpy.types.Object, transform: str) -> None:
    """Moves the half away from its own origin, and lets the modifier mirror it about an empty where that was."""
    empty = bpy.data.objects.new("Middle", None)
    bpy.context.collection.objects.link(empty)
    empty.matrix_world = scenes.TRANSFORMS[transform]
    turn = Matrix.Rotation(radians(90.0), 4, 'Z')  # the plane is that of the empty's own axis Y
    empty.matrix_world @= turn
    ob.modifiers["Mirror"].mirror_object = empty
    ob.modifiers["Mirror"].use_axis = (False, True, False)
    ob.data.transform(Matrix.Translation((0.7, -0.2, 0.3)))
    ob.matrix_world = scenes.TRANSFORMS[transform] @ Matrix.Translation((-0.7, 0.2, -0.3))
    bpy.context.view_layer.update()


@pytest.mark.parametrize("transform", ["none", "moved", "turned", "scaled unevenly"])
def test_the_seam_of_a_mirror_about_an_object_stays(transform) -> None:
    ob = half()
    about_an_empty(ob, transform)
    axes = np.array(ob.matrix_world)[:3, :3]
    bpy.ops.reflines.set_up(part='CAMERA', direction=axes @ (0.5, 0.0, 1.0))
    bpy.ops.reflines.set_up(part='LIGHT', direction=axes @ (0.0, 1.0, 0.1))
    edit_half(ob)
    before = columns(ob)
    assert scenes.smooth(border='free', length=0.5) == {'FINISHED'}
    assert np.abs(columns(ob) - before).max() > 1e-4
    assert np.array_equal(columns(ob)[:, :2], before[:, :2])


def test_the_seams_of_all_mirrors_stay() -> None:
    ob = half()
    for vertex in ob.data.vertices:
        vertex.co.y += 1.0
    ob.modifiers.new("Front", 'MIRROR').use_axis = (False, True, False)
    seen(UNEVEN)
    scenes.edit(ob)
    bpy.ops.mesh.select_all(action='SELECT')
    before = columns(ob)
    assert scenes.smooth(border='free', length=0.5) == {'FINISHED'}
    after = columns(ob)
    assert np.abs(after - before).max() > 5e-4
    assert np.array_equal(after[:, 0], before[:, 0]) and np.array_equal(after[0], before[0])


@pytest.mark.parametrize("transform", ["none", "moved", "turned"])
@pytest.mark.parametrize("light", EVEN)
def test_mirror_x_keeps_every_bit_symmetric(transform, light) -> None:
    ob = scenes.panel(height=dented, cells=CELLS)
    mesh = ob.data
    matrix = scenes.TRANSFORMS[transform]
    ob.matrix_world = matrix
    axes = np.array(matrix)[:3, :3]
    bpy.ops.reflines.set_up(part='CAMERA', direction=axes @ (0.0, 0.0, 1.0))
    bpy.ops.reflines.set_up(part='LIGHT', direction=axes @ light)
    mesh.use_mirror_x = True
    scenes.edit_inner(ob, CELLS)
    before = scenes.positions(ob)
    for tool in (lambda: scenes.smooth(length=0.5), lambda: bpy.ops.reflines.direction(density=1.2, border='free')):
        assert tool() == {'FINISHED'}
        after = scenes.positions(ob).reshape(CELLS + 1, CELLS + 1, 3)
        assert np.array_equal(after[:, ::-1] * np.array([-1.0, 1.0, 1.0], np.float32), after)
    assert np.abs(after.reshape(-1, 3) - before).max() > 5e-4
    assert "Mirror X" not in ob.reflection_lines.report.notes


def test_mirror_x_says_why_a_result_is_not_symmetric() -> None:
    ob = scenes.panel(height=dented, cells=CELLS)
    seen(UNEVEN)
    ob.data.use_mirror_x = True
    scenes.edit_inner(ob, CELLS)
    scenes.smooth(length=0.5)
    assert "view or light are not symmetric" in ob.reflection_lines.report.notes
    scenes.select_faces(ob, lambda face: face % CELLS < CELLS - 3)
    scenes.smooth(length=0.5)
    assert "have no mirror image in it" in ob.reflection_lines.report.notes


@pytest.mark.parametrize("tool", ["direction", "smooth"])
def test_solved_without_symmetry_the_middle_moves_along_the_view(tool) -> None:
    """The middle got its old x back: 0.017 beside the view for a move of 0.121."""
    ob = scenes.panel("Aslant")
    ob.data.use_mirror_x = True
    bpy.ops.reflines.set_up(part='CAMERA', direction=(0.25, 0.0, 1.0))
    bpy.ops.reflines.set_up(part='LIGHT', direction=(1.0, 0.2, 0.1))
    scenes.edit_inner(ob)
    before = scenes.positions(ob).astype(float)
    if tool == "direction":
        bpy.ops.reflines.direction(angle=0.3)
    else:
        scenes.smooth(length=0.3)
    move = scenes.positions(ob).astype(float) - before
    view = np.array([0.25, 0.0, 1.0]) / np.hypot(0.25, 1.0)
    beside = np.linalg.norm(move - np.outer(move @ view, view), axis=1)
    assert np.linalg.norm(move, axis=1)[before[:, 0] == 0.0].max() > 1e-4
    assert beside.max() < 1e-6


def test_a_cage_with_mirror_x_stays_symmetric() -> None:
    ob = scenes.panel(height=dented, cells=CELLS)
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    seen(UNEVEN)
    ob.data.use_mirror_x = True
    scenes.edit_inner(ob, CELLS)
    before = scenes.positions(ob)
    scenes.smooth(length=0.5)
    after = scenes.positions(ob).reshape(CELLS + 1, CELLS + 1, 3)
    assert np.array_equal(after[:, ::-1] * np.array([-1.0, 1.0, 1.0], np.float32), after)
    assert np.abs(after.reshape(-1, 3) - before).max() > 5e-4


def test_a_cage_below_mirror_keeps_its_seam_in_the_plane() -> None:
    ob = half()
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    ob.rotation_euler = (0.3, 0.0, 0.0)  # about the mirror's normal: moves along the view have parts in y and z
    seen((0.0, 0.9, 0.4))
    edit_half(ob)
    before = columns(ob)
    scenes.smooth(length=0.5)
    after = columns(ob)
    assert np.abs(after - before)[:, 0].max() > 1e-4
    assert not after[:, 0, 0].any()


@pytest.mark.parametrize("length", [0.0, 0.5])
def test_seen_from_the_side_a_cage_below_mirror_keeps_its_seam(length) -> None:
    """The view is not in the plane, so that a move along it would take the seam out of it."""
    ob = half()
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    bpy.ops.reflines.set_up(part='CAMERA', direction=(0.5, 0.0, 1.0))
    bpy.ops.reflines.set_up(part='LIGHT', direction=(0.0, 1.0, 0.1))
    edit_half(ob)
    before = columns(ob)
    assert scenes.smooth(length=length, border='free') == {'FINISHED'}
    assert np.abs(columns(ob) - before).max() > 1e-4
    assert np.array_equal(columns(ob)[:, 0], before[:, 0])


def test_lines_warped_on_one_side_are_warped_on_the_other() -> None:
    """The lattice lies over the half alone; its image follows the image of it."""
    ob = half()
    seen((0.0, 0.9, 0.4))
    edit_half(ob)
    bpy.ops.reflines.add_warp_lattice()
    bpy.context.scene.reflection_lines.warp.lattice.data.points[12].co_deform.x += 0.3
    bpy.ops.reflines.warp()
    report = ob.reflection_lines.report
    assert report.termination == "converged"
    assert report.residual_after < 0.7 * report.residual_before
