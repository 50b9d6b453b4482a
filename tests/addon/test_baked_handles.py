"""Bake Handles: a shape key a frame, which has the shape of Re-solve there, and what it refuses."""
import bpy
import numpy as np
import pytest

import scenes
from keying import LOW, UP, fresh, kept, key, keyed, mirror_half, pull, resolved
from reflection_lines.blender import compat

KEY, FRAME = "Reflection Lines", "Reflection Lines Frame"


@pytest.fixture
def panel() -> bpy.types.Object:
    return fresh()


def bake(**settings: object) -> set[str]:
    return bpy.ops.reflines.bake_handles('EXEC_DEFAULT', True, **settings)


def played(ob: bpy.types.Object, frame: float) -> np.ndarray:
    """What is seen in a frame, of the mesh without its modifiers."""
    shown = [(each, each.show_viewport) for each in ob.modifiers]
    for each, _ in shown:
        each.show_viewport = False
    bpy.context.scene.frame_set(int(frame), subframe=frame % 1.0)
    seen = ob.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    result = np.array([vertex.co for vertex in seen.vertices], dtype=np.float32)
    for each, on in shown:
        each.show_viewport = on
    return result


def find_baked(ob: bpy.types.Object) -> list[str]:
    return [each.name for each in ob.data.shape_keys.key_blocks if each.name.startswith(FRAME)]


@pytest.mark.parametrize("result", ['MESH', 'SHAPE_KEY'])
def test_a_bake_has_in_each_frame_the_shape_of_re_solve_and_runs_evenly_between(panel, result) -> None:
    keyed(panel, result=result)
    shapes = {frame: resolved(frame) for frame in (1, 5, 9, 11)}
    bpy.context.scene.frame_set(7, subframe=0.25)
    before = scenes.positions(panel).tobytes()
    assert bake(step=4) == {'FINISHED'}
    assert find_baked(panel) == [f"{FRAME} {frame}" for frame in (1, 5, 9, 11)]
    assert (bpy.context.scene.frame_current, bpy.context.scene.frame_subframe) == (7, 0.25)
    assert scenes.positions(panel).tobytes() == before and panel.active_shape_key.name in ("Basis", KEY)
    for frame, shape in shapes.items():
        assert np.abs(played(panel, frame) - shape).max() < 2e-7
    assert np.abs(played(panel, 1) - shapes[11]).max() > 1e-4
    for frame, share in ((2, 0.25), (3.5, 0.625)):
        wanted = (1.0 - share) * shapes[1] + share * shapes[5]
        assert np.abs(played(panel, frame) - wanted).max() < 3e-7
    assert np.abs(played(panel, -5) - shapes[1]).max() < 2e-7 > np.abs(played(panel, 50) - shapes[11]).max()


def test_a_bake_with_the_lights_of_the_set_has_the_shapes_of_re_solve(panel) -> None:
    """They keep the crossed lines, as with crossed lights."""
    bpy.context.scene.reflection_lines.lights = 'SET'
    keyed(panel)
    shape = resolved(5)
    assert bake(step=4) == {'FINISHED'}
    assert np.abs(played(panel, 5) - shape).max() < 2e-7


@pytest.mark.parametrize("kind", ("cage", "mirror", "Mirror X"))
def test_cages_and_mirrored_panels_are_baked(panel, kind: str) -> None:
    x = 0.6
    if kind == "cage":
        panel.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    if kind == "mirror":
        mirror_half(panel)
    panel.data.use_mirror_x = kind == "Mirror X"
    bpy.context.scene.reflection_lines.light.rotation_euler = (np.pi / 2.0, 0.0, 0.0)
    bpy.context.view_layer.update()
    assert pull({**UP, "start": (x, 0.0, 0.0), "end": (x + 0.0625, 0.0, 0.0)}) == {'FINISHED'}
    scenes.object_mode()
    key(panel, 1, (x + 0.0625, 0.0, 0.0))
    key(panel, 7, (x + 0.03125, 0.0, 0.0))
    shapes = {frame: resolved(frame) for frame in (1, 6, 7)}
    assert bake() == {'FINISHED'}
    for frame, shape in shapes.items():
        assert np.abs(played(panel, frame) - shape).max() < 3e-7
    assert np.abs(shapes[1] - shapes[7]).max() > 1e-4


def test_baking_again_replaces_its_own_keys_and_leaves_the_others(panel) -> None:
    keyed(panel, result='SHAPE_KEY')
    wide = panel.shape_key_add(name="Wide", from_mix=False)
    wide.value = 0.5
    wide.keyframe_insert("value", frame=3)
    wide.data.foreach_set("co", (1.01 * scenes.positions(panel)).ravel())
    shape = np.array([point.co for point in wide.data]).tobytes()
    assert bake(step=2) == {'FINISHED'}
    panel.data.shape_keys.key_blocks[f"{FRAME} 3"].name = "Mine"
    key(panel, 13, UP["end"])
    assert bake(step=6) == {'FINISHED'}
    blocks = panel.data.shape_keys.key_blocks
    assert [each.name for each in blocks] == ["Basis", KEY, "Wide", "Mine",
                                              *(f"{FRAME} {frame}" for frame in (1, 7, 11, 13))]
    assert blocks[KEY].mute and not blocks["Wide"].mute
    assert np.array([point.co for point in blocks["Wide"].data]).tobytes() == shape
    found = compat.find_action_curves(panel.data.shape_keys.animation_data)
    assert {each.data_path.split('"')[1] for each in found} == {"Wide", "Mine", *find_baked(panel)}
    own = [each for each in found if FRAME in each.data_path]
    assert all(point.interpolation == 'LINEAR' for each in own for point in each.keyframe_points)


def test_a_bake_is_one_undo_step_and_can_follow_in_edit_mode(panel) -> None:
    keyed(panel)
    bpy.context.scene.frame_set(1)
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.ed.undo_push(message="before")
    before, name = scenes.fingerprint(panel), panel.name
    assert bake() == {'FINISHED'} and panel.mode == 'OBJECT' and len(find_baked(panel)) == 3
    bpy.ops.ed.undo()
    ob = bpy.data.objects[name]
    assert ob.data.shape_keys is None and ob.mode == 'EDIT' and scenes.fingerprint(ob) == before


def test_results_behind_baked_keys_say_so_and_the_start_is_still_known(panel) -> None:
    keyed(panel)
    assert bake(step=10) == {'FINISHED'}
    shape = played(panel, 11)
    assert np.array_equal(resolved(11), resolved(11))
    assert "Nothing of the result is seen, since the shape keys" in panel.reflection_lines.report.notes
    assert bake(step=10) == {'FINISHED'}
    assert np.abs(played(panel, 11) - shape).max() < 2e-7


def test_fractions_of_frames_drivers_and_a_range_of_ones_own(panel) -> None:
    keyed(panel)
    key(panel, 4.5, LOW["end"])
    scene = bpy.context.scene
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 3, 6
    assert bake() == {'FINISHED'}
    scene.use_preview_range = False
    assert find_baked(panel) == [f"{FRAME} {frame}" for frame in ("3", "4.5", "6")]
    fresh()
    ob = bpy.context.view_layer.objects.active
    assert pull(UP) == {'FINISHED'}
    kept(ob).driver_add("place", 1).driver.expression = "0.001 * frame"
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 11
    assert bake(step=10) == {'FINISHED'} and len(find_baked(ob)) == 2


def test_a_bake_that_is_refused_at_once_leaves_changes_without_a_key(panel) -> None:
    assert pull(UP) == {'FINISHED'}
    door = bpy.data.objects.new("Door", None)
    bpy.context.collection.objects.link(door)
    door.keyframe_insert("location", frame=1)
    door.location.x = 5.0
    with pytest.raises(RuntimeError, match="key the place of a handle first"):
        bake()
    assert door.location.x == 5.0


def test_what_cannot_be_baked_is_refused_and_changes_no_bit(panel) -> None:
    assert not bpy.ops.reflines.bake_handles.poll()
    assert pull(UP) == {'FINISHED'}
    before = scenes.fingerprint(panel)
    with pytest.raises(RuntimeError, match="key the place of a handle first"):
        bake()
    assert scenes.fingerprint(panel) == before
    scenes.object_mode()
    key(panel, 1, UP["end"])
    key(panel, 5, (5.0, 0.0, 0.0))
    bpy.context.scene.frame_set(1)
    before = scenes.fingerprint(panel)
    with pytest.raises(RuntimeError, match="Frame 5: .*"):
        bake(step=4)
    assert scenes.fingerprint(panel) == before and bpy.context.scene.frame_current == 1
    with pytest.raises(RuntimeError, match="more than 1000 frames"):
        bpy.context.scene.use_preview_range, bpy.context.scene.frame_preview_end = True, 2000
        bake(step=1)
    bpy.ops.reflines.smooth('EXEC_DEFAULT', True)
    with pytest.raises(RuntimeError, match="shape before its handles is not known"):
        bake()
    panel.reflection_lines.handles.kept.add()
    with pytest.raises(RuntimeError, match="stored handles cannot be used"):
        bake()
    panel.data.vertices.add(1)
    with pytest.raises(RuntimeError, match="Delete Handles"):
        bake()
    assert panel.data.shape_keys is None
