"""A result tells what keeps it from being seen as it is: custom normals, and objects that share the mesh."""
import bpy
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
