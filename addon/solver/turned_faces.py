"""Faces that a solve would turn far: a move along the view slides a steep face over its neighbour."""
import numpy as np

from ..model.patch import Patch

TURNED = np.radians(45.0)  # radians; triangles that turn further are held
# Of a patch's triangles. Where more of them turn, it is the wanted lines that turn them, and holding helps nobody.
MOST_HELD = 0.02


def find_turned(patch: Patch, positions: np.ndarray) -> np.ndarray:
    """Finds the triangles that new positions turn by more than TURNED: #F, bool."""
    before, after = compute_unit_normals(patch.V, patch.F), compute_unit_normals(positions, patch.F)
    flat = ~before.any(axis=1)
    return ((before * after).sum(axis=1) < np.cos(TURNED)) & ~flat


def find_vertices_to_hold(patch: Patch, turned: np.ndarray) -> np.ndarray | None:
    """Returns the vertices (#V, bool) without whose moves no triangle turns; None where none turns, or too many do."""
    if not 0 < turned.sum() <= max(1, MOST_HELD * len(turned)):
        return None
    held = np.zeros(len(patch.V), dtype=bool)
    held[patch.F[turned].ravel()] = True
    return held


def compute_unit_normals(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Returns the unit normals of triangles: #F x 3; zero where a triangle has no area."""
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    normals = np.cross(b - a, c - a)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
