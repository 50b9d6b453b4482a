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
from test_across_gap import start_several
from test_joined_panels import FIT, GAP, KINK, OFFSET, list_triangles, straighten, turn

Array = np.ndarray
VIEWS = {"even": ((0.0, 0.0, 1.0), (0.0, 0.9, 0.4)), "uneven": ((0.0, 0.0, 1.0), (0.7, 0.3, 0.4)),
         "oblique": ((0.3, 0.3, 1.0), (0.0, 0.9, 0.4))}


def height(x: float, y: float) -> float:
    """Symmetric about x = 0."""
    return scenes.crown(x, y) + 0.002 * np.cos(3.0 * x) * np.sin(2.0 * y + 0.4)


def sheet(name: str, columns: Array, rows: Array) -> bpy.types.Object:
    ob = gaps.build_sheet(name, lambda _y: columns, rows, height)
    ob.modifiers.new("Mirror", 'MIRROR')
    return ob


# Where panels lie in x and y: Front and Rear, whose gap crosses the seam, or Wing beside Bonnet, which alone has one.
PAIRS = {"across": {"Rear": ((0.0, 1.0), (0.5 * GAP, 1.0)), "Front": ((0.0, 1.0), (-1.0, -0.5 * GAP))},
         "along": {"Bonnet": ((0.0, 0.5 - 0.5 * GAP), (-1.0, 1.0)), "Wing": ((0.5 + 0.5 * GAP, 1.2), (-1.0, 1.0))}}
COUNTS = {"Rear": (21, 22), "Front": (26, 25), "Bonnet": (16, 43), "Wing": (20, 49)}  # of columns and rows


def start(gap: str, view: str, build: Callable = sheet, counts: dict[str, tuple[int, int]] = COUNTS,
          ) -> tuple[bpy.types.Object, bpy.types.Object]:
    """The panels of a pair, the second of which is active and returned first. Nothing else is left."""
    scenes.remove_all()
    second, first = (build(name, *(np.linspace(*ends, count) for ends, count in zip(sides, counts[name], strict=True)))
                     for name, sides in PAIRS[gap].items())
    start_several(second, first)
    bpy.ops.reflines.set_up(part='CAMERA', direction=VIEWS[view][0])
    bpy.ops.reflines.set_up(part='LIGHT', direction=VIEWS[view][1])
    bpy.ops.ed.undo_push(message="Start")
    return first, second


def with_image(ob: bpy.types.Object) -> tuple[Array, Array]:
    """The mesh as the modifier leaves it, its seam joined."""
    V, F = scenes.world(ob), list_triangles(ob)
    seam = V[:, 0] == 0.0
    image = np.where(seam, np.arange(len(V)), len(V) + np.cumsum(~seam) - 1)
    return np.concatenate([V, V[~seam] * (-1.0, 1.0, 1.0)]), np.concatenate([F, image[F][:, ::-1]])


def measure_gap(one: bpy.types.Object, other: bpy.types.Object) -> dict[str, Array]:
    addon, scene = sys.modules["reflection_lines"], bpy.context.scene
    seen = addon.view.facing.read_patch_view(scene, addon.read.gather.gather_patch(one))
    found, middle = gaps.measure(with_image(one), with_image(other), seen)
    return gaps.choose(found, (np.abs(middle) < 0.8).all(axis=1))


def turn_beside(border: str = 'automatic') -> set[str]:
    return turn((0.35, 0.1, 0.0), radius=0.45, border=border)


TOOLS: dict[str, Callable] = {"turn": turn_beside, "straighten": lambda: straighten(border='automatic'),
                              "smooth": lambda: scenes.smooth(length=3.0)}


@pytest.mark.parametrize("view", list(VIEWS))
@pytest.mark.parametrize("gap", ["across", "along"])
@pytest.mark.parametrize("tool", list(TOOLS))
def test_lines_run_on_over_the_gap_and_seams_stay_in_the_plane(tool: str, gap: str, view: str) -> None:
    pair = start(gap, view)
    before, was = measure_gap(*pair), [scenes.world(ob) for ob in pair]
    assert TOOLS[tool]() == {'FINISHED'}
    after = measure_gap(*pair)
    moves = gaps.find_moves(pair, was)
    rims = [np.linalg.norm(move, axis=1)[find_rim(ob, gap)].max() for move, ob in zip(moves, pair, strict=True)]
    print(tool, gap, view, rims, *(float(after[name].max()) for name in ("kink", "line_offset")))
    assert min(rims) > 5e-5
    for move, old in zip(moves, was, strict=True):
        assert not move[old[:, 0] == 0.0, slice(0, 1 if view == "even" else 3)].any()
    assert after["kink"].max() < before["kink"].max() + KINK
    assert after["line_offset"].max() < before["line_offset"].max() + OFFSET
    assert np.abs(after["flush"] - before["flush"]).max() < FIT
    towards = np.array(VIEWS[view][0]) / np.linalg.norm(VIEWS[view][0])
    for move in moves:  # the gap's width as seen from the view
        assert np.linalg.norm(np.cross(move, towards), axis=1).max() < 1e-6
    if view != "oblique":
        assert np.abs(after["gap"] - before["gap"]).max() < FIT
    gaps.assert_undone(pair, was)


def find_rim(ob: bpy.types.Object, gap: str) -> Array:
    V = scenes.world(ob)
    return np.flatnonzero(np.abs(V[:, 1] if gap == "across" else V[:, 0] - 0.5) < GAP)


@pytest.mark.parametrize("gap", ["across", "along"])
@pytest.mark.parametrize("settings", [{"direction": 'MEAN', "centre": 'EVERYWHERE'}, {"density": 1.1, "radius": 0.6}])
def test_halves_get_what_the_wholes_get(settings: dict, gap: str) -> None:
    """Whether the modifiers are applied or not."""
    moves = []
    for applied in (False, True):
        pair = start(gap, "even")
        counts = [len(ob.data.vertices) for ob in pair]
        if applied:
            scenes.object_mode()
            for ob in pair:
                scenes.activate(ob)
                bpy.ops.object.modifier_apply(modifier="Mirror")
            scenes.edit(*pair)
            bpy.ops.mesh.select_all(action='SELECT')
        was = [scenes.world(ob) for ob in pair]
        assert bpy.ops.reflines.direction('EXEC_DEFAULT', True, **settings) == {'FINISHED'}
        moves.append([move[:count, 2] for move, count in zip(gaps.find_moves(pair, was), counts, strict=True)])
    for half, whole in zip(*moves, strict=True):
        print(settings, gap, np.abs(half - whole).max(), np.abs(whole).max())
        assert np.abs(half - whole).max() < 1e-6 < 1e-3 * np.abs(whole).max()


@pytest.mark.parametrize("border", ["automatic", "follow"])
def test_a_panel_without_an_image_is_not_one_with_a_panel_that_has_one(border: str) -> None:
    """The image would move, too, and what faces that would not."""
    wing, bonnet = pair = start("along", "even")
    scenes.object_mode()
    wing.modifiers.clear()
    scenes.edit(*pair)
    was = [scenes.world(ob) for ob in pair]
    assert turn_beside(border) == {'FINISHED'}
    assert not any(move[find_rim(ob, "along")].any() for ob, move in
                   zip(pair, gaps.find_moves(pair, was), strict=True))
    assert ("here it was Tangent" in bonnet.reflection_lines.report.notes) == (border == "follow")


@pytest.mark.parametrize("place", [0.0, 0.1])
def test_an_image_about_another_object_is_one_about_the_same_plane(place: float) -> None:
    """A wing with an origin of its own, mirrored about an empty in the plane of the bonnet's mirror, or beside that."""
    wing, bonnet = pair = start("along", "uneven")
    scenes.object_mode()
    empty = bpy.data.objects.new("Middle", None)
    bpy.context.collection.objects.link(empty)
    empty.location = (place, 3.0, 1.0)
    wing.data.transform(scenes.Matrix.Translation((-0.9, 0.2, 0.1)))
    wing.location = (0.9, -0.2, -0.1)
    wing.modifiers["Mirror"].mirror_object = empty
    bpy.context.view_layer.update()
    scenes.edit(*pair)
    was = [scenes.world(ob) for ob in pair]
    assert turn_beside() == {'FINISHED'}
    moves = gaps.find_moves(pair, was)
    moved = [np.abs(move)[find_rim(ob, "along")].max() for ob, move in zip(pair, moves, strict=True)]
    assert min(moved) > 1e-4 if place == 0.0 else max(moved) == 0.0
    assert not moves[1][was[1][:, 0] == 0.0].any()


def test_a_pull_on_a_panel_moves_its_image_and_the_rims_alike() -> None:
    pair = start("across", "even")
    before, was = measure_gap(*pair), [scenes.world(ob) for ob in pair]
    handle = {"start": (0.3, -0.1, height(0.3, -0.1)), "end": (0.32, -0.09, height(0.32, -0.09)), "radius": 0.5,
              "pinned": [], "muted": False}
    assert bpy.ops.reflines.pull_line('EXEC_DEFAULT', True, handles=json.dumps([handle])) == {'FINISHED'}
    after = measure_gap(*pair)
    moves = gaps.find_moves(pair, was)
    assert min(np.abs(move)[find_rim(ob, "across")].max() for ob, move in zip(pair, moves, strict=True)) > 1e-5
    assert after["kink"].max() < before["kink"].max() + KINK
    assert not any(move[old[:, 0] == 0.0, 0].any() for move, old in zip(moves, was, strict=True))
