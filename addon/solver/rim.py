"""The rim of a region: how a solve bends the edges that its faces share with those beside it."""
import numpy as np

from ..model.patch import Patch
from .turned_faces import compute_unit_normals

BENT = np.radians(0.5)  # radians; an edge of a calm panel that bends by as much more is seen as a crease in its stripes


def measure_bend(patch: Patch, positions: np.ndarray) -> float:
    """Measures by how much more the rim bends with the region's vertices at `positions` (#V x 3) than before: the
    largest growth of an edge's angle, radians; 0 where no face lies beside the region.
    """
    around = patch.around
    first, second = find_shared_edges(patch.F, around.F, len(patch.V) + len(around.V))
    if not len(first):
        return 0.0
    angles = []
    for V in (patch.V, positions):
        inside, beside = (compute_unit_normals(np.concatenate([V, around.V]), F) for F in (patch.F, around.F))
        across = np.linalg.norm(np.cross(inside[first], beside[second]), axis=1)
        angles.append(np.arctan2(across, (inside[first] * beside[second]).sum(axis=1)))
    return float((angles[1] - angles[0]).max())


def find_shared_edges(F: np.ndarray, G: np.ndarray, vertices: int) -> tuple[np.ndarray, np.ndarray]:
    """Finds the edges that a triangle of F (#F x 3) shares with one of G: the numbers of both, #edges each."""
    keys, triangles = zip(*(list_edges(each, vertices) for each in (F, G)), strict=True)
    _, one, other = np.intersect1d(*keys, return_indices=True)
    return triangles[0][one], triangles[1][other]


def list_edges(F: np.ndarray, vertices: int) -> tuple[np.ndarray, np.ndarray]:
    """Lists a number for each edge of triangles, the same both ways, and the triangle that it is of."""
    low, high = np.sort(np.stack([F, np.roll(F, -1, axis=1)]).astype(np.int64), axis=0)
    return (low * vertices + high).ravel(), np.repeat(np.arange(len(F)), 3)
