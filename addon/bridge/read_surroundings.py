"""Reads the faces around the region of a mesh."""
import bpy
import numpy as np

from ..model.surroundings import NOTHING_AROUND, Surroundings
from . import read_mesh

RINGS = 4  # of faces around the region: a fit at its border takes in three rings of vertices


def read_surroundings(mesh: bpy.types.Mesh, faces: np.ndarray, index: np.ndarray, V: np.ndarray,
                      margin: float = 0.0) -> Surroundings:
    """Reads the surroundings of the chosen faces, whose vertices are `index` (#V of the mesh); V (#vertices x 3) is the
    whole mesh in world space. In Edit Mode the mesh must have been updated from it. Hidden faces count, too.

    With a margin all faces connected with the region count that have a vertex in its bounding box widened by it.
    """
    corners, sizes = read_mesh.read_corners(mesh)
    found = find_within(corners, sizes, V, index, margin) if margin else find_rings(corners, sizes, len(V), index)
    beside = found & ~faces
    around = corners[np.repeat(beside, sizes)]
    if not beside.any() or not np.isfinite(V[around]).all():
        return NOTHING_AROUND
    F = cut_fans(around, sizes[beside])
    own = np.setdiff1d(F, index)
    number = np.full(len(V), -1)
    number[index], number[own] = np.arange(len(index)), len(index) + np.arange(len(own))
    return Surroundings(V[own], number[F])


def find_within(corners: np.ndarray, sizes: np.ndarray, V: np.ndarray, index: np.ndarray, margin: float) -> np.ndarray:
    """Finds the faces (#faces, bool) connected with the vertices `index` through the widened box of these."""
    low, high = V[index].min(axis=0), V[index].max(axis=0)
    with np.errstate(invalid="ignore"):
        inside = (np.abs(V - 0.5 * (low + high)) <= 0.5 * (high - low) + margin).all(axis=1)
    near = np.logical_or.reduceat(inside[corners], np.cumsum(sizes) - sizes)
    numbers = np.flatnonzero(near)
    own_corners, own_sizes = corners[np.repeat(near, sizes)], sizes[near]
    found = np.zeros(len(sizes), dtype=bool)
    found[numbers[find_rings(own_corners, own_sizes, len(V), index, rings=len(numbers))]] = True
    return found


def find_rings(corners: np.ndarray, sizes: np.ndarray, vertices: int, index: np.ndarray,
               rings: int = RINGS) -> np.ndarray:
    """Finds the faces (#faces, bool) within so many rings of the vertices `index`."""
    face_of_corner = np.repeat(np.arange(len(sizes)), sizes)
    reached = np.zeros(vertices, dtype=bool)
    reached[index] = True
    found = np.zeros(len(sizes), dtype=bool)
    for _ in range(rings):
        before = found.sum()
        found[face_of_corner[reached[corners]]] = True
        if found.sum() == before:
            break
        reached[corners[found[face_of_corner]]] = True
    return found


def cut_fans(corners: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Cuts faces into triangles from their first corners: #triangles x 3."""
    starts = np.cumsum(sizes) - sizes
    counts = sizes - 2
    first = np.repeat(starts, counts)
    step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.stack([corners[first], corners[first + step + 1], corners[first + step + 2]], axis=1)
