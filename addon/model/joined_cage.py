"""Cages whose surfaces meet over gaps as one cage, a joined patch whose panels keep their vertices and faces.

Of their surfaces the rows of triangles at the gap are left out, and a bridge of triangles takes their place, so that
the lines that are solved for run on over it.
"""
from dataclasses import dataclass

import numpy as np

from .cage import CagePatch
from .joined_patch import JoinedPatch, cut_moves


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
class JoinedCagePatch(JoinedPatch, CagePatch):
    """A joined patch of cages, whose vertices at the gap are levelled."""
    bridge: Bridge
    rim: RimLevel

    def level(self, move: np.ndarray, limit: float) -> np.ndarray:
        """Levels the moves (#V x 3) at the gap. None of them goes further than the limit, or its own range of it, so
        that no rim of a surface does.
        """
        rim = self.rim.vertex
        ranges = None if self.limit_range is None else self.limit_range[rim]
        move[rim] = cut_moves(move[rim] + self.rim.weight @ move[self.rim.source], self.towards, limit, ranges)
        return move
