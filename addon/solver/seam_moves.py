"""The moves of rims: a smooth function through the moves of the vertices on both sides of a gap."""
from dataclasses import dataclass

import numpy as np

from ..model.joined_patch import SeamMoves

SPAN = 2.2  # radius of the fits, over the widest row and gap: three rows of vertices on both sides


@dataclass(frozen=True)
class SeamPlace:
    """The vertices of a joined patch in the image plane."""
    xy: np.ndarray    # #V x 2
    area: np.ndarray  # #V: what each stands for
    span: float       # widest row and gap


def find_node_areas(xy: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Returns a third of the area of the triangles around each vertex: #V."""
    a, b, c = (xy[F[:, k]] for k in range(3))
    u, v = b - a, c - a
    area = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 6.0
    return np.bincount(F.ravel(), np.repeat(area, 3), len(xy))


def weigh_moves(place: SeamPlace, xy: np.ndarray, moved: np.ndarray) -> SeamMoves:
    """Returns the weights by which vertices `moved` of a panel (xy: #V x 2) move: the value there of a cubic that is
    fitted to the moves nearby, the more the nearer. So they are a smooth function of the place alone, and both rims of
    a gap without width move alike.
    """
    radius = SPAN * place.span
    near = find_near_box(place.xy, xy[moved], radius)
    sources, weights = [], []
    for point in xy[moved]:
        offset = (place.xy[near] - point) / radius
        distance = np.hypot(offset[:, 0], offset[:, 1])
        inside = distance < 1.0
        sources.append(near[inside])
        weights.append(fit_value(offset[inside], distance[inside], place.area[near[inside]]))
    first = np.cumsum([0, *(len(each) for each in sources)])[:-1]
    empty = np.zeros(0)
    return SeamMoves(moved, first, np.concatenate([empty.astype(np.int64), *sources]),
                     np.concatenate([empty, *weights]))


def find_near_box(xy: np.ndarray, points: np.ndarray, margin: float) -> np.ndarray:
    """Finds the vertices in the box around points."""
    if not len(points):
        return np.zeros(0, dtype=np.int64)
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return np.flatnonzero(((xy >= low) & (xy <= high)).all(axis=1))


def fit_value(offset: np.ndarray, distance: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Returns the weights (#N) of the values at places (#N x 2, from -1 to 1) in that of the fitted cubic at 0."""
    x, y = offset.T
    basis = np.stack([x**i * y**j for i in range(4) for j in range(4 - i)], axis=1)
    weight = area * (1.0 - distance)**4 * (4.0 * distance + 1.0)
    root = np.sqrt(weight / max(float(weight.max(initial=0.0)), 1e-300))
    return np.linalg.pinv(root[:, None] * basis, rcond=1e-9)[0] * root
