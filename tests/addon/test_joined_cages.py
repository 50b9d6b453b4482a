"""Cages whose surfaces face each other over a gap: they are solved as one, so that lines run on over the gap as before.
"""
import json
import sys
from collections.abc import Callable

import bpy
import numpy as np
import pytest

import gaps
import scenes
import test_joined_mirrors as mirrors
import test_joined_panels as panels
from test_across_gap import start_several

Array = np.ndarray
COUNTS = {"Rear": (9, 10), "Front": (11, 11), "Bonnet": (7, 20), "Wing": (8, 23)}  # of mirrored cages, as of panels
OFFSET = 3.0  # percent of the lines' spacing that a tool may add: of meshes 2.0, see there


def sheet(name: str, columns: Callable[[float], Array], rows: Array, levels: int, *,
          mirrored: bool = False) -> bpy.types.Object:
    shape = mirrors.height if mirrored else panels.height
    ob = gaps.build_sheet(name, columns, rows, shape)
    if mirrored:
        ob.modifiers.new("Mirror", 'MIRROR')
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = levels
    lay_on_surface(ob, shape)
    return ob


def lay_on_surface(ob: bpy.types.Object, shape: Callable[[float, float], float]) -> None:
    """Moves the cage so that its limit surface has the heights: with its own ones a rim would be half a degree off."""
    cage, count = read_cage(ob), len(ob.data.vertices)
    data, column, first = subdivide(cage, 2).matrix()
    S = np.zeros((len(first) - 1, len(cage.V)))
    for row in range(len(S)):
        S[row, column[first[row]:first[row + 1]]] = data[first[row]:first[row + 1]]
    place = S @ cage.V
    images = np.flatnonzero(cage.partner[:count] >= count)
    S[:, images] += S[:, cage.partner[images]]
    z = np.linalg.lstsq(S[:, :count], np.array([shape(*each) for each in place[:, :2]]), rcond=None)[0]
    for vertex, own in zip(ob.data.vertices, z, strict=True):
        vertex.co.z = own
    ob.data.update()


def read_cage(ob: bpy.types.Object) -> object:
    return sys.modules["reflection_lines"].read.gather.gather_patch(ob, or_all=True).cage


def subdivide(cage: object, level: int) -> object:
    reflines = sys.modules["reflection_lines"].native.reflines
    return reflines.Subdivision(**{**cage.build_topology_arguments(), "level": level}, vertices=len(cage.V))


def start(kind: str = "straight", levels: int = 2) -> tuple[bpy.types.Object, bpy.types.Object]:
    """Left, which is active, and Right, all faces selected; their cages have other faces."""
    scenes.remove_all()
    middle = panels.bow if kind == "curved" else (lambda _y: 0.0)
    h = 0.5 * panels.GAP
    right = sheet("Right", lambda y: np.linspace(middle(y) + h, 1.0, 11), np.linspace(-1.0, 1.0, 19), levels)
    left = sheet("Left", lambda y: np.linspace(-1.0, middle(y) - h, 13), np.linspace(-1.0, 1.0, 25), levels)
    start_several(right, left)
    bpy.ops.ed.undo_push(message="Start")
    return left, right


def surface(ob: bpy.types.Object, level: int = 3) -> tuple[Array, Array]:
    """The limit surface of the cage as a mesh."""
    cage = read_cage(ob)
    refined = subdivide(cage, level)
    return refined.positions(cage.V), refined.faces[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)


def lies_inside(middle: Array) -> Array:
    return np.abs(middle[:, 1]) < 0.8


def measure_gap(left: bpy.types.Object, right: bpy.types.Object,
                inner: Callable[[Array], Array] = lies_inside) -> dict[str, Array]:
    addon, scene = sys.modules["reflection_lines"], bpy.context.scene
    seen = addon.view.facing.read_patch_view(scene, addon.read.gather.gather_patch(left))
    found, middle = gaps.measure(surface(left), surface(right), seen)
    return gaps.choose(found, inner(middle))


@pytest.mark.parametrize(("kind", "levels"), [("straight", 2), ("curved", 2), ("curved", 3)])
@pytest.mark.parametrize("tool", list(panels.TOOLS))
def test_lines_run_on_over_the_gap_as_before(tool: str, kind: str, levels: int) -> None:
    """The border of a surface is straight across it, so that these have a kink of 1.2 degrees at the gap to begin with.
    """
    left, right = start(kind, levels)
    before, was = measure_gap(left, right), [scenes.world(left), scenes.world(right)]
    assert panels.TOOLS[tool](border='automatic') == {'FINISHED'}
    after = measure_gap(left, right)
    rims = find_rim_moves((left, right), was, kind)
    print(tool, kind, levels, rims,
          *(float(after[name].max() - before[name].max()) for name in ("kink", "line_offset")),
          *(float(np.abs(after[name] - before[name]).max()) for name in ("flush", "gap")))
    assert min(rims) > 4e-5
    gaps.assert_kept(before, after, kink=panels.KINK, offset=OFFSET, fit=panels.FIT)
    gaps.assert_undone((left, right), was)


def find_rim(V: Array, kind: str = "straight") -> Array:
    return np.flatnonzero(np.abs(V[:, 0] - (panels.bow(V[:, 1]) if kind == "curved" else 0.0)) < panels.GAP)


def find_rim_moves(pair: tuple[bpy.types.Object, bpy.types.Object], was: list[Array],
                   kind: str = "straight") -> list[float]:
    return [np.abs(move)[find_rim(old, kind), 2].max()
            for move, old in zip(gaps.find_moves(pair, was), was, strict=True)]


@pytest.mark.parametrize("begin", [panels.start, lambda: mirrors.start("across", "even"), start],
                         ids=["panels", "mirrored panels", "cages"])
def test_the_order_changes_no_bit(begin: Callable) -> None:
    shapes = []
    for active in (0, 1):
        pair = begin()
        bpy.context.view_layer.objects.active = pair[active]
        assert panels.straighten(border='automatic') == {'FINISHED'}
        shapes.append([scenes.world(ob) for ob in pair])
    assert all(np.array_equal(*each) for each in zip(*shapes, strict=True))


def test_cages_of_other_levels_are_one_and_of_other_rules_are_not() -> None:
    for name, value in (("levels", 3), ("use_limit_surface", False)):
        left, right = start()
        setattr(right.modifiers[0], name, value)
        was = [scenes.world(left), scenes.world(right)]
        assert panels.turn(border='follow') == {'FINISHED'}
        rims = find_rim_moves((left, right), was)
        assert (min(rims) > 1e-4) == (name == "levels") and (max(rims) > 0.0) == (name == "levels")
        assert ("here it was Tangent" in left.reflection_lines.report.notes) == (name != "levels")


@pytest.mark.parametrize("side", ['OUTWARD', 'INWARD'])
def test_rims_keep_to_the_limit_and_to_its_side(side: str) -> None:
    left, right = start()
    was = [surface(ob, 2)[0] for ob in (left, right)]  # as finely as it is solved for
    for ob in (left, right):
        ob.reflection_lines.limit_side = side
    assert panels.turn(limit=4e-4, border='automatic') == {'FINISHED'}
    for ob, old in zip((left, right), was, strict=True):
        move = (1.0 if side == 'OUTWARD' else -1.0) * (surface(ob, 2)[0] - old)[:, 2]
        assert move.min() >= -1e-6 and 5e-5 < move[find_rim(old)].max() <= 4.001e-4
        assert move.max() <= 4.01e-4  # behind the rims, which are levelled after the solve


def test_a_part_of_a_cage_is_joined_where_it_ends_at_the_gap() -> None:
    left, right = start()
    scenes.select_faces(right, lambda face: face < 10 * 9)  # the lower half, in rows of 10
    was = scenes.world(right)
    assert panels.turn(border='automatic') == {'FINISHED'}
    moved = np.abs(scenes.world(right) - was)[:, 2] > 0.0
    assert moved[find_rim(was)].any() and not moved[was[:, 1] > 1e-6].any()
    assert np.abs(scenes.world(left)[find_rim(scenes.world(left)), 2]).max() > 0.0


@pytest.mark.parametrize(("begin", "border"), [(panels.start, 'follow'), (start, 'automatic')],
                         ids=["panels", "cages"])
@pytest.mark.parametrize("tool", ["straighten", "pull"])
def test_re_solve_moves_both_again_and_leaves_no_step(tool: str, begin: Callable, border: str) -> None:
    pair = begin()
    assert panels.TOOLS[tool](border=border) == {'FINISHED'}
    was = [scenes.world(ob) for ob in pair]
    scenes.object_mode()
    bpy.context.view_layer.objects.active = pair[0]
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert all(np.abs(move).max() < 1e-6 for move in gaps.find_moves(pair, was))


@pytest.mark.parametrize("gap", [0.0, panels.GAP])
def test_three_cages_that_meet_in_a_t_move_as_one(gap: float) -> None:
    scenes.remove_all()
    h = 0.5 * gap
    upper = sheet("Upper", lambda _y: np.linspace(h, 1.0, 9), np.linspace(h, 1.0, 11), 2)
    lower = sheet("Lower", lambda _y: np.linspace(h, 1.0, 11), np.linspace(-1.0, -h, 9), 2)
    left = sheet("Left", lambda _y: np.linspace(-1.0, -h, 13), np.linspace(-1.0, 1.0, 25), 2)
    start_several(upper, lower, left)
    every = {ob.name: ob for ob in (left, lower, upper)}
    before = [measure_gap(*pair) for pair in ((left, lower), (left, upper), (lower, upper))]
    assert panels.turn(border='automatic') == {'FINISHED'}
    after = [measure_gap(*pair) for pair in ((left, lower), (left, upper), (lower, upper))]
    assert json.loads(left.reflection_lines.run.joined) == sorted(every)
    for one, other in zip(before, after, strict=True):
        print(gap, *(float(other[name].max() - one[name].max()) for name in ("kink", "line_offset")),
              float(np.abs(other["flush"] - one["flush"]).max()))
        assert other["kink"].max() < one["kink"].max() + 3.0 * panels.KINK


def mirrored_sheet(name: str, columns: Array, rows: Array) -> bpy.types.Object:
    return sheet(name, lambda _y: columns, rows, 2, mirrored=True)


@pytest.mark.parametrize("view", list(mirrors.VIEWS))
@pytest.mark.parametrize("gap", ["across", "along"])
@pytest.mark.parametrize("tool", ["turn", "straighten"])
def test_mirrored_cages_are_one_and_their_seams_stay_in_the_plane(tool: str, gap: str, view: str) -> None:
    pair = mirrors.start(gap, view, mirrored_sheet, COUNTS)
    inner = (lambda middle: (np.abs(middle) < 0.8).all(axis=1)) if gap == "across" else (
        lambda middle: np.abs(middle[:, 1]) < 0.8)
    before, was = measure_gap(*pair, inner), [scenes.world(ob) for ob in pair]
    assert mirrors.TOOLS[tool]() == {'FINISHED'}
    after = measure_gap(*pair, inner)
    moves = gaps.find_moves(pair, was)
    rims = [np.linalg.norm(move, axis=1)[mirrors.find_rim(ob, gap)].max()
            for ob, move in zip(pair, moves, strict=True)]
    print(tool, gap, view, rims, *(float(after[name].max() - before[name].max()) for name in ("kink", "line_offset")),
          float(np.abs(after["flush"] - before["flush"]).max()))
    assert min(rims) > 5e-5
    for move, old in zip(moves, was, strict=True):
        assert not move[old[:, 0] == 0.0, slice(0, 3 if view == "oblique" else 1)].any()
    assert after["kink"].max() < before["kink"].max() + 2.0 * panels.KINK
    assert np.abs(after["flush"] - before["flush"]).max() < panels.FIT
    gaps.assert_undone(pair, was)
