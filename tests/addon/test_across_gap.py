"""Smooth Lines across gaps in Blender: the slope at a border becomes that of what lies beside."""
from collections.abc import Callable
from pathlib import Path

import bmesh
import bpy
import numpy as np
import pytest

import scenes
from mathutils import Matrix

CELLS = 24
Array = np.ndarray
KINK = 0.05  # slope by which the left half is bent at its right side: 2.9 degrees


def bent(x: float, y: float) -> float:
    """The clean panel, bent beside x = 0, where its height is right."""
    near = np.clip(1.0 + x / 0.4, 0.0, 1.0)
    return scenes.crown(x, y) + KINK * x * near**2 * np.exp(-(y / 0.7) ** 4)


def half(name: str, low: float, high: float, height: Callable, cells: int = CELLS,
         matrix: Matrix | None = None) -> bpy.types.Object:
    """A sheet over x from low to high and y from -1 to 1, which the object's matrix leaves in place."""
    columns, rows = np.linspace(low, high, cells + 1), np.linspace(-1.0, 1.0, 2 * cells + 1)
    points = np.array([(x, y, height(x, y)) for y in rows for x in columns])
    matrix = Matrix() if matrix is None else matrix
    inverse = np.array(matrix.inverted())
    points = points @ inverse[:3, :3].T + inverse[:3, 3]
    faces = scenes.quads(len(columns), len(rows))
    if matrix.determinant() < 0.0:
        faces = [face[::-1] for face in faces]
    ob = scenes.linked(name, points.tolist(), faces)
    ob.parent, ob.matrix_parent_inverse = find_parent(), matrix  # an object's own transform cannot shear
    bpy.context.view_layer.update()
    return ob


def find_parent() -> bpy.types.Object:
    found = bpy.data.objects.get("Parent")
    if found is None:
        found = bpy.data.objects.new("Parent", None)
        bpy.context.collection.objects.link(found)
    return found


def slopes(V: Array, x: float) -> tuple[Array, Array]:
    """The slope along x of a sheet at its side x, from a parabola through its three last columns; ascending y."""
    order = np.lexsort([V[:, 1], np.round(np.abs(V[:, 0] - x), 4)])
    count = int((np.abs(V[:, 0] - x) < 1e-5).sum())
    a, b, c = V[order[:3 * count]].reshape(3, count, 3)
    h, k = b[:, 0] - a[:, 0], c[:, 0] - a[:, 0]
    return a[:, 1], ((b[:, 2] - a[:, 2]) * k / h - (c[:, 2] - a[:, 2]) * h / k) / (k - h)


def kink(left: Array, right: Array, gap: float) -> float:
    """Degrees, the largest: by how much the slope jumps from one sheet to the other, beyond what the gap's width and
    the crown's bend explain."""
    (y, one), (other_y, other) = slopes(left, -0.5 * gap), slopes(right, 0.5 * gap)
    jump = np.interp(y, other_y, other) - one + 0.3 * gap
    return float(np.degrees(np.abs(jump[np.abs(y) < 0.8]).max()))


def start(ob: bpy.types.Object) -> None:
    bpy.ops.object.select_all(action='DESELECT')
    scenes.activate(ob)
    scenes.look_from_above()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda _face: True)


MATRICES = {"plain": Matrix(), "mirrored": Matrix.Diagonal((-2.0, 0.5, 1.5, 1.0)) @ Matrix.Rotation(0.4, 4, 'Z'),
            "sheared": Matrix(((1.0, 0.3, 0.0, 2.0), (0.0, 1.0, 0.0, 0.1), (0.2, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)))}


@pytest.mark.parametrize("gap", [0.0, 0.002, 0.016])
@pytest.mark.parametrize("kind", list(MATRICES))
def test_the_kink_goes_and_the_gap_stays(kind: str, gap: float) -> None:
    right = half("Right", 0.5 * gap, 1.0, scenes.crown, 17, MATRICES[kind])
    left = half("Left", -1.0, -0.5 * gap, bent)
    start(left)
    before, other = scenes.world(left), scenes.world(right)
    held = np.abs(before[:, 0] + 0.5 * gap) < 1e-6
    kinks = [kink(before, other, gap)]
    assert scenes.smooth(border='follow') == {'FINISHED'}
    after = scenes.world(left)
    kinks.append(kink(after, other, gap))
    print(kind, gap, kinks)
    assert kinks[0] > 2.5 and kinks[1] < 0.3
    assert np.array_equal(after[held], before[held]) and np.array_equal(scenes.world(right), other)


def test_halves_of_one_mesh_that_are_not_joined_follow_each_other() -> None:
    half("Right", 0.0, 1.0, scenes.crown)
    left = half("Left", -1.0, 0.0, bent)
    count = len(left.data.polygons)
    scenes.activate(bpy.data.objects["Right"])
    scenes.activate(left)
    bpy.ops.object.join()
    start(left)
    scenes.select_faces(left, lambda face: face < count)
    before = scenes.world(left)
    own = np.arange(len(before)) < (CELLS + 1) * (2 * CELLS + 1)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    after = scenes.world(left)
    assert kink(before[own], before[~own], 0.0) > 2.5 and kink(after[own], after[~own], 0.0) < 0.3
    assert np.array_equal(after[~own], before[~own])


@pytest.mark.parametrize("border", ["clamped", "free"])
def test_halves_of_one_mesh_that_touch_are_smoothed_as_if_they_were_joined(border: str) -> None:
    half("Right", 0.0, 1.0, lambda x, y: bent(-x, y), 17)
    left = half("Left", -1.0, 0.0, bent)
    count = len(left.data.vertices)
    scenes.activate(bpy.data.objects["Right"])
    scenes.activate(left)
    bpy.ops.object.join()
    start(left)
    before = scenes.world(left)
    assert scenes.smooth(border=border) == {'FINISHED'}
    after = scenes.world(left)
    assert kink(before[:count], before[count:], 0.0) > 5.0 and kink(after[:count], after[count:], 0.0) < 0.3
    assert np.abs(flush(after[:count], after[count:], 0.0) - flush(before[:count], before[count:], 0.0)).max() < 3e-5
    assert "not joined" not in left.reflection_lines.report.notes


def hide_faces(right: bpy.types.Object) -> None:
    for face in right.data.polygons:
        face.hide = True


def break_vertices(right: bpy.types.Object) -> None:
    right.data.vertices.foreach_set("co", np.full(3 * len(right.data.vertices), np.nan, dtype=np.float32))
    right.data.update()


NO_NEIGHBOURS = {
    "hidden": lambda ob: ob.hide_set(True),
    "turned away": lambda ob: ob.data.flip_normals(),
    "moved back": lambda ob: setattr(ob, "location", (0.0, 0.0, -0.05)),
    "moved away": lambda ob: setattr(ob, "location", (0.1, 0.0, 0.0)),
    "slid under": lambda ob: setattr(ob, "location", (-0.3, 0.0, -0.003)),
    "tilted": lambda ob: setattr(ob, "rotation_euler", (0.0, 0.5, 0.0)),
    "flat": lambda ob: setattr(ob, "scale", (1.0, 1.0, 0.0)),
    "drawn as wire": lambda ob: setattr(ob, "display_type", 'WIRE'),
    "overlapping": lambda ob: setattr(ob, "location", (-0.1, 0.0, 0.0)),
    "with hidden faces": hide_faces,
    "no numbers": break_vertices,
}


@pytest.mark.parametrize("change", NO_NEIGHBOURS.values(), ids=NO_NEIGHBOURS)
def test_what_is_no_neighbour_changes_no_bit(change: Callable) -> None:
    results = []
    for alone in (True, False):
        bpy.ops.wm.read_homefile(use_empty=True)
        right = half("Right", 0.0, 1.0, scenes.crown)
        change(right)
        if alone:
            bpy.data.objects.remove(right)
        left = half("Left", -1.0, 0.0, bent)
        start(left)
        assert scenes.smooth(border='clamped' if alone else 'follow') == {'FINISHED'}
        results.append(scenes.world(left))
    assert np.array_equal(*results)


@pytest.mark.parametrize("change", ["overlapping", "slid under", "tilted"])
def test_panels_that_overlap_are_pressed_each_by_itself(change: str) -> None:
    """Also where both are in Edit Mode: neither bends the other."""
    results = []
    for border in ('clamped', 'follow'):
        bpy.ops.wm.read_homefile(use_empty=True)
        right = half("Right", 0.0, 1.0, dented, 17)
        NO_NEIGHBOURS[change](right)
        left = half("Left", -1.0, 0.0, bent)
        start_several(left, right)
        assert scenes.smooth(border=border) == {'FINISHED'}
        results.append(np.concatenate([scenes.world(left), scenes.world(right)]))
    assert np.array_equal(*results)


def test_a_neighbour_is_followed_as_its_modifiers_leave_it() -> None:
    right = half("Right", 0.0, 1.0, lambda x, y: scenes.crown(x, y) - 1.0, 12)
    lift = right.modifiers.new("Lift", 'DISPLACE')
    lift.direction, lift.mid_level, lift.strength = 'Z', 0.0, 1.0
    left = half("Left", -1.0, 0.0, bent)
    start(left)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    other = scenes.world(right)
    other[:, 2] += 1.0
    assert kink(scenes.world(left), other, 0.0) < 0.3


def test_a_segment_follows_alone() -> None:
    """Where only the upper part of the rim is set to follow, the lower part keeps its kink."""
    right = half("Right", 0.0, 1.0, scenes.crown)
    left = half("Left", -1.0, 0.0, bent)
    start(left)
    edit = bmesh.from_edit_mesh(left.data)
    layer = edit.verts.layers.int.new("reflines_border")
    for vertex in edit.verts:
        vertex[layer] = 57000 if abs(vertex.co.x) < 1e-6 and vertex.co.y > -0.1 else 0
    bmesh.update_edit_mesh(left.data)
    scenes.smooth(border='clamped')
    y, one = slopes(scenes.world(left), 0.0)
    jump = np.degrees(np.abs(slopes(scenes.world(right), 0.0)[1] - one))
    assert jump[(y > 0.3) & (y < 0.8)].max() < 1.0 and jump[(y > -0.6) & (y < -0.3)].min() > 1.7


def start_several(*objects: bpy.types.Object) -> None:
    start(objects[0])
    bpy.ops.object.mode_set(mode='OBJECT')
    scenes.edit(*objects)
    for ob in objects:
        scenes.select_faces(ob, lambda _face: True)


def rim_heights(V: Array, x: float) -> tuple[Array, Array]:
    """The rim of a sheet at its side x: y, ascending, and z."""
    rim = V[np.abs(V[:, 0] - x) < 1e-5]
    rim = rim[np.argsort(rim[:, 1])]
    return rim[:, 1], rim[:, 2]


def flush(left: Array, right: Array, gap: float) -> Array:
    """By how much the right rim is higher, at the left one's vertices."""
    (y, one), (other_y, other) = rim_heights(left, -0.5 * gap), rim_heights(right, 0.5 * gap)
    return np.interp(y, other_y, other) - one


@pytest.mark.parametrize("gap", [0.0, 0.004, 0.016])
@pytest.mark.parametrize("kind", list(MATRICES))
def test_two_objects_in_edit_mode_become_one_surface(kind: str, gap: float) -> None:
    right = half("Right", 0.5 * gap, 1.0, lambda x, y: bent(-x, y), 17, MATRICES[kind])
    left = half("Left", -1.0, -0.5 * gap, bent)
    start_several(left, right)
    before = scenes.world(left), scenes.world(right)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    after = scenes.world(left), scenes.world(right)
    print(kind, gap, kink(*before, gap), kink(*after, gap))
    assert kink(*before, gap) > 5.0 and kink(*after, gap) < 0.3
    assert np.abs(flush(*after, gap) - flush(*before, gap)).max() < 3e-5  # the rims have different vertices
    assert np.array_equal(after[0][:, :2], before[0][:, :2])


def dented(x: float, y: float) -> float:
    return scenes.crown(x, y) - 0.008 * np.exp(-(x**2 + y**2) / 0.1**2)


def test_several_objects_are_pressed_alike_whatever_their_order() -> None:
    results = []
    for order in (1, -1):
        bpy.ops.wm.read_homefile(use_empty=True)
        right, left = half("Right", 0.002, 1.0, dented, 17), half("Left", -1.0, -0.002, bent)
        start_several(*(left, right)[::order])
        scenes.smooth(border='follow')
        results.append(np.concatenate([scenes.world(left), scenes.world(right)]))
    assert np.array_equal(*results)


def test_an_object_that_cannot_be_solved_leaves_the_others_to_be() -> None:
    """What looks away from the view is left, and told of."""
    right, left = half("Right", 0.002, 1.0, dented, 17), half("Left", -1.0, -0.002, dented)
    away = half("Away", 3.0, 4.0, dented)
    away.data.flip_normals()
    start_several(left, right, away)
    before = scenes.world(left), scenes.world(right), scenes.world(away)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    after = scenes.world(left), scenes.world(right), scenes.world(away)
    assert [np.array_equal(*pair) for pair in zip(before, after, strict=True)] == [False, False, True]


def test_a_linked_neighbour_is_followed_and_stays(tmp_path: Path) -> None:
    """An object of another file cannot be edited, and is read all the same."""
    right = half("Right", 0.0, 1.0, scenes.crown)
    bpy.data.libraries.write(str(tmp_path / "right.blend"), {right})
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "right.blend"), link=True) as (_, linked):
        linked.objects = ["Right"]
    right = bpy.data.objects["Right"]
    bpy.context.collection.objects.link(right)
    left = half("Left", -1.0, 0.0, bent)
    start(left)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    assert kink(scenes.world(left), scenes.world(right), 0.0) < 0.3


def test_an_instance_of_a_collection_is_followed() -> None:
    right = half("Right", 0.0, 1.0, scenes.crown)
    panels = bpy.data.collections.new("Panels")
    panels.objects.link(right)
    bpy.context.collection.objects.unlink(right)
    instance = bpy.data.objects.new("Instance", None)
    instance.instance_type, instance.instance_collection = 'COLLECTION', panels
    bpy.context.collection.objects.link(instance)
    left = half("Left", -1.0, 0.0, bent)
    start(left)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    assert kink(scenes.world(left), scenes.world(right), 0.0) < 0.3
