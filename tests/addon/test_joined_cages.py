"""Cages whose surfaces face each other over a gap: they are solved as one, so that lines run on over the gap as before.
"""
import json
import sys
from collections.abc import Callable

import bpy
import numpy as np
import pytest

import scenes
from test_across_gap import places, start_several
from test_joined_panels import FIT, GAP, KINK, TOOLS, bow, height, remove_all, straighten, turn

Array = np.ndarray
OFFSET = 3.0  # percent of the lines' spacing that a tool may add: of meshes 2.0, see there


def sheet(name: str, columns: Callable[[float], Array], rows: Array, levels: int) -> bpy.types.Object:
    points = [(x, y, height(x, y)) for y in rows for x in columns(y)]
    count = len(columns(0.0))
    faces = [(i, i + 1, i + count + 1, i + count) for j in range(len(rows) - 1)
             for i in range(j * count, (j + 1) * count - 1)]
    ob = scenes.linked(name, points, faces)
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = levels
    lay_on_surface(ob)
    return ob


def lay_on_surface(ob: bpy.types.Object) -> None:
    """Moves the cage so that its limit surface has the heights: with its own ones a rim would be half a degree off."""
    refined = subdivide(read_cage(ob), 3)
    data, column, first = refined.matrix()
    S = np.zeros((len(first) - 1, len(ob.data.vertices)))
    for row in range(len(S)):
        S[row, column[first[row]:first[row + 1]]] = data[first[row]:first[row + 1]]
    V = places(ob)
    place = S @ V
    z = np.linalg.lstsq(S, np.array([height(*each) for each in place[:, :2]]), rcond=None)[0]
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
    remove_all()
    middle = bow if kind == "curved" else (lambda _y: 0.0)
    right = sheet("Right", lambda y: np.linspace(middle(y) + 0.5 * GAP, 1.0, 11), np.linspace(-1.0, 1.0, 19), levels)
    left = sheet("Left", lambda y: np.linspace(-1.0, middle(y) - 0.5 * GAP, 13), np.linspace(-1.0, 1.0, 25), levels)
    start_several(right, left)
    bpy.ops.ed.undo_push(message="Start")
    return left, right


def surface(ob: bpy.types.Object, level: int = 3) -> tuple[Array, Array]:
    """The limit surface of the cage as a mesh."""
    cage = read_cage(ob)
    refined = subdivide(cage, level)
    return refined.positions(cage.V), refined.faces[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)


def measure_gap(left: bpy.types.Object, right: bpy.types.Object) -> dict[str, Array]:
    addon, scene = sys.modules["reflection_lines"], bpy.context.scene
    seen = addon.view.facing.read_patch_view(scene, addon.read.gather.gather_patch(left))
    (V, F), (W, G) = surface(left), surface(right)
    found = addon.native.reflines.check_shut_lines(
        V, V, F, np.ones(len(F), dtype=bool), W, G, label=np.zeros(len(G), dtype=int),
        view_direction=seen.view_direction, line_direction=seen.line_direction,
        spacing=2.0 * np.pi / scene.reflection_lines.stripes.count)
    inner = np.abs(V[found.edges].mean(axis=1)[:, 1]) < 0.8
    return {name: getattr(found.after, name)[inner] for name in ("gap", "flush", "kink", "line_offset")}


@pytest.mark.parametrize("levels", [2, 3])
@pytest.mark.parametrize("kind", ["straight", "curved"])
@pytest.mark.parametrize("tool", list(TOOLS))
def test_lines_run_on_over_the_gap_as_before(tool: str, kind: str, levels: int) -> None:
    """The border of a surface is straight across it, so that these have a kink of 1.2 degrees at the gap to begin with.
    """
    left, right = start(kind, levels)
    before, was = measure_gap(left, right), [places(left), places(right)]
    assert TOOLS[tool](border='automatic') == {'FINISHED'}
    after = measure_gap(left, right)
    rims = [np.abs(places(ob) - old)[find_rim(old, kind), 2].max() for ob, old in zip((left, right), was, strict=True)]
    print(tool, kind, levels, rims,
          *(float(after[name].max() - before[name].max()) for name in ("kink", "line_offset")),
          *(float(np.abs(after[name] - before[name]).max()) for name in ("flush", "gap")))
    assert min(rims) > 4e-5
    assert after["kink"].max() < before["kink"].max() + KINK
    assert after["line_offset"].max() < before["line_offset"].max() + OFFSET
    assert np.abs(after["flush"] - before["flush"]).max() < FIT
    assert np.abs(after["gap"] - before["gap"]).max() < FIT
    bpy.ops.ed.undo()
    assert all(np.array_equal(places(bpy.data.objects[name]), old)
               for name, old in zip(("Left", "Right"), was, strict=True))


def find_rim(V: Array, kind: str = "straight") -> Array:
    return np.flatnonzero(np.abs(V[:, 0] - (bow(V[:, 1]) if kind == "curved" else 0.0)) < GAP)


def test_the_order_of_the_cages_changes_no_bit() -> None:
    shapes = []
    for active in ("Left", "Right"):
        pair = start()
        bpy.context.view_layer.objects.active = bpy.data.objects[active]
        assert straighten(border='automatic') == {'FINISHED'}
        shapes.append([places(ob) for ob in pair])
    assert all(np.array_equal(*each) for each in zip(*shapes, strict=True))


def test_cages_of_other_levels_are_one_and_of_other_rules_are_not() -> None:
    for name, value in (("levels", 3), ("use_limit_surface", False)):
        left, right = start()
        setattr(right.modifiers[0], name, value)
        was = [places(left), places(right)]
        assert turn(border='follow') == {'FINISHED'}
        rims = [np.abs(places(ob) - old)[find_rim(old), 2].max() for ob, old in zip((left, right), was, strict=True)]
        assert (min(rims) > 1e-4) == (name == "levels") and (max(rims) > 0.0) == (name == "levels")
        assert ("here it was Tangent" in left.reflection_lines.report.notes) == (name != "levels")


@pytest.mark.parametrize("side", ['OUTWARD', 'INWARD'])
def test_rims_keep_to_the_limit_and_to_its_side(side: str) -> None:
    left, right = start()
    was = [surface(ob, 2)[0] for ob in (left, right)]  # as finely as it is solved for
    for ob in (left, right):
        ob.reflection_lines.limit_side = side
    assert turn(limit=4e-4, border='automatic') == {'FINISHED'}
    for ob, old in zip((left, right), was, strict=True):
        move = (1.0 if side == 'OUTWARD' else -1.0) * (surface(ob, 2)[0] - old)[:, 2]
        assert move.min() >= -1e-6 and 5e-5 < move[find_rim(old)].max() <= 4.001e-4
        assert move.max() <= 4.01e-4  # behind the rims, which are levelled after the solve


def test_a_part_of_a_cage_is_joined_where_it_ends_at_the_gap() -> None:
    left, right = start()
    scenes.select_faces(right, lambda face: face < 10 * 9)  # the lower half, in rows of 10
    was = places(right)
    assert turn(border='automatic') == {'FINISHED'}
    moved = np.abs(places(right) - was)[:, 2] > 0.0
    assert moved[find_rim(was)].any() and not moved[was[:, 1] > 1e-6].any()
    assert np.abs(places(left)[find_rim(places(left)), 2]).max() > 0.0


@pytest.mark.parametrize("tool", ["straighten", "pull"])
def test_re_solve_moves_both_again(tool: str) -> None:
    left, right = start()
    assert TOOLS[tool](border='automatic') == {'FINISHED'}
    was = [places(left), places(right)]
    scenes.object_mode()
    bpy.context.view_layer.objects.active = left
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert all(np.abs(places(ob) - old).max() < 1e-6 for ob, old in zip((left, right), was, strict=True))


@pytest.mark.parametrize("gap", [0.0, GAP])
def test_three_cages_that_meet_in_a_t_move_as_one(gap: float) -> None:
    remove_all()
    h = 0.5 * gap
    upper = sheet("Upper", lambda _y: np.linspace(h, 1.0, 9), np.linspace(h, 1.0, 11), 2)
    lower = sheet("Lower", lambda _y: np.linspace(h, 1.0, 11), np.linspace(-1.0, -h, 9), 2)
    left = sheet("Left", lambda _y: np.linspace(-1.0, -h, 13), np.linspace(-1.0, 1.0, 25), 2)
    start_several(upper, lower, left)
    every = {ob.name: ob for ob in (left, lower, upper)}
    before = [measure_gap(*pair) for pair in ((left, lower), (left, upper), (lower, upper))]
    assert turn(border='automatic') == {'FINISHED'}
    after = [measure_gap(*pair) for pair in ((left, lower), (left, upper), (lower, upper))]
    assert json.loads(left.reflection_lines.run.joined) == sorted(every)
    for one, other in zip(before, after, strict=True):
        print(gap, *(float(other[name].max() - one[name].max()) for name in ("kink", "line_offset")),
              float(np.abs(other["flush"] - one["flush"]).max()))
        assert other["kink"].max() < one["kink"].max() + 3.0 * KINK
