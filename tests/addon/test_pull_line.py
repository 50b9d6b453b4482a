"""Pull Line as an operator: handles from scripts and files, on cages, under mirrors, in shape keys, solved again."""
import json
import sys
from math import radians
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from keying import fresh, mirror_half, pull

UP = {"start": (0.1, 0.0, 0.0), "end": (0.1, 0.1, 0.0), "radius": 0.5, "pinned": [], "muted": False}


def text(*handles: dict) -> str:
    return json.dumps(handles)


@pytest.fixture
def panel() -> bpy.types.Object:
    return fresh()


def moved(ob: bpy.types.Object, before: np.ndarray) -> np.ndarray:
    return np.abs(scenes.positions(ob) - before).max(axis=1)


def reached(ob: bpy.types.Object) -> float:
    """The share of the target."""
    return 1.0 - ob.reflection_lines.report.residual_after / ob.reflection_lines.report.residual_before


def test_handles_at_rest_and_muted_ones_change_no_bit(panel) -> None:
    before = scenes.positions(panel)
    for handle in ({**UP, "end": UP["start"]}, {**UP, "muted": True}):
        assert pull(handle) == {'FINISHED'}
        assert scenes.positions(panel).tobytes() == before.tobytes()


def test_where_the_limit_holds_back_twice_of_it_is_offered_and_reaches_more(panel) -> None:
    assert pull(UP, limit=2e-3) == {'FINISHED'}
    report, run = panel.reflection_lines.report, panel.reflection_lines.run
    first = report.residual_after
    assert report.limited > 0 and abs(run.read_length("limit") - 2e-3) < 1e-9 and report.remedy == ""
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, limit=4e-3) == {'FINISHED'}
    assert report.residual_after < 0.9 * first and report.largest_move > 3e-3


def test_where_a_border_keeps_a_line_from_its_handle_a_free_one_is_offered(panel) -> None:
    strong = {"start": (0.1, 0.6, 0.0), "end": (0.1, 0.86, 0.0), "radius": 0.4, "pinned": [], "muted": False}
    assert pull(strong, limit=1.0) == {'FINISHED'}
    report = panel.reflection_lines.report
    assert "beside it" in report.notes and report.remedy == "free"
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, border=report.remedy) == {'FINISHED'}
    assert report.remedy == "clamped"  # the rim of the region bends now


def test_handles_are_kept_and_solved_again_after_saving(panel, tmp_path: Path) -> None:
    before = scenes.positions(panel)
    assert pull(UP, {**UP, "end": (0.1, -0.2, 0.0), "muted": True}) == {'FINISHED'}
    once, name = scenes.positions(panel), panel.name
    scenes.object_mode()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "pulled.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "pulled.blend"))
    ob = bpy.data.objects[name]
    kept, muted = ob.reflection_lines.handles.read(ob.data)
    assert kept.end == tuple(np.float32(UP["end"]).tolist()) and not kept.muted and muted.muted
    assert bpy.ops.reflines.resolve() == {'FINISHED'}
    assert np.abs(scenes.positions(ob) - once).max() < 1e-6 < np.abs(once - before).max()
    assert bpy.ops.reflines.delete_handles() == {'FINISHED'}
    assert not ob.reflection_lines.handles.text and not bpy.ops.reflines.delete_handles.poll()


def test_handles_of_another_topology_are_refused_in_words(panel) -> None:
    assert pull(UP) == {'FINISHED'}
    scenes.object_mode()
    panel.data.vertices.add(1)
    with pytest.raises(Exception, match="Delete Handles"):
        panel.reflection_lines.handles.read(panel.data)


BAD = ("[", "{}", "[1]", "[{}]", text({**UP, "radius": "x"}), text({**UP, "start": [0.0, 0.0]}),
       text({**UP, "end": [0.0, 0.0, 1e300]}), text({**UP, "end": [0.0, 0.0, float("nan")]}),
       text({**UP, "pinned": [UP["start"]] * 65}), text(*[UP] * 101), "[" * 100000)


@pytest.mark.parametrize("bad", BAD, ids=range(len(BAD)))
def test_texts_of_another_origin_are_refused(panel, bad: str) -> None:
    with scenes.refused(panel, "stored handles cannot be used"):
        bpy.ops.reflines.pull_line('EXEC_DEFAULT', handles=bad)
    stored = panel.reflection_lines.handles
    stored.text, stored.vertices, stored.faces = bad, len(panel.data.vertices), len(panel.data.polygons)
    with pytest.raises(Exception, match="stored handles cannot be used"):
        panel.reflection_lines.handles.read(panel.data)


@pytest.mark.parametrize(("handle", "words"), ((dict(UP, radius=1e-3), "covers 0 vertices"),
                                               (dict(UP, radius=-1.0), "covers 0|no radius"),
                                               (dict(UP, start=(5.0, 0.0, 0.0)), "off the region")))
def test_handles_that_cannot_be_met_are_refused(panel, handle: dict, words: str) -> None:
    with scenes.refused(panel, words):
        pull(dict(handle, end=handle["start"]))


def test_without_a_handle_the_tool_says_what_to_do(panel) -> None:
    with pytest.raises(RuntimeError, match="no line is pulled"):
        bpy.ops.reflines.pull_line('EXEC_DEFAULT')


def test_handles_that_force_lines_to_cross_are_named(panel) -> None:
    below = {**UP, "start": (0.1, -0.1, 0.0), "end": (0.1, 0.12, 0.0)}
    assert pull({**UP, "end": (0.1, -0.05, 0.0)}, below) == {'FINISHED'}
    assert "Handle 1 and Handle 2 force lines to cross" in panel.reflection_lines.report.notes


def read_theta(ob: bpy.types.Object) -> np.ndarray:
    """Theta of every face: #faces, the mean of its triangles."""
    scenes.positions(ob)
    ob.data.calc_loop_triangles()
    F = np.array([triangle.vertices for triangle in ob.data.loop_triangles])
    light = (np.sin(radians(70.0)), 0.0, np.cos(radians(70.0)))
    optimizer = sys.modules["reflection_lines.native"].reflines.ShapeOptimizer(
        scenes.world(ob), F, view_direction=(0.0, 0.0, 1.0), line_direction=light)
    return optimizer.theta().reshape(-1, 2).mean(axis=1)


def give_weights(ob: bpy.types.Object, weights: np.ndarray) -> None:
    """Gives an object in Edit Mode the vertex group Follow, and handles their fall-off by it."""
    scenes.object_mode()
    group = ob.vertex_groups.get("Follow") or ob.vertex_groups.new(name="Follow")
    for index, weight in enumerate(weights):
        group.add([index], float(weight), 'REPLACE')
    ob.reflection_lines.follow_group = "Follow"
    bpy.ops.object.mode_set(mode='EDIT')


@pytest.mark.parametrize("mode", ('EDIT', 'OBJECT'))
def test_lines_follow_where_a_vertex_group_lets_them(panel, mode: str) -> None:
    """Left of the handle its weight is 0: lines on these faces stay; right of it they follow."""
    before, shape, changes = read_theta(panel), scenes.positions(panel), []
    held = np.array([shape[list(face.vertices), 0].max() < -0.06 for face in panel.data.polygons])
    assert bpy.ops.reflines.smooth('EXEC_DEFAULT', True, strength=0.0) == {'FINISHED'}  # stores the region
    for weights in (np.ones(len(shape)), (shape[:, 0] > -0.06).astype(float)):
        give_weights(panel, weights)
        if mode == 'OBJECT':
            scenes.object_mode()
        assert pull(UP) == {'FINISHED'}
        assert reached(panel) > 0.97
        assert not panel.reflection_lines.report.notes
        changes.append(np.abs(read_theta(panel) - before)[held].max())
        if mode == 'OBJECT':
            bpy.ops.object.mode_set(mode='EDIT')
        restore(panel, shape)
    step = 2.0 * np.pi / bpy.context.scene.reflection_lines.stripes.count
    assert changes[1] < 0.02 * step < 0.2 * changes[0], changes


def test_a_group_of_1_changes_no_bit_and_one_that_is_missing_is_told(panel) -> None:
    shape = scenes.positions(panel)
    assert pull(UP) == {'FINISHED'}
    plain = scenes.positions(panel)
    restore(panel, shape)
    give_weights(panel, np.ones(len(shape)))
    assert pull(UP) == {'FINISHED'}
    assert scenes.positions(panel).tobytes() == plain.tobytes()
    panel.reflection_lines.follow_group = "Nobody"
    with scenes.refused(panel, "no vertex group Nobody: pick another one for the handles"):
        pull(UP)


@pytest.mark.parametrize("mirrored", ("no", "Mirror X", "modifier"))
def test_a_group_holds_lines_of_cages_and_of_mirror_images(panel, mirrored: str) -> None:
    """Weights of the cage's vertices are spread over its surface, and over both halves."""
    if mirrored == "modifier":
        mirror_half(panel)
    panel.data.use_mirror_x = mirrored == "Mirror X"
    if mirrored == "no":
        panel.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    bpy.context.scene.reflection_lines.light.rotation_euler = (np.pi / 2.0, 0.0, 0.0)
    bpy.context.view_layer.update()
    right = {**UP, "start": (0.6, 0.0, 0.0), "end": (0.66, 0.0, 0.0)}
    shape, moves = scenes.positions(panel), []
    low = shape[:, 1] < -0.12
    for weights in (np.ones(len(shape)), (~low).astype(float)):
        give_weights(panel, weights)
        assert pull(right) == {'FINISHED'}
        moves.append(np.abs(scenes.positions(panel) - shape)[low].max())
        restore(panel, shape)
    assert moves[1] < 0.3 * moves[0] and moves[0] > 1e-4, moves


def restore(ob: bpy.types.Object, shape: np.ndarray) -> None:
    scenes.object_mode()
    ob.data.vertices.foreach_set("co", shape.ravel())
    ob.data.update()
    bpy.ops.object.mode_set(mode='EDIT')


def test_mirror_x_pulls_both_halves_alike(panel) -> None:
    panel.data.use_mirror_x = True
    before = scenes.positions(panel)
    bpy.context.scene.reflection_lines.light.rotation_euler = (np.pi / 2.0, 0.0, 0.0)
    bpy.context.view_layer.update()
    assert pull({**UP, "start": (0.3, 0.1, 0.0), "end": (0.36, 0.1, 0.0)}) == {'FINISHED'}
    after = scenes.positions(panel).reshape(33, 33, 3)
    assert moved(panel, before).max() > 1e-4
    assert np.array_equal(after[:, :, 2], after[:, ::-1, 2])
    assert not panel.reflection_lines.report.notes, panel.reflection_lines.report.notes


def test_a_result_goes_into_a_shape_key(panel) -> None:
    before = scenes.positions(panel)
    assert pull(UP, result='SHAPE_KEY') == {'FINISHED'}
    keys = panel.data.shape_keys.key_blocks
    basis, result = (np.array([point.co for point in keys[name].data]) for name in ("Basis", "Reflection Lines"))
    assert np.array_equal(basis.astype(np.float32), before) and np.abs(result - basis).max() > 1e-3
