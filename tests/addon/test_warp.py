"""The warp lattice: its map against Blender's own modifier, and lines that follow it."""
import bpy
import numpy as np
import pytest
from reflection_lines.model.same import are_same
from reflection_lines.write import warp_lattice
from reflection_lines.targets import warp

import scenes

KINDS = ('KEY_LINEAR', 'KEY_CARDINAL', 'KEY_CATMULL_ROM', 'KEY_BSPLINE')


def added(panel: bpy.types.Object, **options: object) -> bpy.types.Object:
    bpy.ops.reflines.add_warp_lattice(**options)
    bpy.context.view_layer.update()
    return bpy.context.scene.reflection_lines.warp.lattice


def disturb(ob: bpy.types.Object, size: float) -> None:
    moves = np.random.default_rng(3).uniform(-size, size, (len(ob.data.points), 2))
    for point, (x, y) in zip(ob.data.points, moves, strict=True):
        point.co_deform.x += x
        point.co_deform.y += y
    ob.data.update_tag()


def deformed_by_modifier(ob: bpy.types.Object, world: np.ndarray) -> np.ndarray:
    """Where Blender's Lattice modifier takes points of world space."""
    probe = scenes.linked("Probe", world.tolist(), [])
    probe.modifiers.new("Lattice", 'LATTICE').object = ob
    mesh = probe.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    return np.array([vertex.co for vertex in mesh.vertices])


@pytest.mark.parametrize(("columns", "rows"), [(2, 2), (5, 7)])
def test_the_lattice_covers_the_region_in_the_picture(panel, columns, rows) -> None:
    ob = added(panel, columns=columns, rows=rows)
    points = np.array([ob.matrix_world @ point.co_deform for point in ob.data.points])
    assert np.allclose(np.ptp(points, axis=0), (1.75, 1.75, 0.0), atol=1e-6)
    assert np.allclose(points.mean(axis=0)[:2], 0.0, atol=1e-6)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("columns", "rows"), [(4, 3), (2, 5)])
def test_the_map_is_that_of_blenders_modifier(panel, kind, columns, rows) -> None:
    ob = added(panel, columns=columns, rows=rows, interpolation=kind)
    scenes.object_mode()
    disturb(ob, 0.3)
    matrix = np.array(ob.matrix_world)
    local = np.random.default_rng(5).uniform(-0.7, 0.7, (200, 2)) * (columns, rows)  # beyond the lattice too
    world = np.column_stack([local, np.zeros(200), np.ones(200)]) @ matrix.T
    ours = world[:, :3] + warp.evaluate_moves(warp_lattice.read_lattice(ob), local) @ matrix[:3, :3].T
    assert np.abs(ours - deformed_by_modifier(ob, world[:, :3])).max() < 1e-6


@pytest.mark.parametrize(("columns", "rows"), [(5, 5), (4, 3), (2, 7)])
def test_the_lattice_is_the_same_in_its_edit_mode(panel, columns, rows) -> None:
    ob = added(panel, columns=columns, rows=rows)
    scenes.object_mode()
    disturb(ob, 0.3)
    outside = warp_lattice.read_lattice(ob)
    assert np.allclose(outside.low, ob.data.points[0].co) and np.allclose(outside.high, ob.data.points[-1].co)
    scenes.edit(ob)
    assert are_same(warp_lattice.read_lattice(ob), outside)


@pytest.mark.parametrize("kind", KINDS)
def test_an_untouched_lattice_moves_nothing_bit_for_bit(panel, kind) -> None:
    before = scenes.positions(panel)
    added(panel, columns=5, rows=4, interpolation=kind)
    bpy.ops.reflines.warp()
    assert np.array_equal(scenes.positions(panel), before)
    assert panel.reflection_lines.report.termination == "already_optimal"


@pytest.mark.parametrize("fit", ['GRADIENT', 'VALUE'])
def test_lines_follow_the_lattice(panel, fit) -> None:
    scenes.smooth(length=2.0)
    ob = added(panel, columns=7, rows=7)
    ob.data.points[24].co_deform.x += 0.2
    before = scenes.positions(panel)
    bpy.ops.reflines.warp(fit=fit, border='free')  # a border that stays keeps lines near it
    report = panel.reflection_lines.report
    assert report.termination == "converged"
    assert report.residual_after < 0.5 * report.residual_before
    assert (scenes.positions(panel) != before).any()


def test_warp_from_the_lattice_in_object_mode(panel) -> None:
    ob = added(panel)
    scenes.object_mode()
    ob.data.points[12].co_deform.x += 0.2
    bpy.ops.ed.undo_push(message="start")
    before = scenes.positions(panel)
    panel.select_set(False)
    scenes.activate(ob)
    assert bpy.ops.reflines.warp('EXEC_DEFAULT', True) == {'FINISHED'}
    assert (scenes.positions(panel) != before).any()
    bpy.ops.ed.undo()
    assert np.array_equal(scenes.positions(bpy.data.objects["Panel"]), before)


def test_a_folded_lattice_is_refused_in_words(panel) -> None:
    ob = added(panel)
    ob.data.points[12].co_deform.x += 3.0
    with scenes.refused(panel, "The lattice folds over itself"):
        bpy.ops.reflines.warp()


def test_a_missing_lattice_is_refused(panel) -> None:
    with pytest.raises(RuntimeError, match="There is no warp lattice"):
        bpy.ops.reflines.warp()


def test_a_lattice_turned_by_the_artist_is_no_warp(panel) -> None:
    """Only control points warp; the object as a whole may be put anywhere."""
    before = scenes.positions(panel)
    ob = added(panel)
    ob.matrix_world = ob.matrix_world @ scenes.TRANSFORMS["turned"]
    bpy.ops.reflines.warp()
    assert np.array_equal(scenes.positions(panel), before)


def test_a_lattice_whose_panel_was_deleted_warps_nothing(panel) -> None:
    ob = added(panel)
    scenes.object_mode()
    panel.users_collection[0].objects.unlink(panel)
    scenes.activate(ob)
    with pytest.raises(RuntimeError, match="Make the panel's mesh the active object"):
        bpy.ops.reflines.warp()
