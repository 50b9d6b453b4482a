"""Cages for the samples below a Subdivision Surface: few quads, some of whose vertices lie wrong. numpy only."""
import numpy as np

DENT_SEED = 1978
CREASE_ROW = 7        # of the fender, counted from below
CREASE = 0.8


def grid(columns: int, rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Parameters s, t in [0, 1] of every vertex, and the quads."""
    s, t = np.meshgrid(np.linspace(0.0, 1.0, columns + 1), np.linspace(0.0, 1.0, rows + 1))
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    return s.ravel(), t.ravel(), np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)


def dents(s: np.ndarray, t: np.ndarray, margin: float, depth: float, count: int) -> np.ndarray:
    """`count` vertices away from the border, moved by `depth` to either side (#V)."""
    random = np.random.RandomState(DENT_SEED)   # its stream is frozen by numpy's policy
    inside = np.flatnonzero((np.minimum(s, 1.0 - s) > margin) & (np.minimum(t, 1.0 - t) > margin))
    result = np.zeros(len(s))
    result[random.permutation(inside)[:count]] = depth * (2 * (np.arange(count) % 2) - 1)
    return result


def hood(columns: int = 18, rows: int = 16) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The dented cage (#V x 3), its quads, and the z of the clean one. x across, y to the rear, metres."""
    s, t, quads = grid(columns, rows)
    x, y = 1.4 * (s - 0.5) * (0.94 + 0.06 * t), 1.2 * (t - 0.5)
    clean = -0.13 * x**2 - 0.14 * x**4 - 0.06 * y**2 + 0.1 * y
    return np.column_stack([x, y, clean + dents(s, t, 0.18, 0.0025, 14)]), quads, clean


def fender(columns: int = 18, rows: int = 14) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The dented cage, its quads, and the x of the clean one: a flank that turns inwards above its character line."""
    s, t, quads = grid(columns, rows)
    y, z = 1.2 * (s - 0.5), 0.1 + 0.75 * t + 0.02 * np.cos(2.0 * s)
    above = np.maximum(0.0, t - CREASE_ROW / rows)
    clean = -0.35 * (z - 0.4)**2 - 0.10 * y**2 - 0.16 * above
    bumps = np.where(np.abs(t - CREASE_ROW / rows) < 0.5 / rows, 0.0, dents(s, t, 0.16, 0.002, 14))
    return np.column_stack([clean + bumps, y, z]), quads, clean
