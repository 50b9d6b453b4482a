"""The moves of rims: a smooth function through the moves of the vertices on both sides of a gap."""
from dataclasses import dataclass

import numpy as np

from ..model.joined_patch import RimMoves
from ..model.line_surface import cross

# The power of the distance that weights fall with: a panel whose mesh is 16 times as dense as the other's would get a
# fold of 1.3 degrees behind its rim with 0, of 0.1 with 2, and less with 4.
NEARER = 4
NEAREST = 1e-6  # distance in radii below which weights no longer grow
SPAN = 2.2  # radius of the fits, over the widest row and gap: three rows of vertices on both sides


@dataclass(frozen=True)
class NodePlaces:
    """The vertices of a joined patch in the image plane, and of its image where it is solved with that."""
    xy: np.ndarray    # #V x 2
    area: np.ndarray  # #V: what each stands for
    span: float       # widest row and gap
    source: np.ndarray  # #V: the vertex of the patch that each one is, or is the image of


def find_node_areas(xy: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Returns a third of the area of the triangles around each vertex: #V."""
    a, b, c = (xy[F[:, k]] for k in range(3))
    area = np.abs(cross(b - a, c - a)) / 6.0
    return np.bincount(F.ravel(), np.repeat(area, 3), len(xy))


def weigh_moves(place: NodePlaces, xy: np.ndarray, moved: np.ndarray) -> RimMoves:
    """Returns the weights by which vertices `moved` of a panel (xy: #V x 2) move: the value there of a cubic that is
    fitted to the moves nearby, the more the nearer. So they are a smooth function of the place alone, and both rims of
    a gap without width move alike.
    """
    radius = SPAN * place.span
    cells = Cells(place.xy, radius)
    sources, weights = [], []
    for point in xy[moved]:
        near = cells.find_near(point)
        offset = (place.xy[near] - point) / radius
        distance = np.hypot(offset[:, 0], offset[:, 1])
        inside = distance < 1.0
        sources.append(place.source[near[inside]])
        weights.append(fit_value(offset[inside], distance[inside], place.area[near[inside]]))
    first = np.cumsum([0, *(len(each) for each in sources)])[:-1]
    empty = np.zeros(0)
    return RimMoves(moved, first, np.concatenate([empty.astype(np.int64), *sources]),
                     np.concatenate([empty, *weights]))


class Cells:
    """Points of a plane by the square cells that they lie in."""

    def __init__(self, xy: np.ndarray, width: float) -> None:
        self.low, self.width = xy.min(axis=0) - 1.5 * width, width
        column, row = self.find_cell(xy).T
        self.rows = int(row.max()) + 2
        keys = column * self.rows + row
        self.order = np.argsort(keys, kind="stable")
        self.keys = keys[self.order]

    def find_cell(self, points: np.ndarray) -> np.ndarray:
        return np.floor((points - self.low) / self.width).astype(np.int64)

    def find_near(self, point: np.ndarray) -> np.ndarray:
        """Returns the points in the cell of a point and those around, ascending."""
        column, row = self.find_cell(point)
        row = min(max(row, 1), self.rows - 2)
        found = []
        for each in range(column - 1, column + 2):
            ends = np.searchsorted(self.keys, [each * self.rows + row - 1, each * self.rows + row + 2])
            found.append(self.order[ends[0]:ends[1]])
        return np.sort(np.concatenate(found))


def fit_value(offset: np.ndarray, distance: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Returns the weights (#N) of the values at places (#N x 2, from -1 to 1) in that of the fitted cubic at 0."""
    x, y = offset.T
    basis = np.stack([x**i * y**j for i in range(4) for j in range(4 - i)], axis=1)
    fade = (1.0 - distance)**4 * (4.0 * distance + 1.0)
    weight = area * fade / np.maximum(distance, NEAREST)**NEARER
    root = np.sqrt(weight / max(float(weight.max(initial=0.0)), 1e-300))
    return np.linalg.pinv(root[:, None] * basis, rcond=1e-9)[0] * root
