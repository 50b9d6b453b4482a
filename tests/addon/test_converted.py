"""An object that was solved and checked may be no mesh any more, or its name another object's: nothing fails then."""
import bpy
import pytest

import scenes
from reflection_lines.state import last_checks


@pytest.fixture
def checked(panel) -> bpy.types.Object:
    scenes.smooth(length=0.5)
    scenes.object_mode()
    assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}
    return panel


def test_undo_in_a_curve_that_was_a_panel(checked, capfd) -> None:
    bpy.ops.object.convert(target='CURVE')
    scenes.edit(bpy.context.view_layer.objects.active)
    for name in ("start", "select"):
        bpy.ops.curve.select_all(action='SELECT')
        bpy.ops.ed.undo_push(message=name)
    bpy.ops.ed.undo()
    assert bpy.data.objects["Panel"].type == 'CURVE' and bpy.context.mode == 'EDIT_CURVE'
    assert "Traceback" not in capfd.readouterr().err


def test_the_check_of_a_panel_that_became_a_curve_is_forgotten(checked, capfd) -> None:
    bpy.ops.object.convert(target='CURVE')
    ob = bpy.context.view_layer.objects.active
    ob.data.splines[0].points[0].co.x += 1.0
    ob.data.update_tag()
    bpy.context.view_layer.update()
    assert last_checks.find_check(ob.name) is None
    assert "Traceback" not in capfd.readouterr().err


def test_the_check_stays_with_its_mesh(checked) -> None:
    checked.data.update_tag()
    bpy.context.view_layer.update()
    assert last_checks.find_check(checked.name) is not None
    checked.data.vertices[0].co.z += 0.01
    checked.data.update_tag()
    bpy.context.view_layer.update()
    assert last_checks.find_check(checked.name) is None
