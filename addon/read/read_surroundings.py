"""Reads the faces around the region of a mesh."""
import bpy
import numpy as np

from ..model import triangulation
from ..model.surroundings import NOTHING_AROUND, Surroundings
from . import read_mesh

RINGS = 4  # of faces around the region: a fit at its border takes in three rings of vertices


def read_surroundings(mesh: bpy.types.Mesh, faces: np.ndarray, index: np.ndarray, V: np.ndarray,
                      margin: float = 0.0) -> Surroundings:
    """Reads the surroundings of the chosen faces, whose vertices are `index` (#V of the mesh); V (#vertices x 3) is the
    whole mesh in world space. In Edit Mode the mesh must have been updated from it. Hidden faces count, too, but those
    of find_readable only: surroundings are advice, and no reason to refuse the region.

    With a margin all faces connected with the region count that have a vertex in its bounding box widened by it.
    """
    corners, sizes = read_mesh.read_corners(mesh)
    found = find_within(corners, sizes, V, index, margin) if margin else find_rings(corners, sizes, len(V), index)
    beside = found & ~faces & find_readable(corners, sizes, V)
    if not beside.any():
        return NOTHING_AROUND
    F = cut_faces(mesh, beside, corners[np.repeat(beside, sizes)], sizes[beside], V)
    own = np.setdiff1d(F, index)
    number = np.full(len(V), -1)
    number[index], number[own] = np.arange(len(index)), len(index) + np.arange(len(own))
    return Surroundings(V[own], number[F])


def find_readable(corners: np.ndarray, sizes: np.ndarray, V: np.ndarray) -> np.ndarray:
    """Finds the faces (#faces, bool) whose coordinates are finite. Where those of an n-gon are not, n-gons are none of
    them: Blender cuts those of the whole mesh at once, and must not get such coordinates.
    """
    broken = np.logical_or.reduceat(~np.isfinite(V).all(axis=1)[corners], np.cumsum(sizes) - sizes)
    return ~broken & ~((sizes > 4) & (broken & (sizes > 4)).any())


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


def cut_faces(mesh: bpy.types.Mesh, faces: np.ndarray, around: np.ndarray, sizes: np.ndarray,
              V: np.ndarray) -> np.ndarray:
    """Cuts the faces (#faces, bool) with these corners and sizes into triangles as Blender does: #triangles x 3. Fans
    would give those without area where a corner lies on a line with its neighbours.
    """
    if sizes.max() <= 4:
        return triangulation.triangulate_short_faces(around, sizes, V)
    return read_mesh.read_region_triangles(mesh, faces)
