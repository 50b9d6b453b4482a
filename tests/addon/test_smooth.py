"""Smooth Reflection Lines, through the user's door."""
import bpy
import numpy as np
import pytest
from reflection_lines import native
from reflection_lines.state import optimizer_cache

import scenes

CELLS = 16


def region_arrays(ob: bpy.types.Object, cells: int, margin: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(indices, V, F) of the inner faces, with Blender's triangulation, made without the add-on's code."""
    ob.update_from_editmode()
    ob.data.calc_loop_triangles()
    inside = scenes.inner(cells, margin)
    corners = [list(t.vertices) for t in ob.data.loop_triangles if inside(t.polygon_index)]
    index, F = np.unique(np.array(corners), return_inverse=True)
    return index, scenes.world(ob)[index], F.reshape(-1, 3).astype(np.int32)


def solved(V: np.ndarray, F: np.ndarray, length: float, strength: float, border: str) -> np.ndarray:
    settings = bpy.context.scene.reflection_lines
    v, a = scenes.axis_z(settings.camera), scenes.axis_z(settings.light)
    optimizer = native.reflines.ShapeOptimizer(V, F, view_direction=v, line_direction=[a, np.cross(v, a)],
                                               border=border)
    optimizer.solve([native.reflines.smooth(optimizer, length=length, strength=strength, family=k) for k in (0, 1)])
    return optimizer.positions


@pytest.mark.parametrize(("length", "strength", "border"), [(0.5, 1.0, 'clamped'), (0.7, 0.5, 'fixed')])
def test_the_operator_equals_the_numpy_call(panel, length, strength, border) -> None:
    index, V, F = region_arrays(panel, CELLS)
    assert scenes.smooth(length=length, strength=strength, border=border) == {'FINISHED'}
    expected = solved(V, F, length, strength, border)
    assert np.abs(scenes.world(panel)[index] - expected).max() <= 2e-7  # one rounding to float32 of coordinates near 1
    assert np.abs(expected - V).max() > 5e-4


def test_lines_become_smoother_and_the_report_says_so(panel) -> None:
    scenes.smooth(length=1.0)
    report = panel.reflection_lines.report
    assert report.termination == "converged"
    assert report.score_after < 0.2 * report.score_before
    assert report.iterations > 0
    assert report.seconds > 0.0
    assert report.unknowns > 0


@pytest.mark.parametrize("mode", ['EDIT', 'OBJECT'])
def test_undo_gives_back_the_identical_mesh_and_redo_the_result(panel, mode) -> None:
    if mode == 'OBJECT':
        scenes.smooth(strength=0.0)
        scenes.object_mode()
    bpy.ops.ed.undo_push(message="start")
    before = scenes.fingerprint(panel)
    scenes.smooth()
    after = scenes.fingerprint(bpy.context.view_layer.objects.active)
    assert after != before
    bpy.ops.ed.undo()
    assert scenes.fingerprint(bpy.context.view_layer.objects.active) == before
    bpy.ops.ed.redo()
    assert scenes.fingerprint(bpy.context.view_layer.objects.active) == after


def test_a_strength_of_zero_changes_no_bit(panel) -> None:
    before = scenes.positions(panel)
    assert scenes.smooth(strength=0.0) == {'FINISHED'}
    assert np.array_equal(scenes.positions(panel), before)


def test_settings_are_the_scenes_unless_given(panel) -> None:
    settings = bpy.context.scene.reflection_lines
    settings.length, settings.strength, settings.border = 0.4, 0.6, 'fixed'
    before = scenes.positions(panel)
    bpy.ops.ed.undo_push(message="start")
    scenes.smooth()
    from_scene = scenes.positions(panel)
    bpy.ops.ed.undo()
    panel = bpy.context.view_layer.objects.active
    assert np.array_equal(scenes.positions(panel), before)
    scenes.smooth(length=0.4, strength=0.6, border='fixed')
    assert np.array_equal(scenes.positions(panel), from_scene)


def test_object_mode_takes_the_stored_region(panel) -> None:
    before = scenes.positions(panel)
    bpy.ops.ed.undo_push(message="start")
    scenes.smooth(strength=0.0)  # stores the region and moves nothing
    scenes.object_mode()
    assert np.array_equal(scenes.positions(panel), before)
    index, V, F = region_arrays(panel, CELLS)
    scenes.smooth(length=0.5, strength=1.0, border='clamped')
    assert np.abs(scenes.world(panel)[index] - solved(V, F, 0.5, 1.0, 'clamped')).max() <= 2e-7
    moved = (scenes.positions(panel) != before).any(axis=1)
    assert not np.delete(moved, index).any()


def test_object_mode_tells_which_faces_it_takes(panel, capfd) -> None:
    """Not those selected since."""
    scenes.smooth(strength=0.0)
    assert "faces kept" not in capfd.readouterr().out
    scenes.select_faces(panel, lambda face: face < 40)
    scenes.object_mode()
    scenes.smooth()
    assert f"(Panel, {(CELLS - 2) ** 2} faces kept as the region; in Edit Mode the selected" in capfd.readouterr().out


def test_the_stored_region_survives_saving(panel, tmp_path) -> None:
    scenes.smooth(strength=0.0)
    scenes.object_mode()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "panel.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "panel.blend"))
    panel = bpy.data.objects["Panel"]
    before = scenes.positions(panel)
    assert scenes.smooth() == {'FINISHED'}
    assert not np.array_equal(scenes.positions(panel), before)


def test_quads_and_ngons_stay() -> None:
    ob = scenes.panel(cells=CELLS)
    scenes.look_from_above()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face in (5 * CELLS + 5, 5 * CELLS + 6, 8 * CELLS + 8, 9 * CELLS + 8))
    bpy.ops.mesh.dissolve_faces()
    bpy.ops.mesh.select_all(action='SELECT')
    ob.update_from_editmode()
    before = [tuple(polygon.vertices) for polygon in ob.data.polygons]
    assert {len(corners) for corners in before} == {4, 6}
    scenes.smooth()
    ob.update_from_editmode()
    assert [tuple(polygon.vertices) for polygon in ob.data.polygons] == before


def test_a_perspective_camera_is_taken_at_the_panels_centre(panel) -> None:
    camera = bpy.context.scene.reflection_lines.camera
    camera.data.type = 'PERSP'
    camera.location = (1.0, 2.0, 8.0)
    before = scenes.world(panel)
    scenes.smooth()
    region = before[region_arrays(panel, CELLS)[0]]
    center = (region.min(axis=0) + region.max(axis=0)) / 2.0
    towards = np.array(camera.location) - center
    moves = scenes.world(panel) - before
    longest = moves[np.argmax(np.linalg.norm(moves, axis=1))]
    along = abs(longest @ towards) / np.linalg.norm(longest) / np.linalg.norm(towards)
    assert along == pytest.approx(1.0, abs=1e-6)


def smooth_another(name: str, *others: bpy.types.Object) -> bpy.types.Object:
    scenes.object_mode()
    for ob in bpy.context.selected_objects:
        ob.select_set(False)
    ob = scenes.panel(name, cells=CELLS)
    scenes.edit(ob, *others)
    for each in (ob, *others):
        scenes.select_faces(each, scenes.inner(CELLS))
    scenes.smooth(length=0.5)
    return ob


def test_few_optimizers_are_kept(panel) -> None:
    """Each holds the factors of a matrix: 75 MB for 20,000 vertices. An automatic press keeps none."""
    scenes.smooth(length=0.5)
    for number in range(4):
        smooth_another(f"Panel {number}")
        assert len(optimizer_cache._optimizers) == 2 and list(optimizer_cache._optimizers)[-1] == f"Panel {number}"


def test_the_optimizer_of_a_deleted_panel_goes(panel) -> None:
    scenes.smooth(length=0.5)
    scenes.object_mode()
    bpy.data.objects.remove(panel)
    scenes.edit_inner(scenes.panel("Other", cells=CELLS), CELLS)
    scenes.smooth(length=0.5)
    assert list(optimizer_cache._optimizers) == ["Other"]


def test_an_operation_over_several_panels_keeps_theirs(panel) -> None:
    """Repeated with other settings it factors nothing again."""
    scenes.smooth(length=0.5)
    others = [smooth_another(f"Panel {number}") for number in range(3)]
    smooth_another("Last", *others)
    assert set(optimizer_cache._optimizers) == {"Last", *(ob.name for ob in others)}
