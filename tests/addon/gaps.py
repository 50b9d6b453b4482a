"""Builds panels beside a gap, measures the lines across it as Check does, and tells whether a tool kept them."""
import sys
from collections.abc import Callable, Sequence

import bpy
import numpy as np

import scenes

Array = np.ndarray
Surface = tuple[Array, Array]  # V #V x 3, F #F x 3
MEASURES = ("gap", "flush", "kink", "line_offset")


def build_sheet(name: str, columns: Callable[[float], Array], rows: Array, height: scenes.Height) -> bpy.types.Object:
    """Builds a sheet of quads with columns that depend on y."""
    points = [(x, y, height(x, y)) for y in rows for x in columns(y)]
    return scenes.linked(name, points, scenes.quads(len(columns(0.0)), len(rows)))


def find_moves(objects: Sequence[bpy.types.Object], was: Sequence[Array]) -> list[Array]:
    """Returns how far the vertices of objects have moved in the world (#V x 3 each)."""
    return [scenes.world(ob) - old for ob, old in zip(objects, was, strict=True)]


def assert_undone(objects: Sequence[bpy.types.Object], was: Sequence[Array]) -> None:
    """Holds that one undo brings every bit from before."""
    names = [ob.name for ob in objects]
    bpy.ops.ed.undo()
    assert not any(move.any() for move in find_moves([bpy.data.objects[name] for name in names], was))


def measure(one: Surface, other: Surface, seen: object) -> tuple[dict[str, Array], Array]:
    """Measures a gap in a view along the edges of the first surface: gap and flush, the kink in degrees, the lines'
    offset in percent of their spacing; and the middles of these edges, #E x 3.
    """
    addon, stripes = sys.modules["reflection_lines"], bpy.context.scene.reflection_lines.stripes
    (V, F), (W, G) = one, other
    found = addon.native.reflines.check_shut_lines(
        V, V, F, np.ones(len(F), dtype=bool), W, G, label=np.zeros(len(G), dtype=int),
        view_direction=seen.view_direction, line_direction=seen.line_direction, spacing=2.0 * np.pi / stripes.count)
    return {name: getattr(found.after, name) for name in MEASURES}, V[found.edges].mean(axis=1)


def choose(values: dict[str, Array], chosen: Array) -> dict[str, Array]:
    assert chosen.sum() > 10
    return {name: each[chosen] for name, each in values.items()}


def assert_kept(before: dict[str, Array], after: dict[str, Array], *, kink: float, offset: float, fit: float) -> None:
    """Holds that the worst kink and offset rose by less than these, and gap and flush changed by less than `fit`."""
    assert after["kink"].max() < before["kink"].max() + kink
    assert after["line_offset"].max() < before["line_offset"].max() + offset
    assert np.abs(after["flush"] - before["flush"]).max() < fit
    assert np.abs(after["gap"] - before["gap"]).max() < fit
