"""A result tells what keeps it from being seen as it is: custom normals, objects that share the mesh, faces that lie on
the border without being joined to it, and coordinates whose rounding bends lines.
"""
import bpy
import numpy as np
import pytest

import scenes


def pressed(ob: bpy.types.Object) -> bpy.types.PropertyGroup:
    scenes.look_from_above()
    scenes.edit_inner(ob)
    assert scenes.smooth() == {'FINISHED'}
    return ob.reflection_lines.report


def test_custom_normals_are_told_until_they_are_reset() -> None:
    ob = scenes.panel()
    if hasattr(ob.data, "use_auto_smooth"):  # until Blender 4.0
        ob.data.use_auto_smooth = True
    ob.data.normals_split_custom_set_from_vertices([(0.0, 0.0, 1.0)] * len(ob.data.vertices))
    report = pressed(ob)
    assert "Panel has custom normals, which go on showing the old reflections" in report.notes
    scenes.object_mode()
    assert bpy.ops.mesh.customdata_custom_splitnormals_clear() == {'FINISHED'}
    assert "custom normals" not in pressed(ob).notes


@pytest.mark.parametrize("count", [0, 1, 5])
def test_objects_that_share_the_mesh_are_named(count) -> None:
    ob = scenes.panel()
    for k in range(count):
        bpy.context.collection.objects.link(bpy.data.objects.new(f"Other {k}", ob.data))
    notes = pressed(ob).notes
    assert ("The mesh is shared: " in notes) == (count > 0)
    assert ("Other 0 changed, too" in notes) == (count == 1)
    assert ("Other 0, Other 1, Other 2 and 2 more changed, too" in notes) == (count == 5)


def halves(*, gap: float = 0.0, fold: float = 0.0) -> bpy.types.Object:
    """A panel in two halves that are not joined at x = 0, the right one `gap` away and turned down by `fold`."""
    ob = scenes.panel()
    V, faces = scenes.positions(ob), [list(face.vertices) for face in ob.data.polygons]
    right = V + [gap, 0.0, 0.0]
    right[:, 2] -= np.tan(fold) * right[:, 0]
    bpy.data.objects.remove(ob)
    split = [[v + len(V) * (k % 16 >= 8) for v in face] for k, face in enumerate(faces)]
    used, index = np.unique(split, return_inverse=True)
    return scenes.linked("Halves", np.concatenate([V, right])[used].tolist(), index.reshape(-1, 4).tolist())


def press_left(ob: bpy.types.Object) -> bpy.types.PropertyGroup:
    """Presses on the left half, without the outermost faces."""
    scenes.look_from_above()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: 1 <= face % 16 < 8 and 16 <= face < 240)
    assert scenes.smooth() == {'FINISHED'}
    return ob.reflection_lines.report


@pytest.mark.parametrize("gap", [0.0, 0.005])
def test_halves_that_are_not_joined_are_told_until_they_are_merged(gap: float) -> None:
    ob = halves(gap=gap)
    report = press_left(ob)
    assert "14 edges of the border lie on faces that are not joined to it" in report.notes
    assert gap < report.merge_distance < 1.5 * gap + 1e-3
    before = len(ob.data.vertices)
    bpy.ops.mesh.select_mode(type='FACE')  # selects all corners of the faces, as an artist does
    assert bpy.ops.mesh.remove_doubles(threshold=report.merge_distance, use_unselected=True) == {'FINISHED'}
    ob.update_from_editmode()
    assert len(ob.data.vertices) == before - 15
    assert "not joined" not in press_left(ob).notes and report.merge_distance == 0.0


def test_another_object_at_the_border_is_named() -> None:
    ob, other = (scenes.panel(name, height=lambda x, y: 0.2 * scenes.rippled(x, y)) for name in ("Left", "Right"))
    other.location.x = 2.0
    other.scale.x, other.scale.y = -1.0, 1.0  # its left border is the image of the right one
    ob.select_set(False)
    scenes.activate(ob)
    other.select_set(False)
    scenes.look_from_above()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face % 16 >= 8)
    assert scenes.smooth() == {'FINISHED'}
    report = ob.reflection_lines.report
    assert "16 edges of the border lie on Right, where lines can break: press Smooth Lines with the" in report.notes
    assert report.merge_distance == 0.0
    other.hide_set(True)
    assert scenes.smooth() == {'FINISHED'} and "Right" not in report.notes


@pytest.mark.parametrize("how", [{"gap": 0.05}, {"fold": 0.8}])
def test_what_is_apart_or_meets_at_an_edge_is_not_told(how: dict) -> None:
    assert "not joined" not in press_left(halves(**how)).notes


@pytest.mark.parametrize(("far", "said"), [(0.0, False), (100.0, False), (20000.0, True)])
def test_a_mesh_far_from_its_origin_is_told_until_that_is_moved(far: float, said: bool) -> None:
    ob = scenes.panel()
    for vertex in ob.data.vertices:
        vertex.co.x += far
    ob.location.x = -far
    bpy.context.view_layer.update()
    report = pressed(ob)
    assert ("where the rounding of coordinates turns the lines by" in report.notes) == said
    assert (report.rounding > 0.0) == said
    scenes.object_mode()
    assert bpy.ops.object.origin_set(type='ORIGIN_GEOMETRY') == {'FINISHED'}
    assert "rounding" not in pressed(ob).notes and report.rounding == 0.0


def test_a_single_user_keeps_the_change_to_itself() -> None:
    """As the button of the result has it."""
    ob = scenes.panel()
    other = bpy.data.objects.new("Other", ob.data)
    bpy.context.collection.objects.link(other)
    assert "Other changed, too" in pressed(ob).notes
    scenes.object_mode()
    assert bpy.ops.object.make_single_user(type='SELECTED_OBJECTS', object=False, obdata=True) == {'FINISHED'}
    before = scenes.fingerprint(other)
    assert "shared" not in pressed(ob).notes and scenes.fingerprint(other) == before
