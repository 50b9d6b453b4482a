"""The lines of a region between its vertices: the place under a point, theta there, and the course of one line."""
from dataclasses import dataclass
from functools import cached_property

import numpy as np

INSIDE = -1e-9      # barycentric coordinate
MOST_STEPS = 4000   # triangles that one line is followed through
MOST_ROUNDS = 12    # of the search for the source of a line
EXACT = 1e-12       # radians


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
            found = self.find_place(self.read_point(found, state) + step)
            if found is None:
                return place
        return found

    def trace(self, place: Place, state: LineState, value: float) -> np.ndarray:
        """Returns the line of a value of theta from a place both ways until the border: #P x 3, world space; empty
        where it does not pass through the place's triangle.
        """
        crossed = [edge for edge in range(3) if self.cross_edge(place.triangle, edge, state, value) is not None]
        if len(crossed) < 2:
            return np.empty((0, 3))
        ways = [self.follow(place.triangle, edge, state, value) for edge in crossed[:2]]
        return np.array(ways[0][::-1] + ways[1])

    def follow(self, triangle: int, edge: int, state: LineState, value: float) -> list[np.ndarray]:
        """Returns the points of a line from the triangle on, which it leaves across an edge."""
        points, first = [], triangle
        for _ in range(MOST_STEPS):
            points.append(self.cross_edge(triangle, edge, state, value))
            beyond = int(self.neighbors[triangle, edge])
            if beyond < 0 or beyond == first:
                break
            entered = int(np.flatnonzero(self.neighbors[beyond] == triangle)[0])
            ways = [k for k in range(3) if k != entered and self.cross_edge(beyond, k, state, value) is not None]
            if not ways:
                break
            triangle, edge = beyond, ways[0]
        return points

    def cross_edge(self, triangle: int, edge: int, state: LineState, value: float) -> np.ndarray | None:
        """Returns where a line crosses the edge opposite a corner; None where it does not."""
        a, b = sorted((int(self.F[triangle, edge - 2]), int(self.F[triangle, edge - 1])))
        one, other = wrap(state.theta[a] - value), wrap(state.theta[b] - value)
        if (one < 0.0) == (other < 0.0) or abs(one - other) > np.pi:
            return None
        share = one / (one - other)
        return (1.0 - share) * state.V[a] + share * state.V[b]


def find_neighbors(F: np.ndarray) -> np.ndarray:
    """Returns the triangle across the edge opposite each corner: #F x 3, -1 where there is none."""
    edges = np.sort(np.stack([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]], axis=1).reshape(-1, 2), axis=1)
    key = edges[:, 0].astype(np.int64) * (int(F.max()) + 1) + edges[:, 1]
    order = np.argsort(key, kind="stable")
    twin = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    result = np.full(len(key), -1, dtype=np.int64)
    result[order[twin]], result[order[twin + 1]] = order[twin + 1] // 3, order[twin] // 3
    return result.reshape(-1, 3)


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def wrap(angle: np.ndarray) -> np.ndarray:
    """Wraps differences of theta to [-pi, pi]; those within keep their bits."""
    return angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi))


def thin_out(points: np.ndarray, most: int) -> np.ndarray:
    """Returns at most so many of the points of a line, both ends among them."""
    return points[np.unique(np.linspace(0, len(points) - 1, min(most, len(points))).round().astype(int))]
