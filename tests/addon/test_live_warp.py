"""A live warp by its buttons: Apply makes what Warp makes, Discard takes back every bit, and both survive the file.

How the panel follows while the lattice is edited is a matter of the window: tests/ui/test_live_warp.py.
"""
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes


@pytest.fixture
def panel() -> bpy.types.Object:
    ob = scenes.edited_panel()
    bpy.ops.reflines.add_warp_lattice()
    scenes.object_mode()
    return ob


def start() -> None:
    assert bpy.ops.reflines.live_warp('EXEC_DEFAULT', True) == {'FINISHED'}


def end(how: str) -> None:
    assert bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action=how.upper()) == {'FINISHED'}


def pull(by: float = 0.2) -> None:
    lattice = bpy.context.scene.reflection_lines.warp.lattice.data
    lattice.points[12].co_deform.x += by
    lattice.update_tag()
    bpy.context.view_layer.update()


def warped() -> np.ndarray:
    """What Warp makes of a panel like the fixture's, and then its shape from before."""
    ob = scenes.panel("Other")
    scenes.edit_inner(ob)
    bpy.ops.reflines.warp()
    scenes.object_mode()
    shape = scenes.positions(ob)
    bpy.data.objects.remove(ob)
    return shape


@pytest.mark.parametrize("lights", ['CROSSED', 'SET'])
def test_apply_makes_what_warp_makes(panel, lights) -> None:
    bpy.context.scene.reflection_lines.lights = lights
    bpy.ops.reflines.light_set(action='WALK')
    start()
    pull()
    end("apply")
    assert panel.reflection_lines.report.termination == "converged"
    assert bpy.context.scene.reflection_lines.live.panel is None
    assert np.array_equal(scenes.positions(panel), warped())


def test_discard_leaves_no_trace(panel) -> None:
    before, own = scenes.fingerprint(panel), set(panel.data.keys())
    start()
    pull()
    end("discard")
    assert scenes.fingerprint(panel) == before
    assert set(panel.data.keys()) == own


@pytest.mark.parametrize("how", ["apply", "discard"])
def test_one_undo_takes_the_end_back(panel, how) -> None:
    before = scenes.positions(panel)
    start()
    pull()
    bpy.ops.ed.undo_push(message="pull")
    end(how)
    after = scenes.positions(bpy.data.objects["Panel"])
    assert np.array_equal(after, before) == (how == "discard")
    bpy.ops.ed.undo()
    live = bpy.context.scene.reflection_lines.live
    assert live.panel == bpy.data.objects["Panel"]
    end(how)
    assert np.array_equal(scenes.positions(bpy.data.objects["Panel"]), after)


@pytest.mark.parametrize("how", ["apply", "discard"])
def test_both_ends_work_after_reload(panel, how, tmp_path: Path) -> None:
    before = scenes.fingerprint(panel)
    start()
    pull()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "live.blend"))
    end("apply")
    expected = scenes.positions(panel)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "live.blend"))
    end(how)
    again = bpy.data.objects["Panel"]
    if how == "discard":
        assert scenes.fingerprint(again) == before
    assert np.array_equal(scenes.positions(again), expected) == (how == "apply")


@pytest.mark.parametrize("which", ["panel", "lattice"])
def test_start_from_an_edit_mode_is_one_undo_step(panel, which) -> None:
    lattice = bpy.context.scene.reflection_lines.warp.lattice
    bpy.ops.ed.undo_push(message="start")
    panel.select_set(which == "panel")
    scenes.edit({"panel": panel, "lattice": lattice}[which])
    bpy.ops.ed.undo_push(message="edit")
    start()
    assert panel.mode == lattice.mode == 'OBJECT' and bpy.context.view_layer.objects.active == lattice
    bpy.ops.ed.undo()
    assert bpy.context.scene.reflection_lines.live.panel is None
    assert not set(bpy.data.objects["Panel"].data.keys())


@pytest.mark.parametrize("mode", ['EDIT', 'OBJECT'])
def test_shape_keys_ask_for_the_result_shape_key(panel, mode) -> None:
    panel.shape_key_add(name="Basis")
    if mode == 'EDIT':
        scenes.edit_inner(panel)
    before = scenes.fingerprint(panel)
    with pytest.raises(RuntimeError, match="has shape keys, .*: choose the result Shape Key$"):
        start()
    assert scenes.fingerprint(panel) == before and panel.mode == mode
    bpy.context.scene.reflection_lines.result = 'SHAPE_KEY'
    start()


def test_a_lattice_that_folds_over_is_not_applied(panel) -> None:
    start()
    pull(3.0)
    with scenes.refused(panel, "The lattice folds over itself"):
        end("apply")
    end("discard")


def test_a_refusal_on_a_hidden_panel_is_a_sentence(panel) -> None:
    """Of a hidden object Blender sets no mode."""
    scenes.edit_inner(panel)
    scenes.smooth()
    scenes.object_mode()
    bpy.context.scene.reflection_lines.warp.lattice = None
    panel.hide_viewport = True
    scenes.activate(panel)
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match="^Error: There is no warp lattice"):
        start()
    assert panel.mode == 'OBJECT'


def test_other_tools_wait_for_the_end(panel) -> None:
    start()
    scenes.activate(panel)
    with pytest.raises(RuntimeError, match="apply or discard the live warp first"):
        scenes.smooth()
    with pytest.raises(RuntimeError, match="already follows its lattice"):
        start()
    end("discard")
    assert scenes.smooth() == {'FINISHED'}


@pytest.mark.parametrize("how", ["apply", "discard"])
def test_faces_added_meanwhile_are_told_and_stay(panel, how, capfd) -> None:
    start()
    vertices, faces = len(panel.data.vertices), len(panel.data.polygons)
    panel.select_set(True)
    scenes.edit(panel)
    scenes.select_faces(panel, lambda face: face == 100)
    bpy.ops.mesh.subdivide()
    scenes.object_mode()
    subdivided = scenes.positions(panel)
    end(how)
    assert np.array_equal(scenes.positions(panel), subdivided)
    vertices, faces = len(panel.data.vertices) - vertices, len(panel.data.polygons) - faces
    assert f"Panel has other vertices (+{vertices}) and faces (+{faces})" in capfd.readouterr().out


def test_a_panel_changed_by_hand_is_kept_by_apply_and_taken_back_by_discard(panel) -> None:
    before = scenes.positions(panel)
    start()
    panel.data.vertices[140].co.z += 0.1
    changed = scenes.positions(panel)
    bpy.ops.ed.undo_push(message="change")
    end("apply")
    assert np.array_equal(scenes.positions(panel), changed)
    bpy.ops.ed.undo()
    end("discard")
    assert np.array_equal(scenes.positions(bpy.data.objects["Panel"]), before)


@pytest.mark.parametrize("how", ["apply", "discard"])
def test_a_deleted_lattice_leaves_both_ways_out(panel, how, capfd) -> None:
    before = scenes.positions(panel)
    start()
    bpy.data.objects.remove(bpy.context.scene.reflection_lines.warp.lattice)
    end(how)
    assert np.array_equal(scenes.positions(panel), before)  # the background has no thread that followed
    assert ("The warp lattice of Panel is no longer" in capfd.readouterr().out) == (how == "apply")


@pytest.mark.parametrize("how", ["apply", "discard"])
def test_a_deleted_panel_ends_the_live_warp_and_comes_back_with_undo(panel, how) -> None:
    start()
    scenes.activate(panel)
    bpy.context.scene.reflection_lines.warp.lattice.select_set(False)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.object.delete('EXEC_DEFAULT', True)
    end(how)
    assert bpy.context.scene.reflection_lines.live.panel is None
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    assert bpy.context.scene.reflection_lines.live.panel == bpy.data.objects["Panel"]
    end("discard")
