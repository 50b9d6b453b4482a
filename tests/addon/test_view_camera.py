"""Set Up from This View, the view of a panel, and what is said of a panel seen from behind."""
import bmesh
import bpy
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

import scenes
from scenes import axis_z, settings


def in_picture(points: np.ndarray) -> np.ndarray:
    """Where world points are in the view camera's picture: 0 to 1 across and up, and the distance."""
    bpy.context.view_layer.update()
    return np.array([world_to_camera_view(bpy.context.scene, settings().camera, Vector(point)) for point in points])


def is_framed(points: np.ndarray) -> bool:
    """All in the picture, with a margin; and the picture is no more than a fifth too large one way or the other."""
    seen = in_picture(points)
    camera = settings().camera.data
    inside = (seen[:, :2] > 0.01).all() and (seen[:, :2] < 0.99).all() and (seen[:, 2] > camera.clip_start).all() and (
        seen[:, 2] < camera.clip_end).all()
    return bool(inside and np.ptp(seen[:, :2], axis=0).max() > 0.8)


@pytest.mark.parametrize("direction", [(0.0, 0.0, 1.0), (1.0, 2.0, 1.5), (0.0, -1.0, 0.2)])
@pytest.mark.parametrize("kind", ['ORTHO', 'PERSP'])
def test_the_view_camera_is_turned_and_frames_the_panel(direction, kind) -> None:
    ob = scenes.panel()
    ob.location, ob.scale = (5.0, 6.0, 7.0), (0.02, 0.3, 1.0)
    scenes.look_from_above()
    camera = settings().camera
    camera.data.type = kind
    assert bpy.ops.reflines.set_up(direction=direction) == {'FINISHED'}
    assert settings().camera == camera and len(bpy.data.cameras) == 1
    bpy.context.view_layer.update()
    assert axis_z(camera) == pytest.approx(np.array(direction) / np.linalg.norm(direction), abs=1e-5)
    assert is_framed(np.array([ob.matrix_world @ Vector(corner) for corner in ob.bound_box]))


@pytest.mark.parametrize("direction", [(0.0, 0.0, 1.0), (1.0, 2.0, 1.5)])
def test_the_set_up_adds_camera_light_and_stripes_at_once_and_a_press_can_follow(direction) -> None:
    ob = scenes.panel()
    scenes.edit_inner(ob)
    settings().stripes.show = False
    assert bpy.ops.reflines.set_up(direction=direction) == {'FINISHED'}
    bpy.context.view_layer.update()
    assert axis_z(settings().camera) == pytest.approx(np.array(direction) / np.linalg.norm(direction), abs=1e-5)
    assert settings().missing() == "" and settings().stripes.show
    assert abs(axis_z(settings().light) @ axis_z(settings().camera)) < 1e-5
    assert scenes.smooth() == {'FINISHED'}


def test_the_set_up_keeps_the_light_that_is_there() -> None:
    scenes.panel()
    scenes.look_from_above()
    camera, light = settings().camera, settings().light
    before = light.matrix_world.copy()
    assert bpy.ops.reflines.set_up(direction=(1.0, 0.0, 0.3)) == {'FINISHED'}
    assert (settings().camera, settings().light) == (camera, light) and light.matrix_world == before
    settings().light = None
    assert bpy.ops.reflines.set_up() == {'FINISHED'} and settings().camera == camera and settings().light is not None


def track(camera: bpy.types.Object, other: bpy.types.Object) -> None:
    camera.constraints.new('TRACK_TO').target = other


def put_below(camera: bpy.types.Object, other: bpy.types.Object) -> None:
    camera.parent = other


@pytest.mark.parametrize("hold", [track, put_below])
def test_a_camera_that_cannot_be_turned_is_refused_and_stays(hold) -> None:
    scenes.panel()
    scenes.look_from_above()
    other = bpy.data.objects.new("Other", None)
    bpy.context.collection.objects.link(other)
    other.location, other.scale, other.rotation_euler = (9.0, 0.0, 0.0), (2.0, 0.5, 3.0), (0.3, 0.4, 0.5)
    camera = settings().camera
    hold(camera, other)
    bpy.context.view_layer.update()
    before = [tuple(row) for row in (*camera.matrix_world, *camera.matrix_basis)], camera.data.ortho_scale
    with pytest.raises(RuntimeError, match="View Camera cannot be turned to this view, since a constraint"):
        bpy.ops.reflines.set_up(direction=(1.0, 0.3, 1.0))
    assert ([tuple(row) for row in (*camera.matrix_world, *camera.matrix_basis)], camera.data.ortho_scale) == before


def test_a_camera_below_an_even_scale_is_turned() -> None:
    ob = scenes.panel()
    scenes.look_from_above()
    other = bpy.data.objects.new("Other", None)
    bpy.context.collection.objects.link(other)
    other.location, other.scale, other.rotation_euler = (9.0, 0.0, 0.0), (2.0, 2.0, 2.0), (0.3, 0.4, 0.5)
    settings().camera.parent = other
    assert bpy.ops.reflines.set_up(direction=(1.0, 0.3, 1.0)) == {'FINISHED'}
    bpy.context.view_layer.update()
    assert axis_z(settings().camera) == pytest.approx(np.array([1.0, 0.3, 1.0]) / np.sqrt(2.09), abs=1e-4)
    assert is_framed(scenes.world(ob))


def hide_by_the_collection(ob: bpy.types.Object) -> None:
    hidden = bpy.data.collections.new("Rig")
    bpy.context.scene.collection.children.link(hidden)
    for collection in ob.users_collection:
        collection.objects.unlink(ob)
    hidden.objects.link(ob)
    hidden.hide_viewport = True


@pytest.mark.parametrize("hide", [lambda ob: setattr(ob, "hide_viewport", True), hide_by_the_collection])
@pytest.mark.parametrize("name", ["camera", "light"])
def test_a_view_that_blender_does_not_follow_is_told(name, hide) -> None:
    """Its matrix stays as it was when it was disabled."""
    scenes.panel()
    scenes.look_from_above()
    ob = getattr(settings(), name)
    assert settings().describe_unfollowed(ob) == ""
    hide(ob)
    bpy.context.view_layer.update()
    before = axis_z(ob)
    ob.rotation_euler.y += 0.5
    bpy.context.view_layer.update()
    assert np.array_equal(axis_z(ob), before)
    assert f"{ob.name} is disabled in viewports" in settings().describe_unfollowed(ob)
    ob.hide_set(False)


def test_in_edit_mode_the_selection_is_framed() -> None:
    ob = scenes.panel()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face % 16 < 4 and face // 16 < 4)
    bpy.ops.reflines.set_up(direction=(0.0, 0.0, 1.0))  # adds one
    chosen = scenes.world(ob)[[vertex.select for vertex in bmesh.from_edit_mesh(ob.data).verts]]
    assert is_framed(chosen)
    assert not is_framed(scenes.world(ob))


def has_other_view(ob: bpy.types.Object) -> bool:
    """Whether the operator takes another view or light for the active panel, of which the sidebar tells."""
    told = ob.reflection_lines.has_other_view(bpy.context.scene)
    if not told:
        with pytest.raises(RuntimeError, match="worked on with no other view camera or light"):
            bpy.ops.reflines.set_up(part='PANEL')
    return told


def test_a_panel_keeps_its_view() -> None:
    one = scenes.edited_panel("One")
    scenes.smooth()
    scenes.object_mode()
    first = settings().camera, settings().light
    assert not has_other_view(one)
    one.select_set(False)
    other = scenes.panel("Two")
    bpy.ops.reflines.set_up(part='CAMERA', direction=(0.3, 0.0, 1.0))
    assert settings().camera != first[0]
    assert not has_other_view(other)
    scenes.activate(one)
    assert bpy.ops.reflines.set_up(part='PANEL') == {'FINISHED'}
    assert (settings().camera, settings().light) == first
    scenes.activate(other)
    bpy.data.objects.remove(other.reflection_lines.camera)
    assert not has_other_view(other)


def test_a_camera_of_another_scene_is_named_as_such() -> None:
    ob = scenes.panel()
    scenes.look_from_above()
    camera, other = settings().camera, bpy.data.scenes.new("Studio")
    other.collection.objects.link(camera)
    for collection in list(camera.users_collection):
        if collection != other.collection:
            collection.objects.unlink(camera)
    scenes.edit_inner(ob)
    with pytest.raises(RuntimeError, match="View Camera is in the scene Studio, not in this one"):
        scenes.smooth()
    bpy.data.objects.remove(camera)
    with pytest.raises(RuntimeError, match="No view camera"):
        scenes.smooth()


def test_resolve_in_edit_mode_of_an_instanced_mesh() -> None:
    ob = scenes.panel()
    twin = bpy.data.objects.new("Twin", ob.data)
    bpy.context.collection.objects.link(twin)
    scenes.look_from_above()
    scenes.edit_inner(ob)
    start = scenes.positions(ob).copy()
    scenes.smooth(length=1.0)
    once = scenes.positions(ob).copy()
    assert not np.array_equal(once, start)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert ob.mode == 'EDIT' and np.abs(scenes.positions(ob) - once).max() < 1e-6  # from the shape before that run
    scenes.object_mode()
    with pytest.raises(RuntimeError, match="shares its mesh"):
        bpy.ops.reflines.resolve('EXEC_DEFAULT', True)


def refusal_from(direction: tuple, ob: bpy.types.Object, faces: object) -> str:
    scenes.look_from_above()
    bpy.ops.reflines.set_up(direction=direction)
    scenes.edit(ob)
    scenes.select_faces(ob, faces)
    before = scenes.fingerprint(ob)
    with pytest.raises(RuntimeError, match="turn away from the view") as refusal:
        scenes.smooth()
    assert scenes.fingerprint(ob) == before
    return str(refusal.value)


def test_an_open_panel_seen_from_behind_says_turn_the_camera() -> None:
    said = refusal_from((0.0, 0.0, -1.0), scenes.panel(), scenes.inner())
    assert "turn the view camera" in said and "lip" not in said


def test_an_open_panel_inside_out_says_flip() -> None:
    ob = scenes.panel(height=scenes.crown)
    ob.data.flip_normals()
    said = refusal_from((0.0, 0.0, 1.0), ob, scenes.inner())
    assert "Mesh > Normals > Flip" in said and "turn the view" not in said


def test_a_flat_panel_turned_away_says_turn_the_camera() -> None:
    ob = scenes.panel(height=lambda x, y: 0.0)
    ob.data.flip_normals()
    assert "turn the view camera" in refusal_from((0.0, 0.0, 1.0), ob, scenes.inner())


def cap(ob: bpy.types.Object, below: float) -> set[int]:
    return {face.index for face in ob.data.polygons if face.center.z < below}


def test_the_back_of_a_closed_body_says_turn_the_camera() -> None:
    ob = scenes.sphere()
    bottom = cap(ob, -0.5)
    assert "turn the view camera" in refusal_from((0.0, 0.0, 1.0), ob, lambda face: face in bottom)


def test_a_closed_body_inside_out_says_flip() -> None:
    ob = scenes.sphere()
    ob.data.flip_normals()
    top = set(range(len(ob.data.polygons))) - cap(ob, 0.5)
    assert "Mesh > Normals > Flip" in refusal_from((0.0, 0.0, 1.0), ob, lambda face: face in top)


def test_flipped_faces_of_a_sound_body_say_flip() -> None:
    ob = scenes.sphere()
    top = set(range(len(ob.data.polygons))) - cap(ob, 0.5)
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face in top)
    bpy.ops.mesh.flip_normals()
    scenes.object_mode()
    assert "Mesh > Normals > Flip" in refusal_from((0.0, 0.0, 1.0), ob, lambda face: face in top)
