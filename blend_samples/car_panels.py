"""The panels of the car: where its shut lines run, and the grids of points between them. numpy only.

A chart gives every point of a part of the body two numbers: those of a ray from inside. A sheet is a panel between four
curves of a chart; its grid of points lies on the body.
"""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import car_shape as car

Path = Callable[[np.ndarray], np.ndarray]   # shares of the way in [0, 1] (any shape): places in a chart (..., 2)
GAP = 0.0022       # from a panel's edge to the middle of a shut line
ROUNDING, BLUR = 0.35, np.linspace(-1.0, 1.0, 65)   # of rows before a corner: share of their lengths
REACH = 2.5        # length of a ray
HALVINGS, SECANTS = 13, 4   # of a search along a ray, which ends much finer than single precision


@dataclass(frozen=True)
class Chart:
    aim: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]   # origins and directions of rays
    place: Callable[[np.ndarray], np.ndarray]                               # of points

    def cast(self, places: np.ndarray, shape: Callable = car.body) -> np.ndarray:
        """Where the rays leave the body."""
        origin, direction = self.aim(places[..., 0], places[..., 1])
        low, high = np.zeros(places.shape[:-1]), np.full(places.shape[:-1], REACH)
        at_low, at_high = (shape(*np.moveaxis(origin + end[..., None] * direction, -1, 0)) for end in (low, high))
        for step in range(HALVINGS + SECANTS):
            share = 0.5 if step < HALVINGS else at_low / (at_low - at_high)
            middle = low + share * (high - low)
            there = shape(*np.moveaxis(origin + middle[..., None] * direction, -1, 0))
            inside = there < 0.0
            low, high = np.where(inside, middle, low), np.where(inside, high, middle)
            at_low, at_high = np.where(inside, there, at_low), np.where(inside, at_high, there)
        return origin + middle[..., None] * direction


def stack(*parts: np.ndarray | float) -> np.ndarray:
    return np.stack(np.broadcast_arrays(*parts), axis=-1).astype(float)


ABOVE = Chart(lambda x, y: (stack(x, y, 0.4), stack(0.0 * x, 0.0, 1.0)), lambda p: p[..., :2])
BESIDE = Chart(lambda y, z: (stack(0.0, y, z), stack(1.0 + 0.0 * y, 0.0, 0.0)), lambda p: p[..., 1:])
AROUND = Chart(lambda y, turn: (stack(0.0, y, 0.55), stack(np.cos(turn), 0.0, np.sin(turn))),
               lambda p: stack(p[..., 1], np.arctan2(p[..., 2] - 0.55, p[..., 0])))


def from_end(y0: float, way: float) -> Chart:
    """Level rays from the plane of symmetry at `y0` to the front (way -1) or the rear (1)."""
    return Chart(lambda turn, z: (stack(0.0, y0, z), stack(np.sin(turn), way * np.cos(turn), 0.0)),
                 lambda p: stack(np.arctan2(p[..., 0], way * (p[..., 1] - y0)), p[..., 2]))


AHEAD, ASTERN = from_end(-1.25, -1.0), from_end(1.20, 1.0)


def run(chart: Chart, start: float, end: float, place: Callable[[np.ndarray], tuple]) -> np.ndarray:
    """Points of the body along a curve of a chart, as `place` gives it for numbers from start to end."""
    return chart.cast(stack(*place(np.linspace(start, end, 161))))


def path(chart: Chart, *runs: np.ndarray) -> Path:
    """The way along runs of points, one after the other, in another chart; at an even pace in space."""
    points = np.concatenate(runs)
    points = points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-6])]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    at, places = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum(), chart.place(points)
    return lambda share: stack(*(np.interp(share, at, places[:, k]) for k in range(2)))


def straight(chart: Chart, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Points of the body on a straight line of a chart between two points."""
    share = np.linspace(0.0, 1.0, 161)[:, None]
    return chart.cast((1.0 - share) * chart.place(start) + share * chart.place(end))


@dataclass(frozen=True)
class Sheet:
    """A panel: `low` and `high` run from left to right, `left` and `right` from low to high."""
    name: str
    chart: Chart
    low: Path
    high: Path
    left: Path
    right: Path
    size: float                                              # of its cage's faces
    gaps: tuple[float, float, float, float] = (GAP,) * 4     # at low, high, left, right; 0 where there is no shut line
    bend: float = 0.0                                        # share of the way along `high` at which it has a corner
    material: str = "Paint"
    lift: float = 0.0                                        # outwards

    def places(self, s: np.ndarray, t: np.ndarray) -> np.ndarray:
        """A Coons patch."""
        low, high, left, right = self.low(s), self.high(s), self.left(t), self.right(t)
        s, t = s[..., None], t[..., None]
        between = (1.0 - t) * low + t * high
        if self.bend:
            return self.rounded_rows(s[..., 0], t[..., 0])
        corners = [path(np.array(float(end))) for path in (self.low, self.high) for end in (0, 1)]
        bilinear = (1.0 - t) * ((1.0 - s) * corners[0] + s * corners[1]) + t * ((1.0 - s) * corners[2] + s * corners[3])
        return between + (1.0 - s) * left + s * right - bilinear

    def rounded_rows(self, s: np.ndarray, t: np.ndarray) -> np.ndarray:
        """Straight columns from low to high, whatever left and right are; the corner of `high` is round in the rows
        before it, the more the further in.
        """
        reach = ROUNDING * np.minimum(1.0 - t, 2.5 * np.minimum(s, 1.0 - s))[..., None]
        weights = (1.0 - BLUR**2)**2
        high = np.moveaxis(self.high(s[..., None] + reach * BLUR), -1, 0) @ weights / weights.sum()
        return (1.0 - t)[..., None] * self.low(s) + t[..., None] * np.moveaxis(high, 0, -1)

    def columns(self, count: int) -> np.ndarray:
        """Shares of the way along `low`, with one at the bend, as far from each other in space as can be."""
        if not self.bend:
            return np.linspace(0.0, 1.0, count + 1)
        fine = np.linspace(0.0, 1.0, 241)
        rows = self.chart.cast(self.places(*np.meshgrid(fine, np.linspace(0.0, 1.0, 5))))
        steps = np.linalg.norm(np.diff(rows, axis=1), axis=2).max(axis=0)
        steps = np.convolve(np.pad(steps, 12, mode="edge"), np.hanning(27)[1:-1], mode="valid")
        at = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
        turn = np.interp(self.bend, fine, at)
        first = round(count * turn)
        ways = np.concatenate([np.linspace(0.0, turn, first + 1)[:-1], np.linspace(turn, 1.0, count - first + 1)])
        return np.interp(ways, at, fine)

    def grid(self) -> np.ndarray:
        """Points of the body, as far from each other as `size` says: rows from low to high x columns x 3."""
        coarse = self.chart.cast(self.places(*np.meshgrid(np.linspace(0, 1, 33), np.linspace(0, 1, 33))))
        wide, tall = (np.linalg.norm(np.diff(coarse, axis=axis), axis=2).sum(axis=axis) for axis in (1, 0))
        columns, rows = (max(4, round(length.max() / self.size)) for length in (wide, tall))
        s, t = np.meshgrid(self.columns(columns), np.linspace(0, 1, rows + 1))
        wide, tall = (np.interp(along, np.linspace(0, 1, 33), length) for along, length in ((t, wide), (s, tall)))
        low, high, left, right = self.gaps
        s = left / wide + s * (1.0 - (left + right) / wide)
        t = low / tall + t * (1.0 - (low + high) / tall)
        points = self.chart.cast(self.places(s, t))
        return points + self.lift * normals(points)


def normals(points: np.ndarray) -> np.ndarray:
    """Of the body's level surface through the points."""
    step = 1e-5 * np.eye(3)
    slopes = stack(*(car.body(*np.moveaxis(points + one, -1, 0)) - car.body(*np.moveaxis(points - one, -1, 0))
                     for one in step))
    return slopes / np.linalg.norm(slopes, axis=-1, keepdims=True)
