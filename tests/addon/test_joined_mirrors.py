"""Panels below Mirror modifiers that face each other over a gap: they are solved as one, with their images where view
and light are symmetric, and no seam leaves the mirror plane.
"""
import json
import sys
from collections.abc import Callable

import bpy
import numpy as np
import pytest

import gaps
import scenes
from test_across_gap import places, start_several
from test_joined_panels import FIT, GAP, KINK, OFFSET, list_triangles, remove_all

Array = np.ndarray
VIEWS = {"even": ((0.0, 0.0, 1.0), (0.0, 0.9, 0.4)), "uneven": ((0.0, 0.0, 1.0), (0.7, 0.3, 0.4)),
         "oblique": ((0.3, 0.3, 1.0), (0.0, 0.9, 0.4))}


def height(x: float, y: float) -> float:
    """Symmetric about x = 0."""
    return scenes.crown(x, y) + 0.002 * np.cos(3.0 * x) * np.sin(2.0 * y + 0.4)


def sheet(name: str, columns: Array, rows: Array) -> bpy.types.Object:
    points = [(x, y, height(x, y)) for y in rows for x in columns]
    count = len(columns)
    faces = [(i, i + 1, i + count + 1, i + count) for j in range(len(rows) - 1)
             for i in range(j * count, (j + 1) * count - 1)]
    ob = scenes.linked(name, points, faces)
    ob.modifiers.new("Mirror", 'MIRROR')
    return ob


def start(gap: str, view: str) -> tuple[bpy.types.Object, bpy.types.Object]:
    """Front and Rear, whose gap crosses the seam, or Wing beside Bonnet, which alone has one; the first is active."""
    h = 0.5 * GAP
    if gap == "across":
        second = sheet("Rear", np.linspace(0.0, 1.0, 21), np.linspace(h, 1.0, 22))
        first = sheet("Front", np.linspace(0.0, 1.0, 26), np.linspace(-1.0, -h, 25))
    else:
        second = sheet("Bonnet", np.linspace(0.0, 0.5 - h, 16), np.linspace(-1.0, 1.0, 43))
        first = sheet("Wing", np.linspace(0.5 + h, 1.2, 20), np.linspace(-1.0, 1.0, 49))
    start_several(second, first)
    bpy.ops.reflines.set_up(part='CAMERA', direction=VIEWS[view][0])
    bpy.ops.reflines.set_up(part='LIGHT', direction=VIEWS[view][1])
    bpy.ops.ed.undo_push(message="Start")
    return first, second


def with_image(ob: bpy.types.Object) -> tuple[Array, Array]:
    """The mesh as the modifier leaves it, its seam joined."""
    V, F = places(ob), list_triangles(ob)
    seam = V[:, 0] == 0.0
    image = np.where(seam, np.arange(len(V)), len(V) + np.cumsum(~seam) - 1)
    return np.concatenate([V, V[~seam] * (-1.0, 1.0, 1.0)]), np.concatenate([F, image[F][:, ::-1]])


def measure_gap(one: bpy.types.Object, other: bpy.types.Object) -> dict[str, Array]:
    addon, scene = sys.modules["reflection_lines"], bpy.context.scene
    seen = addon.view.facing.read_patch_view(scene, addon.read.gather.gather_patch(one))
    found, middle = gaps.measure(with_image(one), with_image(other), seen)
    return gaps.choose(found, (np.abs(middle) < 0.8).all(axis=1))


def turn(**settings: object) -> set[str]:
    bpy.context.scene.cursor.location = (0.35, 0.1, 0.0)
    return bpy.ops.reflines.direction('EXEC_DEFAULT', True, **{"angle": 0.3, "centre": 'CURSOR', "radius": 0.45,
                                                               **settings})


def straighten(**settings: object) -> set[str]:
    return bpy.ops.reflines.direction('EXEC_DEFAULT', True, **{"direction": 'MEAN', "centre": 'EVERYWHERE', **settings})


TOOLS: dict[str, Callable] = {"turn": turn, "straighten": straighten,
                              "smooth": lambda: scenes.smooth(length=3.0)}


@pytest.mark.parametrize("view", list(VIEWS))
@pytest.mark.parametrize("gap", ["across", "along"])
@pytest.mark.parametrize("tool", list(TOOLS))
def test_lines_run_on_over_the_gap_and_seams_stay_in_the_plane(tool: str, gap: str, view: str) -> None:
    pair = start(gap, view)
    before, was = measure_gap(*pair), [places(ob) for ob in pair]
    assert TOOLS[tool]() == {'FINISHED'}
    after = measure_gap(*pair)
    moves = [np.linalg.norm(places(ob) - old, axis=1) for ob, old in zip(pair, was, strict=True)]
    rims = [move[find_rim(ob, gap)].max() for move, ob in zip(moves, pair, strict=True)]
    print(tool, gap, view, rims, *(float(after[name].max()) for name in ("kink", "line_offset")))
    assert min(rims) > 5e-5
    for ob, old in zip(pair, was, strict=True):
        seam = old[:, 0] == 0.0
        assert np.array_equal(places(ob)[seam, 0], old[seam, 0])
        if view != "even":
            assert np.array_equal(places(ob)[seam], old[seam])
    assert after["kink"].max() < before["kink"].max() + KINK
    assert after["line_offset"].max() < before["line_offset"].max() + OFFSET
    assert np.abs(after["flush"] - before["flush"]).max() < FIT
    towards = np.array(VIEWS[view][0]) / np.linalg.norm(VIEWS[view][0])
    for ob, old in zip(pair, was, strict=True):  # the gap's width as seen from the view
        assert np.linalg.norm(np.cross(places(ob) - old, towards), axis=1).max() < 1e-6
    if view != "oblique":
        assert np.abs(after["gap"] - before["gap"]).max() < FIT
    bpy.ops.ed.undo()
    assert all(np.array_equal(places(bpy.data.objects[ob.name]), old) for ob, old in zip(pair, was, strict=True))


def find_rim(ob: bpy.types.Object, gap: str) -> Array:
    V = places(ob)
    return np.flatnonzero(np.abs(V[:, 1] if gap == "across" else V[:, 0] - 0.5) < GAP)


@pytest.mark.parametrize("gap", ["across", "along"])
@pytest.mark.parametrize("settings", [{"direction": 'MEAN', "centre": 'EVERYWHERE'}, {"density": 1.1, "radius": 0.6}])
def test_halves_get_what_the_wholes_get(settings: dict, gap: str) -> None:
    """Whether the modifiers are applied or not."""
    moves = []
    for applied in (False, True):
        remove_all()
        pair = start(gap, "even")
        counts = [len(ob.data.vertices) for ob in pair]
        if applied:
            scenes.object_mode()
            for ob in pair:
                scenes.activate(ob)
                bpy.ops.object.modifier_apply(modifier="Mirror")
            scenes.edit(*pair)
            bpy.ops.mesh.select_all(action='SELECT')
        was = [places(ob) for ob in pair]
        assert bpy.ops.reflines.direction('EXEC_DEFAULT', True, **settings) == {'FINISHED'}
        moves.append([(places(ob) - old)[:count, 2] for ob, old, count in zip(pair, was, counts, strict=True)])
    for half, whole in zip(*moves, strict=True):
        print(settings, gap, np.abs(half - whole).max(), np.abs(whole).max())
        assert np.abs(half - whole).max() < 1e-6 < 1e-3 * np.abs(whole).max()


def test_the_order_of_the_panels_changes_no_bit() -> None:
    shapes = []
    for name in ("Front", "Rear"):
        remove_all()
        pair = start("across", "even")
        bpy.context.view_layer.objects.active = bpy.data.objects[name]
        assert straighten() == {'FINISHED'}
        shapes.append([places(ob) for ob in pair])
    assert all(np.array_equal(*each) for each in zip(*shapes, strict=True))


@pytest.mark.parametrize("border", ["automatic", "follow"])
def test_a_panel_without_an_image_is_not_one_with_a_panel_that_has_one(border: str) -> None:
    """The image would move, too, and what faces that would not."""
    wing, bonnet = pair = start("along", "even")
    scenes.object_mode()
    wing.modifiers.clear()
    scenes.edit(*pair)
    was = [places(ob) for ob in pair]
    assert turn(border=border) == {'FINISHED'}
    assert all(np.array_equal(places(ob)[find_rim(ob, "along")], old[find_rim(ob, "along")])
               for ob, old in zip(pair, was, strict=True))
    assert ("here it was Tangent" in bonnet.reflection_lines.report.notes) == (border == "follow")


@pytest.mark.parametrize("place", [0.0, 0.1])
def test_an_image_about_another_object_is_one_about_the_same_plane(place: float) -> None:
    """A wing with an origin of its own, mirrored about an empty in the plane of the bonnet's mirror, or beside that."""
    wing, bonnet = start("along", "uneven")
    scenes.object_mode()
    empty = bpy.data.objects.new("Middle", None)
    bpy.context.collection.objects.link(empty)
    empty.location = (place, 3.0, 1.0)
    wing.data.transform(scenes.Matrix.Translation((-0.9, 0.2, 0.1)))
    wing.location = (0.9, -0.2, -0.1)
    wing.modifiers["Mirror"].mirror_object = empty
    bpy.context.view_layer.update()
    scenes.edit(wing, bonnet)
    was = [places(ob) for ob in (wing, bonnet)]
    assert turn() == {'FINISHED'}
    moved = [np.abs(places(ob) - old)[find_rim(ob, "along")].max() for ob, old in
             zip((wing, bonnet), was, strict=True)]
    assert min(moved) > 1e-4 if place == 0.0 else max(moved) == 0.0
    seam = was[1][:, 0] == 0.0
    assert np.array_equal(places(bonnet)[seam], was[1][seam])


def test_a_pull_on_a_panel_moves_its_image_and_the_rims_alike() -> None:
    front, rear = pair = start("across", "even")
    before, was = measure_gap(*pair), [places(ob) for ob in pair]
    handle = {"start": (0.3, -0.1, height(0.3, -0.1)), "end": (0.32, -0.09, height(0.32, -0.09)), "radius": 0.5,
              "pinned": [], "muted": False}
    assert bpy.ops.reflines.pull_line('EXEC_DEFAULT', True, handles=json.dumps([handle])) == {'FINISHED'}
    after = measure_gap(*pair)
    assert min(np.abs(places(ob) - old)[find_rim(ob, "across")].max() for ob, old in
               zip(pair, was, strict=True)) > 1e-5
    assert after["kink"].max() < before["kink"].max() + KINK
    assert not places(front)[was[0][:, 0] == 0.0, 0].any() and not places(rear)[was[1][:, 0] == 0.0, 0].any()
