"""Panels that meet over gaps as one patch, and the way back to each of them.

The rows of triangles at the gap are left out, and a strip of triangles takes their place, which lies between the rows
of vertices behind both rims: no sliver as narrow as the gap is among them. What moves the rims is a smooth function
through the moves on both sides, the same for both: so it adds neither step nor kink.
"""
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .creases import Creases
from .meeting import find_middle
from .patch import Patch
from .solution import Solution


@dataclass(frozen=True)
class RimMoves:
    """The moves of a panel's vertices at the gap as sums of moves of the joined patch."""
    vertex: np.ndarray  # #S, vertices of the panel
    first: np.ndarray   # #S: where the terms of each begin
    source: np.ndarray  # #terms, vertices of the joined patch
    weight: np.ndarray  # #terms

    def sum(self, move: np.ndarray) -> np.ndarray:
        """Returns the moves (#S x 3) from those of the joined patch's vertices (#V x 3)."""
        if not len(self.vertex):
            return np.zeros((0, 3))
        return np.add.reduceat(self.weight[:, None] * move[self.source], self.first)


NO_RIM = RimMoves(*(np.zeros(0, dtype=np.int64) for _ in range(3)), np.zeros(0))


@dataclass(frozen=True)
class PanelPart:
    """The part of the joined patch that belongs to one panel."""
    panel: Patch
    vertex: np.ndarray    # #V of the panel: vertex of the joined patch, -1 where there is none
    triangle: np.ndarray  # #F of the panel: triangle of the joined patch, or the nearest one
    rim: RimMoves


@dataclass(frozen=True)
class JoinedPatch(Patch):
    """A patch that stands for several, in world space; its heights are those of the panels without steps."""
    parts: tuple[PanelPart, ...]
    towards: np.ndarray  # 3, unit vector to the viewer

    @property
    def panels(self) -> tuple[Patch, ...]:
        return tuple(part.panel for part in self.parts)

    @property
    def center(self) -> np.ndarray:
        """The middle of the panels with their rims, which the view of all of them is that of."""
        return find_middle(self.panels)

    def level(self, move: np.ndarray, _limit: float) -> np.ndarray:
        """Returns the moves (#V x 3) as they are: the rims of meshes follow them."""
        return move


def cut_moves(move: np.ndarray, towards: np.ndarray, limit: float, ranges: np.ndarray | None) -> np.ndarray:
    """Cuts moves (#S x 3) along the direction to the viewer to the limit, or to ranges (#S x 2) of it."""
    if not np.isfinite(limit):
        return move
    along = move @ towards
    low, high = (-limit, limit) if ranges is None else limit * ranges.T
    return move + (np.clip(along, low, high) - along)[:, None] * towards


def join_creases(panels: Sequence[Patch], vertex: Sequence[np.ndarray]) -> Creases:
    """Returns the marked edges of all panels, whose vertices are these of the joined patch, but those that end at the
    gap.
    """
    marked = np.concatenate([own[panel.creases.marked] for panel, own in zip(panels, vertex, strict=True)])
    return Creases(panels[0].creases.rule, marked[(marked >= 0).all(axis=1)])


def join_ranges(panels: Sequence[Patch], vertex: Sequence[np.ndarray]) -> np.ndarray | None:
    """Returns likewise the ranges of the limit of all vertices; None where all of them have all of it."""
    if all(panel.limit_range is None for panel in panels):
        return None
    whole = np.array([-1.0, 1.0])
    return np.concatenate([np.tile(whole, (int((own >= 0).sum()), 1)) if panel.limit_range is None
                           else panel.limit_range[own >= 0] for panel, own in zip(panels, vertex, strict=True)])


def gather_values(patch: Patch, values: Mapping[str, np.ndarray], otherwise: float) -> np.ndarray:
    """Returns values of meshes' vertices, by the objects' names, for the vertices (#V) of a patch, which may be a
    joined one; another one for the panels without values.
    """
    if not isinstance(patch, JoinedPatch):
        return values[patch.name][patch.index]
    result = np.full(len(patch.V), otherwise)
    for part in patch.parts:
        if part.panel.name in values:
            own = part.vertex >= 0
            result[part.vertex[own]] = values[part.panel.name][part.panel.index[own]]
    return result


def split_positions(patch: Patch, positions: np.ndarray, limit: float = np.inf) -> list[np.ndarray]:
    """Returns the positions of each panel (#V x 3, world space) from those of a patch, which may be a joined one.

    No vertex at the gap moves further than the limit, or its own range of it.
    """
    if not isinstance(patch, JoinedPatch):
        return [positions]
    move = patch.level(positions - patch.V, limit)
    return [move_panel(part, move, patch.towards, limit) for part in patch.parts]


def move_panel(part: PanelPart, move: np.ndarray, towards: np.ndarray, limit: float) -> np.ndarray:
    """Returns a panel's positions after moves of the joined patch (#V x 3)."""
    V = part.panel.V.copy()
    own = part.vertex >= 0
    V[own] += move[part.vertex[own]]
    ranges = None if part.panel.limit_range is None else part.panel.limit_range[part.rim.vertex]
    V[part.rim.vertex] += cut_moves(part.rim.sum(move), towards, limit, ranges)
    return V


def split_solution(solution: Solution, limit: float) -> list[Solution]:
    """Returns the solution of each panel from that of a patch, which may be a joined one; the limit 0 is the automatic
    one.
    """
    patch = solution.patch
    if not isinstance(patch, JoinedPatch):
        return [solution]
    positions = split_positions(patch, solution.positions, limit or solution.automatic_limit or np.inf)
    return [replace(solution, patch=part.panel, positions=own, residual=solution.residual[part.triangle])
            for part, own in zip(patch.parts, positions, strict=True)]
