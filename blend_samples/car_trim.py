"""What the car has beside its panels: dark seams in the shut lines, windows, lamps and wheels. numpy only.

Every part is V (#V x 3) and quads (#Q x 4), of the left half or, wheels, whole.
"""
import numpy as np

import car_shape as car
from car_panels import Sheet, normals

DEEP, UNDER = 0.016, 0.010   # of a seam: how far in it goes, and then below its neighbour
OUT = 0.775                  # x of a wheel's middle
Part = tuple[np.ndarray, np.ndarray]


def strip(rows: np.ndarray, *, closed: bool) -> Part:
    """Quads between rows of points (rows x points x 3)."""
    count, length = rows.shape[:2]
    at, row = np.meshgrid(np.arange(length if closed else length - 1), np.arange(count - 1))
    here, after = row * length + at, row * length + (at + 1) % length
    quads = np.stack([here, after, after + length, here + length], axis=-1)
    return rows.reshape(-1, 3), quads.reshape(-1, 4)


def join(parts: list[Part]) -> Part:
    offsets = np.cumsum([0] + [len(V) for V, _ in parts])
    return (np.concatenate([V for V, _ in parts]),
            np.concatenate([quads + offset for (_, quads), offset in zip(parts, offsets[:-1], strict=True)]))


def seam(sheet: Sheet) -> Part:
    """Hems along the edges of a panel that have a shut line or a free edge."""
    points = sheet.grid()
    parts = []
    columns = points.swapaxes(0, 1)
    edges = (points[:2], points[:-3:-1], columns[:2], columns[:-3:-1])
    for gap, (edge, inner) in zip(sheet.gaps, edges, strict=True):
        if gap:
            inwards = -normals(edge)
            away = edge - inner
            away /= np.linalg.norm(away, axis=1, keepdims=True)
            parts.append(strip(np.stack([edge + 0.0004 * inwards, edge + DEEP * inwards,
                                         edge + DEEP * inwards + UNDER * away]), closed=False))
    return join(parts)


def ring(profile: list[tuple[float, float]], count: int = 48) -> Part:
    """A turned part about x: (x, radius) from outside to inside."""
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    rows = np.array([np.stack([np.full(count, x), radius * np.cos(turn), radius * np.sin(turn)], axis=1)
                     for x, radius in profile])
    return strip(rows, closed=True)


def tyre() -> Part:
    r = car.WHEEL
    return ring([(0.092, r - 0.082), (0.100, r - 0.070), (0.104, r - 0.045), (0.098, r - 0.018), (0.082, r - 0.003),
                 (0.05, r), (-0.05, r), (-0.09, r - 0.01), (-0.105, r - 0.04), (-0.1, r - 0.09)])


def rim() -> Part:
    r = car.WHEEL - 0.080
    return ring([(0.090, r), (0.098, r - 0.004), (0.096, r - 0.014), (0.070, r - 0.020), (-0.07, r - 0.03)])


def spokes(count: int = 5) -> Part:
    """Pairs of spokes from the hub, dished, and the hub itself."""
    r = car.WHEEL - 0.092
    parts = []
    for one in range(count):
        for side in (-1.0, 1.0):
            turn = 2.0 * np.pi * one / count + 0.5 * np.pi
            radius = np.linspace(0.035, r, 9)
            lean = turn + side * (0.10 + 0.16 * (radius / r)**2)
            across = np.stack([np.zeros(9), -np.sin(lean), np.cos(lean)], axis=1)
            out = np.stack([0.066 + 0.024 * (radius / r)**2, radius * np.cos(lean), radius * np.sin(lean)], axis=1)
            half = (0.019 - 0.006 * radius / r)[:, None] * across
            back = np.array([0.030, 0.0, 0.0])
            ridge = out + 0.15 * back
            rows = np.stack([out - half - back, out - half, ridge - 0.7 * half, ridge + 0.7 * half, out + half,
                             out + half - back])
            parts.append(strip(rows, closed=False))
    parts.append(ring([(0.082, 0.001), (0.082, 0.030), (0.074, 0.052), (0.03, 0.056)], 24))
    return join(parts)


def wheel() -> list[tuple[Part, str, float, float]]:
    """Parts, their materials, x and z of their centres."""
    return [(tyre(), "Rubber", OUT, car.WHEEL), (rim(), "Metal", OUT, car.WHEEL), (spokes(), "Metal", OUT, car.WHEEL),
            (disc(0.02, 0.24), "Black", OUT, car.WHEEL), (well(), "Black", 0.66, car.ARCH_HEIGHT)]


def disc(x: float, radius: float) -> Part:
    return ring([(x, 0.001), (x, radius)])


def well() -> Part:
    """The dark inside of a wheel arch."""
    r = car.ARCH + 0.012
    return ring([(0.20, r), (-0.22, r), (-0.22, 0.001)])


def placed(part: Part, place: tuple[float, float, float]) -> Part:
    return part[0] + np.array(place), part[1]
