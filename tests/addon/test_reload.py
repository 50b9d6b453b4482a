"""What a solve leaves is there again after the file was saved and opened: settings, report, maps, Re-solve."""
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.state import solve_history


def reloaded(tmp_path: Path) -> bpy.types.Object:
    path = str(tmp_path / "panel.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    return bpy.data.objects["Panel"]


@pytest.fixture(params=['MESH', 'SHAPE_KEY'])
def panel(request) -> bpy.types.Object:
    ob = scenes.panel()
    scenes.look_from_above()
    ob.location = (3.0, 2.0, 1.0)
    scenes.edit_inner(ob)
    bpy.context.scene.reflection_lines.length = 0.5
    bpy.context.scene.reflection_lines.result = request.param
    scenes.smooth()
    return ob


def stored(ob: bpy.types.Object) -> dict[str, np.ndarray]:
    """What the maps show of the last solve."""
    last = solve_history.find_last_solve(ob.name_full)
    return {"deviation": np.linalg.norm(last.positions - last.patch.V, axis=1), "residual": last.residual}


@pytest.mark.parametrize("mode", ['OBJECT', 'EDIT'])
def test_maps_of_the_last_solve(panel, mode, tmp_path) -> None:
    expected = stored(panel)
    scenes.object_mode() if mode == 'OBJECT' else scenes.edit(panel)
    again = stored(reloaded(tmp_path))
    for name, values in expected.items():
        assert values.max() > 1e-4
        assert np.allclose(again[name], values, rtol=1e-4, atol=1e-6)


def test_report_and_settings(panel, tmp_path) -> None:
    headline = panel.reflection_lines.report.headline()
    again = reloaded(tmp_path)
    assert again.reflection_lines.report.headline() == headline
    assert bpy.context.scene.reflection_lines.length == 0.5


def test_resolve_begins_with_the_shape_before_the_run(panel, tmp_path) -> None:
    def resolved(ob: bpy.types.Object) -> np.ndarray:
        bpy.context.scene.reflection_lines.light.rotation_euler.y -= 0.3
        assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
        return scenes.positions(ob)

    scenes.object_mode()
    path = tmp_path / "first.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    expected = resolved(panel)
    bpy.ops.wm.open_mainfile(filepath=str(path))
    assert np.array_equal(resolved(bpy.data.objects["Panel"]), expected)


def test_another_object_may_have_got_the_name_of_a_solved_one(panel, tmp_path) -> None:
    scenes.object_mode()
    panel.name = "Door"
    bpy.context.collection.objects.link(bpy.data.objects.new("Panel", None))
    again = reloaded(tmp_path)
    assert again.type == 'EMPTY' and again.reflection_lines.last == ""


def link_the_saved_panel(path: Path) -> bpy.types.Object:
    with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
        wanted.objects = ["Panel"]
    bpy.context.collection.objects.link(wanted.objects[0])
    return wanted.objects[0]


def test_a_linked_object_of_the_same_name_has_its_own_last_solve(panel, tmp_path) -> None:
    scenes.object_mode()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"), copy=True)
    scenes.edit(panel)
    scenes.smooth(length=0.9)
    scenes.object_mode()
    expected = stored(panel)
    link_the_saved_panel(tmp_path / "library.blend")
    reloaded(tmp_path)
    own, linked = sorted((ob for ob in bpy.data.objects if ob.name == "Panel"), key=lambda ob: ob.library is not None)
    for name, values in stored(own).items():
        assert np.allclose(values, expected[name], rtol=1e-4, atol=1e-6)
    found = solve_history.find_last_solve(linked.name_full)
    assert len(found.positions) == 225
    assert np.abs(found.positions - solve_history.find_last_solve(own.name_full).positions).max() > 1e-5


def test_a_mesh_changed_since_has_no_last_solve(panel, tmp_path) -> None:
    scenes.object_mode()
    points = panel.data.vertices if panel.data.shape_keys is None else panel.active_shape_key.data
    points[140].co.z += 0.1
    again = reloaded(tmp_path)
    assert again.reflection_lines.last == ""
    assert solve_history.find_last_solve(again.name_full) is None
