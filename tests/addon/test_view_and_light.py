"""Set Up from This View by its parts: another view camera, and the light direction."""
from pathlib import Path

import bpy
import numpy as np
import pytest
from mathutils import Euler

import scenes
from scenes import axis_z, settings


@pytest.mark.parametrize("angles", [(0.0, 0.0, 0.0), (0.5, 0.3, 2.0), (np.pi / 2, 0.0, 0.0)])
def test_in_background_the_camera_looks_at_the_panels_mean_normal(angles) -> None:
    ob = scenes.panel(height=scenes.crown)
    ob.matrix_world = Euler(angles).to_matrix().to_4x4()
    bpy.ops.reflines.set_up(part='CAMERA')
    camera = settings().camera
    assert camera.data.type == 'ORTHO'
    assert axis_z(camera) == pytest.approx(np.array(ob.matrix_world)[:3, 2], abs=1e-5)


def test_in_edit_mode_the_selected_faces_count() -> None:
    bpy.ops.mesh.primitive_cube_add()
    ob = bpy.context.object
    scenes.edit(ob)
    right = next(face.index for face in ob.data.polygons if face.normal.x > 0.9)
    scenes.select_faces(ob, lambda face: face == right)
    bpy.ops.reflines.set_up(part='CAMERA')
    assert axis_z(settings().camera) == pytest.approx([1.0, 0.0, 0.0], abs=1e-6)


@pytest.mark.parametrize("direction", [(0.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)])
def test_the_first_light_is_across_the_view(direction) -> None:
    scenes.panel()
    bpy.ops.reflines.set_up(part='CAMERA', direction=direction)
    bpy.ops.reflines.set_up(part='LIGHT')
    assert settings().light.type == 'EMPTY'
    assert settings().light.empty_display_type == 'SINGLE_ARROW'
    assert abs(axis_z(settings().camera) @ axis_z(settings().light)) < 1e-6


def test_a_light_of_a_given_direction() -> None:
    scenes.panel()
    bpy.ops.reflines.set_up(part='LIGHT', direction=(1.0, -2.0, 0.5))
    assert axis_z(settings().light) == pytest.approx(np.array([1.0, -2.0, 0.5]) / np.sqrt(5.25), abs=1e-6)


def test_a_camera_needs_a_mesh() -> None:
    with pytest.raises(RuntimeError, match="Make the panel's mesh the active object"):
        bpy.ops.reflines.set_up(part='CAMERA')


def test_the_selection_stays() -> None:
    ob = scenes.panel()
    scenes.look_from_above()
    assert bpy.context.view_layer.objects.active == ob
    assert bpy.context.selected_objects == [ob]


def test_undo_takes_camera_and_light_away() -> None:
    scenes.panel()
    bpy.ops.ed.undo_push(message="start")
    bpy.ops.reflines.set_up('EXEC_DEFAULT', True, part='CAMERA')
    bpy.ops.ed.undo()
    assert settings().camera is None
    assert not bpy.data.cameras


def below(scale: tuple[float, float, float]) -> None:
    """Puts the light below a parent that is turned and has this scale."""
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(parent)
    parent.scale, parent.rotation_euler = scale, (0.2, 0.1, 0.6)
    settings().light.parent = parent


LIGHTS = {"plain": lambda: None,
          "mirrored along": lambda: setattr(settings().light, "scale", (1.0, 1.0, -1.0)),
          "mirrored across": lambda: setattr(settings().light, "scale", (-1.0, 1.0, 1.0)),
          "mirrored in all": lambda: setattr(settings().light, "scale", (-1.0, -1.0, -1.0)),
          "turned by its delta": lambda: setattr(settings().light, "delta_rotation_euler", (0.3, 0.2, 0.1)),
          "below an uneven scale": lambda: below((2.0, 0.5, 1.0)),
          "below a mirror": lambda: below((1.0, 3.0, -1.0))}


@pytest.mark.parametrize("light", LIGHTS)
def test_a_light_is_turned_to_what_was_set(light) -> None:
    scenes.panel()
    scenes.look_from_above()
    LIGHTS[light]()
    bpy.context.view_layer.update()
    place = settings().light.matrix_world.translation.to_tuple()
    for turn, tilt in ((0.3, 0.0), (1.0, 0.2), (-2.5, -0.7)):
        settings().light_turn, settings().light_tilt = turn, tilt
        assert (settings().light_turn, settings().light_tilt) == pytest.approx((turn, tilt), abs=1e-4)
        axis = np.cos(tilt) * np.cos(turn), np.cos(tilt) * np.sin(turn), np.sin(tilt)
        assert axis_z(settings().light) == pytest.approx(axis, abs=1e-4)
    assert settings().light.matrix_world.translation.to_tuple() == pytest.approx(place, abs=1e-5)


def test_what_is_read_from_the_light_cannot_be_keyed() -> None:
    """Its own rotation can; keys of its turn in the picture would be followed by no frame but the present one."""
    for name in ("light_turn", "light_tilt", "light_dial"):
        assert not settings().bl_rna.properties[name].is_animatable


def from_another_file(tmp_path: Path, what: str, name: str) -> object:
    """A data-block of the present file, linked into a fresh one."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (_, wanted):
        setattr(wanted, what, [name])
    return getattr(wanted, what)[0]


def test_what_is_added_goes_to_the_scene_where_the_active_collection_is_linked(tmp_path) -> None:
    bpy.context.scene.collection.children.link(bpy.data.collections.new("Kit"))
    linked = from_another_file(tmp_path, "collections", "Kit")
    bpy.context.scene.collection.children.link(linked)
    ob = scenes.panel()
    layer = bpy.context.view_layer
    layer.active_layer_collection = layer.layer_collection.children["Kit"]
    scenes.look_from_above()
    scenes.edit_inner(ob)
    assert bpy.ops.reflines.add_warp_lattice() == {'FINISHED'}
    own = set(bpy.context.scene.collection.objects)
    assert {settings().camera, settings().light, settings().warp.lattice} <= own


def test_a_linked_camera_of_a_local_ones_name_counts(tmp_path) -> None:
    scenes.panel()
    scenes.look_from_above()
    linked = from_another_file(tmp_path, "objects", "View Camera")
    bpy.context.collection.objects.link(linked)
    ob = scenes.panel()
    scenes.look_from_above()
    local = settings().camera
    assert local.name == linked.name and local != linked
    scenes.edit_inner(ob)
    for camera in (linked, local):
        settings().camera = camera
        assert scenes.smooth() == {'FINISHED'}
    bpy.data.objects.remove(local)
    settings().camera = linked
    bpy.context.collection.objects.unlink(linked)
    assert "No view camera" in settings().missing()
