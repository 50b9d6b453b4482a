"""Cages whose surfaces meet over gaps as one cage, and the way back to each of them.

The cages keep their vertices and faces. Of their surfaces the rows of triangles at the gap are left out, and a bridge
of triangles takes their place, so that the lines that are solved for run on over it.
"""
from dataclasses import dataclass

import numpy as np

from .cage import CagePatch
from .meeting import find_middle
from .patch import Patch


def cut_moves(move: np.ndarray, towards: np.ndarray, limit: float, ranges: np.ndarray | None) -> np.ndarray:
    """Cuts moves (#S x 3) along the direction to the viewer to the limit, or to ranges (#S x 2) of it."""
    if not np.isfinite(limit):
        return move
    along = move @ towards
    low, high = (-limit, limit) if ranges is None else limit * ranges.T
    return move + (np.clip(along, low, high) - along)[:, None] * towards


@dataclass(frozen=True)
class Bridge:
    """The triangles over the gaps, as arguments of reflines.CageOptimizer."""
    F: np.ndarray         # #T x 3, vertices of the surfaces of all cages
    parent: np.ndarray    # #T: the face of the cage that each counts as one of
    left_out: np.ndarray  # #triangles of the surfaces, bool

    def build_arguments(self) -> dict[str, np.ndarray]:
        return {"bridge": self.F, "bridge_parent": self.parent, "left_out": self.left_out}


@dataclass(frozen=True)
class RimLevel:
    """The further moves of vertices of cages at a gap, so that both rims of their surfaces move alike."""
    vertex: np.ndarray  # #S, vertices of the joined patch
    source: np.ndarray  # #N, those that their moves depend on
    weight: np.ndarray  # #S x #N


@dataclass(frozen=True)
class JoinedCagePatch(CagePatch):
    """A patch that stands for several cages, in world space; its heights are those of the panels without steps."""
    parts: tuple[CagePatch, ...]
    bridge: Bridge
    rim: RimLevel
    towards: np.ndarray  # 3, unit vector to the viewer

    @property
    def panels(self) -> tuple[Patch, ...]:
        return self.parts

    @property
    def center(self) -> np.ndarray:
        """The middle of the panels, which the view of all of them is that of."""
        return find_middle(self.parts)

    def split_positions(self, positions: np.ndarray, limit: float) -> list[np.ndarray]:
        """Returns the positions of each panel (#V x 3) from those of the patch. No vertex at the gap moves further than
        the limit, or its own range of it, so that no rim of a surface does.
        """
        move, rim = positions - self.V, self.rim.vertex
        ranges = None if self.limit_range is None else self.limit_range[rim]
        move[rim] = cut_moves(move[rim] + self.rim.weight @ move[self.rim.source], self.towards, limit, ranges)
        ends = np.cumsum([len(part.V) for part in self.parts])[:-1]
        return [part.V + own for part, own in zip(self.parts, np.split(move, ends), strict=True)]

    def split_triangles(self, values: np.ndarray) -> list[np.ndarray]:
        """Returns values at the patch's triangles (#F) for each panel's."""
        return np.split(values, np.cumsum([len(part.F) for part in self.parts])[:-1])
