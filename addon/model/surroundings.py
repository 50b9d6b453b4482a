"""The faces around a region, from which its border takes the curvature."""
from dataclasses import dataclass

import numpy as np

from .mesh_snapshot import MeshSnapshot
from .mirror import number_images

RINGS = 4  # of faces around the region: a fit at its border takes in three rings of vertices


@dataclass(frozen=True)
class Surroundings:
    """Triangles beside a region of n vertices; F names the region's by 0 .. n - 1, and those of V by n and more."""
    V: np.ndarray  # #S x 3, world space
    F: np.ndarray  # #G x 3, oriented as the region's


NOTHING_AROUND = Surroundings(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))


def join_images(around: Surroundings, mirrored: np.ndarray, seam: np.ndarray, own: int, image: np.ndarray,
                joined: int) -> Surroundings:
    """Joins the surroundings of a region with their mirror images: `mirrored` are the positions of those (#S x 3),
    `seam` the vertices on the plane (#S, bool), which are their own images, `own` the number of the region's vertices,
    `image` (#own) the vertex of the joined region at each one's image, and `joined` the number of its vertices.
    """
    first = np.where(own <= around.F, around.F - own + joined, around.F)
    name = np.concatenate([image, joined + number_images(seam)[0]])
    return Surroundings(np.concatenate([around.V, mirrored[~seam]]),
                        np.concatenate([first, name[around.F][:, ::-1]]))


def find_surroundings(snapshot: MeshSnapshot, index: np.ndarray, V: np.ndarray, margin: float) -> Surroundings:
    """Finds the surroundings of the region, whose vertices are `index` (#V); V (#vertices x 3) is the whole mesh in
    world space. Hidden faces count, too, but those of find_readable only: surroundings are advice, and no reason to
    refuse the region.

    With a margin all faces connected with the region count that have a vertex in its bounding box widened by it.
    """
    corners, sizes = snapshot.mesh.corners, snapshot.mesh.sizes
    found = find_within(corners, sizes, V, index, margin) if margin else find_rings(corners, sizes, len(V), index)
    beside = found & ~snapshot.region & find_readable(corners, sizes, V)
    if not beside.any():
        return NOTHING_AROUND
    F = snapshot.cut_faces(beside, V)
    own = np.setdiff1d(F, index)
    number = np.full(len(V), -1)
    number[index], number[own] = np.arange(len(index)), len(index) + np.arange(len(own))
    return Surroundings(V[own], number[F[:, ::-1] if snapshot.is_turned else F])


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
