"""Kept handles as values that can be keyed: read at each frame, and kept with their keys."""
import json
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from keying import LOW, UP, curves, fresh, kept, key, keyed, path, pull, resolved
from reflection_lines.blender import compat
from reflection_lines.model import line_handle

CURVE = ((-0.2, 0.07, 0.0), (0.1, 0.09375, 0.0), (0.4, 0.07, 0.0))


@pytest.fixture
def panel() -> bpy.types.Object:
    return fresh()


def test_what_is_fixed_is_text_and_what_can_be_keyed_is_a_property(panel) -> None:
    assert pull(UP, {**UP, "curve": CURVE, "muted": True}) == {'FINISHED'}
    stored = panel.reflection_lines.handles
    assert [set(each) for each in json.loads(stored.text)] == [{"number", "start", "pinned", "bends"}] * 2
    assert np.allclose(kept(panel).place, UP["end"], atol=1e-7) and kept(panel).radius == 0.5
    assert [each.muted for each in stored.kept] == [False, True]
    pulled, drawn = stored.read(panel.data)
    assert not pulled.curve and drawn.curve == line_handle.decode_points([list(point) for point in CURVE])


@pytest.mark.parametrize("result", ['MESH', 'SHAPE_KEY'])
def test_two_frames_have_the_shapes_of_two_handles_at_rest(panel, result) -> None:
    keyed(panel, result=result)
    shapes = [resolved(frame).tobytes() for frame in (1, 11, 1)]
    for handle, shape in zip((UP, LOW), shapes, strict=False):
        fresh()
        assert pull(handle, result=result) == {'FINISHED'}
        assert scenes.positions(bpy.context.view_layer.objects.active).tobytes() == shape
    assert shapes[0] == shapes[2] != shapes[1]


def test_radius_and_mute_can_be_keyed_and_the_place_be_driven(panel) -> None:
    assert pull(UP) == {'FINISHED'}
    scenes.object_mode()
    own = kept(panel)
    for frame, radius, muted in ((1, 0.5, False), (3, 0.25, False), (5, 0.25, True)):
        own.radius, own.muted = radius, muted
        own.keyframe_insert("radius", frame=frame)
        own.keyframe_insert("muted", frame=frame)
    driver = own.driver_add("place", 1).driver
    driver.expression = "0.0625 if frame == 3 else 0.09375"
    shapes = [resolved(frame) for frame in (1, 3, 5)]
    for handle, made in zip((UP, {**LOW, "radius": 0.25}, {**UP, "muted": True}), shapes, strict=True):
        ob = fresh()
        assert np.array_equal(scenes.positions(ob), made) == handle["muted"]
        assert pull(handle) == {'FINISHED'}
        assert np.array_equal(scenes.positions(ob), made)


def test_a_drawn_line_moves_as_a_whole_with_its_place(panel) -> None:
    assert pull({**UP, "curve": CURVE}) == {'FINISHED'}
    scenes.object_mode()
    stored = panel.reflection_lines.handles
    before, text = stored.read(panel.data)[0], stored.text
    kept(panel).place = np.add(before.end, (0.0, -0.03125, 0.0))
    moved = stored.read(panel.data)[0]
    ways = np.subtract(moved.curve, before.curve)
    assert np.ptp(ways, axis=0).max() < 1e-15 and abs(ways[0, 1] + 0.03125) < 1e-7
    assert moved.curve[1] == moved.end and moved.start == before.start
    shape = scenes.positions(panel)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert np.abs(scenes.positions(panel) - shape).max() > 1e-4
    assert stored.text == text  # nothing drifts


def test_a_pin_has_no_place(panel) -> None:
    pin = {**UP, "end": UP["start"], "pinned": [(-0.2, 0.0, 0.0), (0.2, 0.0, 0.0)]}
    assert pull(UP, pin) == {'FINISHED'}
    before = panel.reflection_lines.handles.read(panel.data)
    kept(panel, 1).place = (0.3, 0.3, 0.0)
    assert panel.reflection_lines.handles.read(panel.data) == before
    assert [each.name for each in panel.reflection_lines.handles.kept] == ["Handle 1", "Pin 2"]


def three(ob: bpy.types.Object) -> list[dict]:
    """Three handles side by side, each keyed at places of its own; returns them as they are kept."""
    handles = [{**UP, "start": (x, 0.0, 0.0), "end": (x, 0.03125, 0.0), "radius": 0.2} for x in (-0.5, 0.0, 0.5)]
    assert pull(*handles) == {'FINISHED'}
    scenes.object_mode()
    for index in range(3):
        for frame in (1, 11):
            key(ob, frame, (handles[index]["start"][0], 0.01 * (index + 1), 0.001 * frame), index)
        kept(ob, index).driver_add("radius").driver.expression = f"0.2{index}"
    bpy.context.scene.frame_set(1)
    return json.loads(line_handle.encode_handles(ob.reflection_lines.handles.read(ob.data)))


def heights(ob: bpy.types.Object) -> list[float]:
    """The keyed y of each handle, rounded."""
    found = curves(ob)
    return [round(found[path(index), 1][0], 6) for index in range(len(ob.reflection_lines.handles.kept))]


def drivers(ob: bpy.types.Object) -> list[tuple[str, str]]:
    return sorted((each.data_path, each.driver.expression) for each in ob.animation_data.drivers)


def test_keys_stay_with_their_handles_where_another_is_deleted(panel, capfd) -> None:
    handles = three(panel)
    assert heights(panel) == [0.01, 0.02, 0.03]
    assert pull(*handles[1:]) == {'FINISHED'}
    assert heights(panel) == [0.02, 0.03] and len(curves(panel)) == 6
    assert drivers(panel) == [(path(0, "radius"), "0.21"), (path(1, "radius"), "0.22")]
    assert "The keys of handle 1 were removed with it" in panel.reflection_lines.report.notes
    assert pull(handles[2], UP, handles[1]) == {'FINISHED'}  # another order, and a new one between
    assert path(1) not in {name for name, _ in curves(panel)}
    assert [round(curves(panel)[path(index), 1][0], 6) for index in (0, 2)] == [0.03, 0.02]
    bpy.context.scene.frame_set(11)
    assert abs(kept(panel, 0).place[1] - 0.03) < 1e-7 and abs(kept(panel, 2).place[1] - 0.02) < 1e-7


def test_one_handle_is_deleted_with_its_keys_and_undo_brings_both_back(panel) -> None:
    three(panel)
    name = panel.name
    bpy.ops.ed.undo_push(message="three")
    assert bpy.ops.reflines.delete_handles('EXEC_DEFAULT', True, index=1) == {'FINISHED'}
    assert heights(panel) == [0.01, 0.03] and len(panel.reflection_lines.handles.read(panel.data)) == 2
    bpy.ops.ed.undo()
    assert heights(bpy.data.objects[name]) == [0.01, 0.02, 0.03]
    assert bpy.ops.reflines.delete_handles('EXEC_DEFAULT', True) == {'FINISHED'}
    ob = bpy.data.objects[name]
    assert not curves(ob) and not drivers(ob) and not ob.reflection_lines.handles.kept


def test_keys_in_the_nonlinear_animation_stay_with_their_handles(panel) -> None:
    handles = three(panel)
    data = panel.animation_data
    action, slot = data.action, getattr(data, "action_slot", None)
    strip = data.nla_tracks.new().strips.new("Strip", 1, action)
    if slot is not None and bpy.app.version >= (4, 4, 0):
        strip.action_slot = slot
    data.action = None
    assert pull(*handles[1:]) == {'FINISHED'}
    found = compat.find_action_curves(strip)
    assert {(each.data_path, round(each.keyframe_points[0].co.y, 6)) for each in found if each.array_index == 1} == {
        (path(0), 0.02), (path(1), 0.03)}


def test_an_action_of_two_objects_is_left_as_it_is_and_that_is_said(panel) -> None:
    handles = three(panel)
    other = bpy.data.objects.new("Other", None)
    bpy.context.collection.objects.link(other)
    other.animation_data_create().action = panel.animation_data.action
    if bpy.app.version >= (4, 4, 0):
        other.animation_data.action_slot = panel.animation_data.action_slot
    before = curves(panel)
    assert pull(*handles[1:]) == {'FINISHED'}
    assert curves(panel) == before
    assert "act on other handles now, since that action animates Other too" in panel.reflection_lines.report.notes


OLD = {**UP, "end": [0.1, 0.0625, 0.0], "curve": [list(point) for point in CURVE], "muted": True}


def write_old(ob: bpy.types.Object, *handles: dict) -> None:
    """What a file of before has: all in the text."""
    stored = ob.reflection_lines.handles
    stored.kept.clear()
    stored.text = json.dumps(handles)


def test_handles_of_a_file_of_before_are_read_and_can_be_keyed(panel, tmp_path: Path) -> None:
    assert pull(LOW) == {'FINISHED'}
    pulled, name = scenes.positions(panel), panel.name
    scenes.object_mode()
    write_old(panel, {name: LOW[name] for name in ("start", "end", "radius", "pinned", "muted")}, OLD)
    read = panel.reflection_lines.handles.read(panel.data)
    assert [each.muted for each in read] == [False, True] and read[1].curve[0] == tuple(np.float32(CURVE[0]).tolist())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "old.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "old.blend"))
    ob = bpy.data.objects[name]
    assert np.allclose(kept(ob).place, LOW["end"]) and kept(ob, 1).muted
    again = ob.reflection_lines.handles.read(ob.data)
    assert [(each.start, each.end, each.radius, each.curve) for each in again] == [
        (each.start, each.end, each.radius, each.curve) for each in read]
    key(ob, 1, UP["end"])
    key(ob, 11, LOW["end"])
    assert np.abs(resolved(11) - pulled).max() < 1e-6 < np.abs(resolved(1) - pulled).max()


def test_re_solve_of_handles_of_before_lets_them_be_keyed(panel) -> None:
    assert pull(LOW) == {'FINISHED'}
    scenes.object_mode()
    pulled = scenes.positions(panel).tobytes()
    write_old(panel, LOW)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert scenes.positions(panel).tobytes() == pulled and np.allclose(kept(panel).place, LOW["end"])


def test_auto_keying_keys_what_pull_line_changes_of_keyed_values(panel) -> None:
    keyed(panel)
    handle = json.loads(line_handle.encode_handles(panel.reflection_lines.handles.read(panel.data)))[0]
    for auto, keys in ((False, 2), (True, 3)):
        bpy.context.scene.tool_settings.use_keyframe_insert_auto = auto
        bpy.context.scene.frame_set(5)
        assert pull({**handle, "end": (0.1, 0.03125, 0.0), "radius": 0.4}) == {'FINISHED'}
        assert {name for name, _ in curves(panel)} == {path(0)}
        assert len(curves(panel)[path(0), 1]) == keys
    bpy.context.scene.frame_set(1)
    bpy.context.scene.frame_set(5)
    assert kept(panel).place[1] == 0.03125


def test_keys_survive_saving(panel, tmp_path: Path) -> None:
    keyed(panel)
    shapes, name = [resolved(frame) for frame in (1, 6)], panel.name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "keyed.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "keyed.blend"))
    scenes.activate(bpy.data.objects[name])
    assert all(np.abs(resolved(frame) - shape).max() < 1e-6 for frame, shape in zip((1, 6), shapes, strict=True))


@pytest.mark.parametrize("change", ["text", "count", "place", "far", "number"])
def test_values_of_another_origin_are_refused(panel, change: str) -> None:
    assert pull(UP) == {'FINISHED'}
    scenes.object_mode()
    stored = panel.reflection_lines.handles
    if change == "text":
        stored.text = json.dumps([UP])
    elif change == "count":
        stored.kept.add()
    elif change == "number":
        stored.text = stored.text.replace('"number": 1', '"number": -1')
    else:
        kept(panel).place[0] = float("nan") if change == "place" else 3e38
    with scenes.refused(panel, "stored handles cannot be used"):
        bpy.ops.reflines.resolve('EXEC_DEFAULT', True)
    assert bpy.ops.reflines.delete_handles() == {'FINISHED'} and not stored.kept
