"""The strip of triangles between the rims of panels that meet over a gap, in the image plane."""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..model.line_surface import cross
from ..model.triangulation import list_border

# Takes points (#P x 2) and edges (#E x 2) of a plane, and returns Delaunay triangles (#F x 3) that keep the edges,
# counter-clockwise; None where there are none.
Triangulate = Callable[[np.ndarray, np.ndarray], "np.ndarray | None"]

FLAT = 1e-4    # area over the square of the longest side of a triangle that is none
WIDEST = 2.0  # length of a strip's edge over that of the widest row and gap


@dataclass(frozen=True)
class Rim:
    """A panel without the row of triangles at its rim."""
    xy: np.ndarray      # #V x 2, of the panel
    F: np.ndarray       # #F x 3, likewise
    outline: np.ndarray  # #O x 2: edges of one triangle alone
    vertex: np.ndarray  # #R: vertices of the rim
    stays: np.ndarray   # #F, bool: triangles without those
    edges: np.ndarray   # #E x 2: edges between the triangles that stay and the others
    depth: float        # of the row

    def is_used(self) -> np.ndarray:
        """Returns which vertices have triangles that stay: #V, bool."""
        return mark(len(self.xy), self.F[self.stays])


@dataclass(frozen=True)
class Strip:
    """The triangles between rims."""
    corners: list[list[tuple[int, int]]]  # of each triangle, a panel's number and its vertex
    meeting: frozenset[int]               # the panels that have such triangles with another one
    span: float                           # widest row and gap


def mark(count: int, numbers: np.ndarray) -> np.ndarray:
    """Returns which of so many are among the numbers: bool."""
    result = np.zeros(count, dtype=bool)
    result[numbers] = True
    return result


def cut_rim(xy: np.ndarray, F: np.ndarray, border: np.ndarray, vertex: np.ndarray, outline: np.ndarray) -> Rim:
    """Leaves the triangles at a rim out, with those at the vertices where its border goes on. The outline is the border
    and the seam, at which the panel goes on as its image.
    """
    gone = mark(len(xy), vertex)
    gone[border[gone[border].any(axis=1)]] = True
    stays = ~gone[F].any(axis=1)
    edges = list_border(F[stays])
    outer = {tuple(each) for each in outline.tolist()}
    edges = np.array([each for each in edges.tolist() if tuple(each) not in outer], dtype=np.int64).reshape(-1, 2)
    return Rim(xy, F, outline, vertex, stays, edges, measure_depth(xy, vertex, np.unique(edges)))


def measure_depth(xy: np.ndarray, vertex: np.ndarray, row: np.ndarray) -> float:
    """Measures how far the row behind a rim is from it: nine vertices of ten lie nearer."""
    if not len(row):
        return 0.0
    return float(np.quantile([np.linalg.norm(xy[row] - xy[v], axis=1).min() for v in vertex], 0.9))


def build_strip(rims: list[Rim], gap: float, triangulate: Triangulate) -> Strip | None:
    """Builds the triangles between the rows behind the rims; None where that fails, as for panels that overlap."""
    chains = [np.unique(rim.edges) for rim in rims]
    if not all(len(chain) for chain in chains):
        return None
    starts = np.cumsum([0, *(len(chain) for chain in chains)])
    points = np.concatenate([rim.xy[chain] for rim, chain in zip(rims, chains, strict=True)])
    edges = np.concatenate([start + np.searchsorted(chain, rim.edges)
                            for rim, chain, start in zip(rims, chains, starts[:-1], strict=True)])
    F = triangulate(points, edges)
    if F is None or not len(F):
        return None
    panel = np.repeat(np.arange(len(rims)), np.diff(starts))
    span = 2.0 * max(rim.depth for rim in rims) + gap
    along = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).max()
    F = F[choose_between(rims, points, panel, F, WIDEST * span + along)]
    mixed = F[(panel[F] != panel[F[:, :1]]).any(axis=1)]
    if not len(mixed):
        return None
    vertex = np.concatenate(chains)
    corners = [[(int(panel[p]), int(vertex[p])) for p in row] for row in F]
    return Strip(corners, frozenset(panel[mixed].ravel().tolist()), span)


def choose_between(rims: list[Rim], points: np.ndarray, panel: np.ndarray, F: np.ndarray, widest: float) -> np.ndarray:
    """Chooses the triangles between the panels (#F, bool): those of one panel only where it had triangles."""
    alone = (panel[F] == panel[F[:, :1]]).all(axis=1)
    sides = points[F] - points[np.roll(F, 1, axis=1)]
    longest = np.linalg.norm(sides, axis=2).max(axis=1)
    short = longest <= widest
    area = 0.5 * cross(points[F[:, 1]] - points[F[:, 0]], points[F[:, 2]] - points[F[:, 0]])
    flat = area < FLAT * longest**2  # of points on one line, beside the strip
    centre = points[F].mean(axis=1)
    chosen = np.zeros(len(F), dtype=bool)
    for which, rim in enumerate(rims):
        own = alone & ~flat & (panel[F[:, 0]] == which)
        chosen[own] = find_below(rim.xy[rim.F[~rim.stays]], centre[own])
    between = ~alone & short & ~flat
    for rim in rims:
        kept = rim.xy[rim.F[rim.stays]]
        inside = find_below(kept[is_near(kept, centre[between], 0.0)], centre[between])
        between[np.flatnonzero(between)[inside]] = False
    return chosen | between


def find_nearest_edges(edges: np.ndarray, points: np.ndarray,
                       within: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns for each point of the plane (#P x 2) the nearest edge (#E x 2 x 2), -1 where none lies within a distance,
    the fraction of its second end, and the distance.
    """
    count = len(points)
    nearest, fraction, distance = np.full(count, -1), np.zeros(count), np.full(count, np.inf)
    near = np.flatnonzero(is_near(edges, points, within))
    start, way = edges[near, 0], edges[near, 1] - edges[near, 0]
    length = np.maximum((way**2).sum(axis=1), 1e-300)
    for number, point in enumerate(points if len(near) else ()):
        along = np.clip(((point - start) * way).sum(axis=1) / length, 0.0, 1.0)
        apart = ((start + along[:, None] * way - point)**2).sum(axis=1)
        best = int(apart.argmin())
        if apart[best] <= within**2:
            nearest[number], fraction[number], distance[number] = near[best], along[best], np.sqrt(apart[best])
    return nearest, fraction, distance


def is_near(shapes: np.ndarray, points: np.ndarray, margin: float) -> np.ndarray:
    """Returns which triangles or edges (#N x corners x 2) have boxes that overlap that around points: #N, bool."""
    if not len(points):
        return np.zeros(len(shapes), dtype=bool)
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    return (shapes.max(axis=1) >= low).all(axis=1) & (shapes.min(axis=1) <= high).all(axis=1)


def find_below(triangles: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Finds the points (#P, bool) that lie in one of the triangles (#T x 3 x 2), which run counter-clockwise, or at its
    edge.
    """
    result = np.zeros(len(points), dtype=bool)
    a, side = triangles, np.roll(triangles, -1, axis=1) - triangles
    rounding = -1e-9 * (side**2).sum(axis=2)
    for number, point in enumerate(points):
        way = point - a
        turn = side[:, :, 0] * way[:, :, 1] - side[:, :, 1] * way[:, :, 0]
        result[number] = bool((turn >= rounding).all(axis=1).any())
    return result
