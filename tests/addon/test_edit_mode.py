"""Several objects, shape keys and hidden faces do what a Blender user expects."""
import bmesh
import bpy
import numpy as np
import pytest

import scenes


def two_panels() -> tuple[bpy.types.Object, bpy.types.Object]:
    left, right = scenes.panel("Left"), scenes.panel("Right", lambda x, y: scenes.rippled(0.8 * x, y))
    right.location.x = 3.0
    scenes.look_from_above()
    scenes.edit(left, right)
    return left, right


def test_objects_without_selected_faces_are_left_alone() -> None:
    left, right = two_panels()
    scenes.select_faces(left, scenes.inner())
    scenes.select_faces(right, lambda _: False)
    before = scenes.fingerprint(right)
    scenes.smooth()
    assert scenes.fingerprint(right) == before
    assert not right.reflection_lines.report.termination


@pytest.mark.parametrize("length", [0.3, 0.0], ids=["a solve", "a press"])
def test_a_solve_is_all_or_nothing_and_a_press_leaves_what_it_cannot_solve(length: float) -> None:
    left, right = two_panels()
    scenes.select_faces(left, scenes.inner())
    scenes.select_faces(right, lambda face: face == 40)
    before = [scenes.fingerprint(ob) for ob in (left, right)]
    if length:
        with pytest.raises(RuntimeError, match="Right: No vertex of the region is free"):
            scenes.smooth(length=length)
    else:
        assert scenes.smooth() == {'FINISHED'}
    stayed = [scenes.fingerprint(ob) == was for ob, was in zip((left, right), before, strict=True)]
    assert stayed == [length > 0.0, True]


def test_one_undo_step_for_all() -> None:
    objects = two_panels()
    for ob in objects:
        scenes.select_faces(ob, scenes.inner())
    bpy.ops.ed.undo_push(message="start")
    before = [scenes.fingerprint(ob) for ob in objects]
    scenes.smooth()
    bpy.ops.ed.undo()
    assert [scenes.fingerprint(bpy.data.objects[name]) for name in ("Left", "Right")] == before


def test_a_result_that_was_undone_is_marked() -> None:
    """Undo in Edit Mode gives the mesh back, but not what the object's report was before."""
    shown = bpy.context.window_manager.reflection_lines
    ob = scenes.edited_panel()
    bpy.ops.ed.undo_push(message="start")
    for length in (0.5, 0.8):
        scenes.smooth(length=length)
        assert not shown.is_undone(ob)
        bpy.ops.ed.undo()
        ob = bpy.data.objects["Panel"]
        assert ob.mode == 'EDIT' and ob.reflection_lines.report.termination and shown.is_undone(ob)
    bpy.ops.ed.redo()
    assert not shown.is_undone(bpy.data.objects["Panel"])


def two_solved_panels() -> list[bpy.types.Object]:
    """In Object Mode, each with a region; the second is active."""
    objects = [scenes.panel("Left"), scenes.panel("Right")]
    scenes.look_from_above()
    scenes.edit(*objects)
    for ob in objects:
        scenes.select_faces(ob, scenes.inner())
    scenes.smooth(strength=0.0)
    scenes.object_mode()
    return objects


def test_a_script_may_override_the_active_object() -> None:
    left, right = two_solved_panels()
    scenes.activate(right)
    before = [scenes.fingerprint(ob) for ob in (left, right)]
    with bpy.context.temp_override(active_object=left, object=left, selected_objects=[left]):
        assert bpy.ops.reflines.smooth('EXEC_DEFAULT', True, length=0.5) == {'FINISHED'}
        assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}
        assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, border='free') == {'FINISHED'}
    assert scenes.fingerprint(left) != before[0] and scenes.fingerprint(right) == before[1]
    assert len(left.reflection_lines.check.rows) and not len(right.reflection_lines.check.rows)


def keyed_panel() -> bpy.types.Object:
    ob = scenes.panel()
    scenes.look_from_above()
    ob.shape_key_add(name="Basis")
    ob.shape_key_add(name="Bulge")
    bulge = ob.data.shape_keys.key_blocks["Bulge"]
    for point in bulge.data:
        point.co.z += 0.1 * (1.0 - point.co.x ** 2) + 0.003 * np.sin(11.0 * point.co.x)
    return ob


def key_positions(ob: bpy.types.Object, name: str) -> np.ndarray:
    return np.array([point.co for point in ob.data.shape_keys.key_blocks[name].data], dtype=np.float32)


def test_a_shape_key_is_solved_like_the_mesh_it_shows() -> None:
    ob = keyed_panel()
    basis, shown = key_positions(ob, "Basis"), key_positions(ob, "Bulge")
    ob.active_shape_key_index = 1
    scenes.edit_inner(ob)
    scenes.smooth(length=0.5)
    scenes.object_mode()
    plain = scenes.panel("Plain")
    plain.data.vertices.foreach_set("co", shown.ravel())
    bpy.data.objects["Panel"].select_set(False)
    scenes.edit_inner(plain)
    scenes.smooth(length=0.5)
    assert np.array_equal(scenes.positions(plain), key_positions(ob, "Bulge"))
    assert np.array_equal(key_positions(ob, "Basis"), basis)
    assert np.abs(key_positions(ob, "Bulge") - shown)[:, 2].max() > 1e-3
    assert np.array_equal(key_positions(ob, "Bulge")[:, :2], shown[:, :2])


def test_shape_keys_in_object_mode_are_refused() -> None:
    ob = keyed_panel()
    scenes.edit_inner(ob)
    scenes.smooth(strength=0.0)
    scenes.object_mode()
    with scenes.refused(ob, "Panel has shape keys: enter Edit Mode"):
        scenes.smooth()


def hide_a_block(ob: bpy.types.Object) -> np.ndarray:
    """Hides 3 x 3 faces in the middle; returns their vertices."""
    scenes.select_faces(ob, lambda face: all(6 <= k < 9 for k in divmod(face, 16)))
    hidden = [vertex.index for vertex in bmesh.from_edit_mesh(ob.data).verts if vertex.select]
    bpy.ops.mesh.hide(unselected=False)
    return np.array(hidden)


@pytest.mark.parametrize("stored", [False, True], ids=["before the press", "after the region was stored"])
def test_hidden_faces_are_no_part_of_the_region(stored: bool) -> None:
    ob = scenes.edited_panel(margin=0)
    if stored:
        scenes.smooth(strength=0.0)
    hidden = hide_a_block(ob)
    if stored:
        scenes.object_mode()
    else:
        bpy.ops.mesh.select_all(action='SELECT')
    before = scenes.positions(ob)
    scenes.smooth()
    moved = (scenes.positions(ob) != before).any(axis=1)
    assert moved.any() and not moved[hidden].any()


def undo_a_press_in_edit_mode() -> tuple[bpy.types.Object, np.ndarray]:
    """Returns the panel and the positions that the press gave."""
    ob = scenes.edited_panel(cells=16)
    bpy.ops.ed.undo_push(message="Edit Mode")
    scenes.smooth(length=0.5)
    pressed = scenes.positions(ob)
    bpy.ops.ed.undo()
    return bpy.context.view_layer.objects.active, pressed


def test_resolve_without_region_and_selection_says_what_to_do() -> None:
    undo_a_press_in_edit_mode()
    bpy.ops.mesh.select_all(action='DESELECT')
    with pytest.raises(RuntimeError, match="^Error: [^\n]*select") as failure:
        bpy.ops.reflines.resolve('EXEC_DEFAULT', True)
    assert "bpy.ops" not in str(failure.value)
