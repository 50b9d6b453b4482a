"""The lines of a region between its vertices: the place under a point, theta there, and the course of one line."""
from dataclasses import dataclass
from functools import cached_property

import numpy as np

INSIDE = -1e-9      # barycentric coordinate
MOST_STEPS = 4000   # triangles that one line is followed through
MOST_ROUNDS = 12    # of the search for the source of a line
EXACT = 1e-9        # radians


@dataclass(frozen=True)
class Place:
    """A point of the surface."""
    triangle: int
    weights: np.ndarray  # 3, barycentric


@dataclass(frozen=True)
class LineState:
    """The shape and the lines of a region at one moment."""
    V: np.ndarray      # #V x 3, world space
    theta: np.ndarray  # #V, radians in (-pi, pi]


class PlaneTriangles:
    """Triangles in a plane, such as the picture or the screen, in which points are found."""

    def __init__(self, points: np.ndarray, F: np.ndarray) -> None:
        """Takes points (#V x 2) that may be NaN where they cannot be seen."""
        self.a = points[F[:, 0]]
        self.ab, self.ac = points[F[:, 1]] - self.a, points[F[:, 2]] - self.a
        self.area = cross(self.ab, self.ac)

    def find(self, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns the triangles that contain a point, and its barycentric coordinates in each (#found x 3)."""
        with np.errstate(divide="ignore", invalid="ignore"):
            way = at - self.a
            v, w = cross(way, self.ac) / self.area, cross(self.ab, way) / self.area
            found = np.flatnonzero((v > INSIDE) & (w > INSIDE) & (v + w < 1.0 - INSIDE))
        v, w = v[found], w[found]
        return found, np.column_stack([1.0 - v - w, v, w])


    def weigh(self, triangle: int, at: np.ndarray) -> np.ndarray:
        """Returns the barycentric coordinates (3) of a point in a triangle, also outside of it."""
        way, ab, ac, area = at - self.a[triangle], self.ab[triangle], self.ac[triangle], self.area[triangle]
        v = (way[0] * ac[1] - way[1] * ac[0]) / area
        w = (ab[0] * way[1] - ab[1] * way[0]) / area
        return np.array([1.0 - v - w, v, w])


@dataclass(frozen=True)
class LineSurface:
    """A region at the start of a session, in which all places are looked up, so that these do not depend on the way."""
    start: LineState
    F: np.ndarray      # #F x 3
    frame: np.ndarray  # 3 x 3, rows: axes of the image plane, direction to the viewer

    @cached_property
    def picture(self) -> PlaneTriangles:
        return PlaneTriangles(self.start.V @ self.frame[:2].T, self.F)

    @cached_property
    def neighbors(self) -> np.ndarray:
        """The triangle across the edge opposite each corner: #F x 3, -1 at the border."""
        return find_neighbors(self.F)

    def find_place(self, point: np.ndarray) -> Place | None:
        """Returns the place at a point of world space, whatever its height along the view; None beside the region."""
        found, weights = self.picture.find(self.frame[:2] @ point)
        return Place(int(found[0]), weights[0]) if len(found) else None

    def read_point(self, place: Place, state: LineState) -> np.ndarray:
        return place.weights @ state.V[self.F[place.triangle]]

    def read_theta(self, place: Place, state: LineState) -> float:
        """Returns theta at a place, linear between vertices, radians."""
        corners = state.theta[self.F[place.triangle]]
        return float(corners[0] + place.weights @ wrap(corners - corners[0]))

    def read_gradient(self, triangle: int, state: LineState) -> np.ndarray:
        """Returns the gradient of theta along the surface (3)."""
        corners, theta = state.V[self.F[triangle]], state.theta[self.F[triangle]]
        edges = corners[1:] - corners[0]
        return np.linalg.pinv(edges) @ wrap(theta[1:] - theta[0])

    def find_source(self, place: Place, state: LineState) -> Place:
        """Returns the place that the line of `state` through a place had at the start."""
        return self.find_level(place, self.read_theta(place, state), self.start)

    def find_level(self, place: Place, value: float, state: LineState) -> Place:
        """Returns the place near another that the line of this value passes through, by Newton's method along the
        gradient; the other itself where that leaves the region.
        """
        found = place
        for _ in range(MOST_ROUNDS):
            missing = wrap(value - self.read_theta(found, state))
            if abs(missing) < EXACT:
                return found
            gradient = self.read_gradient(found.triangle, state)
            step = gradient * (missing / max(float(gradient @ gradient), 1e-300))
            found = self.walk(found.triangle, self.frame[:2] @ (self.read_point(found, state) + step))
            if found is None:
                return place
        return found

    def walk(self, triangle: int, at: np.ndarray) -> Place | None:
        """Returns the place at a point of the image plane, from triangle to triangle; None where the way leaves the
        region.
        """
        for _ in range(MOST_STEPS):
            weights = self.picture.weigh(triangle, at)
            outside = int(weights.argmin())
            if weights[outside] > INSIDE:
                return Place(triangle, weights)
            triangle = int(self.neighbors[triangle, outside])
            if triangle < 0:
                return None
        return None

    def trace(self, place: Place, state: LineState, value: float) -> np.ndarray:
        """Returns the line of a value of theta from a place both ways until the border: #P x 3, world space; empty
        where it does not pass through the place's triangle.
        """
        offset = wrap(state.theta - value)[self.F]  # #F x 3
        one, other = offset[:, [1, 2, 0]], offset[:, [2, 0, 1]]  # of the edge opposite each corner
        crossed = ((one < 0.0) != (other < 0.0)) & (np.abs(one - other) < np.pi)
        edges = np.flatnonzero(crossed[place.triangle]).tolist()
        if len(edges) < 2:
            return np.empty((0, 3))
        ways = [self.follow(place.triangle, edge, crossed) for edge in edges[:2]]
        line = np.array(ways[0][::-1] + ways[1])
        triangle, edge = line.T
        fraction = (one[triangle, edge] / (one[triangle, edge] - other[triangle, edge]))[:, None]
        first, last = (self.F[triangle, (edge + k) % 3] for k in (1, 2))
        return (1.0 - fraction) * state.V[first] + fraction * state.V[last]

    def trace_through(self, place: Place, state: LineState) -> np.ndarray:
        """Returns the line that is seen at a place likewise."""
        return self.trace(place, state, self.read_theta(place, state))

    def follow(self, triangle: int, edge: int, crossed: np.ndarray) -> list[tuple[int, int]]:
        """Returns the edges, each by a triangle and its opposite corner, that a line crosses from a triangle on;
        `crossed` (#F x 3) says which edges it does at all.
        """
        passed, first = [], triangle
        for _ in range(MOST_STEPS):
            passed.append((triangle, edge))
            beyond = int(self.neighbors[triangle, edge])
            if beyond < 0 or beyond == first:
                break
            across = self.neighbors[beyond].tolist()
            ways = [k for k, go in enumerate(crossed[beyond].tolist()) if go and across[k] != triangle]
            if not ways:
                break
            triangle, edge = beyond, ways[0]
        return passed


def find_neighbors(F: np.ndarray) -> np.ndarray:
    """Returns the triangle across the edge opposite each corner: #F x 3, -1 where there is none."""
    edges = np.sort(np.stack([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]], axis=1).reshape(-1, 2), axis=1)
    key = edges[:, 0].astype(np.int64) * (int(F.max()) + 1) + edges[:, 1]
    order = np.argsort(key, kind="stable")
    equal = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    result = np.full(len(key), -1, dtype=np.int64)
    result[order[equal]], result[order[equal + 1]] = order[equal + 1] // 3, order[equal] // 3
    return result.reshape(-1, 3)


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def wrap(angle: np.ndarray) -> np.ndarray:
    """Wraps differences of theta to [-pi, pi]; those within keep their bits."""
    return angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi))


def compute_mean_theta(theta: np.ndarray, points: np.ndarray) -> float:
    """Computes the mean of theta (#S, radians, in any turn) over the length of a stroke (#S x 3). Of all lines that of
    this value differs least from the stroke, by the mean of squares.
    """
    passed = np.linalg.norm(np.diff(points, axis=0), axis=1)
    turned = np.unwrap(theta)
    return float(passed @ (turned[1:] + turned[:-1]) / (2.0 * passed.sum()))


def thin_out(points: np.ndarray, most: int) -> np.ndarray:
    """Returns at most so many of the points of a line, both ends among them."""
    return points[np.unique(np.linspace(0, len(points) - 1, min(most, len(points))).round().astype(int))]
