"""Bad input gets one clear sentence, and the mesh stays as it was, bit by bit."""
from collections.abc import Callable
from functools import partial
from pathlib import Path

import bmesh
import bpy
import pytest
from mathutils import Vector

import scenes


def refused(ob: bpy.types.Object, sentence: str) -> None:
    """The operator refuses with a sentence of this pattern and changes nothing."""
    with scenes.refused(ob, sentence):
        scenes.smooth()


def edited(change: Callable[[bmesh.types.BMesh], None], height: scenes.Height = scenes.rippled) -> bpy.types.Object:
    """A panel seen from above, all of it selected, after a change of its edit mesh."""
    ob = scenes.panel(height=height)
    scenes.look_from_above()
    scenes.edit(ob)
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.verts.ensure_lookup_table()
    mesh.faces.ensure_lookup_table()
    change(mesh)
    bpy.ops.mesh.select_all(action='SELECT')
    bmesh.update_edit_mesh(ob.data)
    return ob


def nothing(_: bmesh.types.BMesh) -> None:
    """The panel as it is."""


def test_no_mesh() -> None:
    bpy.context.scene.reflection_lines.light = bpy.data.objects.new("Light Direction", None)
    with pytest.raises(RuntimeError, match="Make the panel's mesh the active object"):
        scenes.smooth()


def test_buttons_are_grey_where_there_are_no_faces_to_work_on() -> None:
    """Those that a press in the view begins say why then instead; a cage is fitted without a region."""
    tools, pressed = ([getattr(bpy.ops.reflines, name) for name in names]
                      for names in (("smooth", "direction", "warp", "pattern"),
                                    ("pull_line", "fair_brush", "fit")))
    ob = scenes.panel()
    scenes.look_from_above()
    states = [False]
    for change in (lambda: scenes.edit_inner(ob), lambda: bpy.ops.mesh.select_all(action='DESELECT'),
                   lambda: scenes.select_faces(ob, scenes.inner()), scenes.object_mode, lambda: run_once(ob)):
        assert {tool.poll() for tool in tools} == {states[-1]} and all(tool.poll() for tool in pressed)
        change()
        states.append(tools[0].poll())
    assert states == [False, True, False, True, False, True]


def run_once(ob: bpy.types.Object) -> None:
    """In Edit Mode, and back."""
    scenes.edit(ob)
    assert scenes.smooth() == {'FINISHED'}
    scenes.object_mode()


def one_face_flipped(mesh: bmesh.types.BMesh) -> None:
    mesh.faces[8 * 16 + 8].normal_flip()


def folded(mesh: bmesh.types.BMesh) -> None:
    mesh.verts[8 * 17 + 8].co.x += 0.2  # beyond its neighbour, whose distance is 0.125


def steep(mesh: bmesh.types.BMesh) -> None:
    for vertex in mesh.verts:
        if vertex.co.y > 0.5:
            vertex.co.z -= 1e6 * (vertex.co.y - 0.5)


@pytest.mark.parametrize(("change", "sentence"), [
    (one_face_flipped, "away from the view"), (folded, "folded over"), (steep, "edge on"),
])
def test_some_faces_cannot_be_used_and_are_held(change, sentence) -> None:
    ob = edited(change)
    ob.update_from_editmode()
    before = scenes.positions(ob)
    assert scenes.smooth(length=0.5) == {'FINISHED'}
    assert sentence in ob.reflection_lines.report.kept
    moved = (scenes.positions(ob) != before).any(axis=1)
    flipped = list(ob.data.polygons[8 * 16 + 8].vertices)
    assert moved.any() and not (change is one_face_flipped and moved[flipped].any())


def test_the_result_is_told_last(capfd) -> None:
    """The status bar shows the last report only."""
    edited(one_face_flipped)
    scenes.smooth()
    note, result = capfd.readouterr().out.splitlines()[-2:]
    assert note.startswith("Info: Panel: Kept: ") and "away from the view" in note
    assert result.startswith("Info: Flaws healed on ") and ", moved at most " in result and result.endswith(" (Panel)")


def zero_area(mesh: bmesh.types.BMesh) -> None:
    mesh.verts[8 * 17 + 8].co = mesh.verts[8 * 17 + 9].co.copy()


def not_a_number(mesh: bmesh.types.BMesh) -> None:
    mesh.verts[100].co.z = float("nan")
    mesh.verts[120].co.x = float("inf")


def doubled(mesh: bmesh.types.BMesh) -> None:
    """A second face on the corners of another, as a glued-on copy leaves it: same vertices, turned over."""
    mesh.faces.new(tuple(reversed(tuple(mesh.faces[100].verts[:3]))))


def fin(mesh: bmesh.types.BMesh) -> None:
    a, b = mesh.verts[8 * 17 + 8], mesh.verts[8 * 17 + 9]
    mesh.faces.new((a, b, mesh.verts.new(a.co + Vector((0.05, 0.0, 0.5)))))


def select_one_vertex(ob: bpy.types.Object) -> None:
    bpy.ops.mesh.select_all(action='DESELECT')
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.verts.ensure_lookup_table()
    mesh.verts[5].select_set(True)


def unlink(which: str) -> None:
    bpy.context.scene.collection.objects.unlink(getattr(scenes.settings(), which))


def with_only(part: str) -> bpy.types.Object:
    ob = scenes.panel()
    bpy.ops.reflines.set_up(part=part)
    scenes.edit_inner(ob)
    return ob


def seen_from_above(ob: bpy.types.Object, *, edit: bool = True) -> bpy.types.Object:
    scenes.look_from_above()
    if edit:
        scenes.edit(ob)
        bpy.ops.mesh.select_all(action='SELECT')
    return ob


# What is done to a panel that is edited, and the sentence.
CHANGED: dict[str, tuple[Callable[[bpy.types.Object], object], str]] = {
    "camera deleted": (lambda _: unlink("camera"), "No view camera"),
    "light deleted": (lambda _: unlink("light"), "No light direction"),
    "light without direction": (lambda _: setattr(scenes.settings().light, "scale", (0.0, 0.0, 0.0)),
                                "Light Direction has no direction"),
    "nothing selected": (lambda _: bpy.ops.mesh.select_all(action='DESELECT'),
                         "No faces are selected: select the faces of the panel"),
    "one vertex selected": (select_one_vertex, "the 1 selected vertices span no face"),
    "turned away": (lambda _: bpy.ops.mesh.flip_normals(), "All 256 faces of the region turn away"),
    "no free vertex": (lambda ob: scenes.select_faces(ob, lambda face: face < 16),
                       "No vertex of the region is free to move"),
    "scaled to nothing": (lambda ob: setattr(ob, "scale", (1.0, 0.0, 1.0)), "scaled to nothing"),
}
# How it is made, and the sentence.
MADE: dict[str, tuple[Callable[[], bpy.types.Object], str]] = {
    "no camera": (lambda: with_only('LIGHT'), "No view camera: press Set Up from This View"),
    "no light": (lambda: with_only('CAMERA'), "No light direction: press Add Light Direction"),
    "light along the view": (lambda: scenes.edited_panel(light_degrees=0.0), "parallel to the view"),
    "no stored region": (lambda: seen_from_above(scenes.panel(), edit=False),
                         "Panel has no stored region: select the faces of the panel in Edit Mode"),
    "closed body": (lambda: seen_from_above(scenes.sphere()),
                    "Sphere: the 384 selected faces are all of a closed body"),
    "one triangle": (lambda: seen_from_above(scenes.linked("Panel", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])),
                     "No vertex of the region is free to move"),
    "zero area": (lambda: edited(zero_area), "zero area"),
    "no number": (lambda: edited(not_a_number),
                  "Panel has 2 vertices in the region whose coordinates are no numbers, the first is 100"),
    "doubled face": (lambda: edited(doubled), "doubled|more than two faces"),
    "fin": (lambda: edited(fin), "1 edge of the region has more than two faces"),
}


@pytest.mark.parametrize(("change", "sentence"), CHANGED.values(), ids=CHANGED)
def test_what_was_changed_is_refused(change, sentence) -> None:
    ob = edited(nothing)
    change(ob)
    refused(ob, sentence)


@pytest.mark.parametrize(("make", "sentence"), MADE.values(), ids=MADE)
def test_what_was_made_so_is_refused(make, sentence) -> None:
    refused(make(), sentence)


def test_a_broken_mesh_outside_the_region_does_not_matter() -> None:
    ob = edited(lambda mesh: setattr(mesh.verts[0].co, "z", float("nan")))
    scenes.select_faces(ob, scenes.inner())
    assert scenes.smooth() == {'FINISHED'}


def test_loose_vertices_are_ignored() -> None:
    ob = edited(lambda mesh: mesh.verts.new((0.0, 0.0, 3.0)))
    assert scenes.smooth() == {'FINISHED'}
    assert scenes.positions(ob)[-1].tolist() == [0.0, 0.0, 3.0]


def test_a_shared_mesh_in_object_mode() -> None:
    ob = edited(nothing)
    scenes.smooth(strength=0.0)
    scenes.object_mode()
    twins = [bpy.data.objects.new(name, ob.data) for name in ("Twin", "Third")]
    for twin in twins:
        bpy.context.collection.objects.link(twin)
    refused(ob, "shares its mesh with 2 other objects: make it single-user")
    bpy.data.objects.remove(twins[0])
    refused(ob, "shares its mesh with 1 other object: make it single-user")


def test_a_mesh_shared_with_a_deleted_object_is_not_shared() -> None:
    """A warp lattice goes on pointing at it, which keeps it."""
    gone = edited(nothing)
    scenes.smooth(strength=0.0)
    bpy.ops.reflines.add_warp_lattice()
    scenes.object_mode()
    ob = gone.copy()
    bpy.context.collection.objects.link(ob)
    bpy.ops.object.select_all(action='DESELECT')
    scenes.activate(gone)
    bpy.ops.object.delete()
    assert ob.data.users == 2
    scenes.activate(ob)
    assert scenes.smooth(length=0.5) == {'FINISHED'}


def test_a_hidden_region() -> None:
    ob = edited(nothing)
    scenes.select_faces(ob, scenes.inner())
    scenes.smooth(strength=0.0)
    bpy.ops.mesh.hide()
    scenes.object_mode()
    refused(ob, "The 196 faces of the stored region of Panel are hidden: show them in Edit Mode")


def linked(tmp_path: Path) -> bpy.types.Object:
    """A panel with a region, from another file, in a fresh one."""
    edited(nothing)
    scenes.smooth(strength=0.0)
    scenes.object_mode()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (_, wanted):
        wanted.objects = ["Panel"]
    bpy.context.collection.objects.link(wanted.objects[0])
    return wanted.objects[0]


def overridden(ob: bpy.types.Object, *, mesh: bool) -> bpy.types.Object:
    own = ob.override_create(remap_local_usages=True)
    if mesh:
        own.data.override_create(remap_local_usages=True)
    return own


def with_own_object(ob: bpy.types.Object) -> bpy.types.Object:
    own = bpy.data.objects.new("Own", ob.data)
    bpy.context.collection.objects.link(own)
    return own


@pytest.mark.parametrize(("take", "sentence"), [
    (lambda ob: ob, "Panel is linked from another file"),
    (with_own_object, "The mesh of Own is linked from another file"),
    (partial(overridden, mesh=True), "The mesh of Panel is linked from another file and overridden here"),
    (partial(overridden, mesh=False), "Panel is linked from another file"),
], ids=["object", "mesh", "overridden mesh", "mesh behind an overridden object"])
def test_what_another_file_has_is_refused(take, sentence, tmp_path) -> None:
    """A solve of an overridden mesh would end well, and nothing of it would be saved."""
    ob = take(linked(tmp_path))
    scenes.activate(ob)
    refused(seen_from_above(ob, edit=False), sentence)
