"""Triangulations of the unit square, centred, for tests and figures: points (#V x 2) and triangles (#F x 3)."""
import numpy as np

Mesh = tuple[np.ndarray, np.ndarray]


def cut_rectangles(rising: np.ndarray, *, jitter: float = 0.0, seed: int = 1) -> Mesh:
    """Rectangles in rows and columns, each cut along the diagonal that `rising` (rows x columns) says; inner points are
    moved by up to `jitter` cells."""
    rows, columns = rising.shape
    i, j = np.meshgrid(np.arange(columns + 1), np.arange(rows + 1))
    points = np.column_stack([i.ravel() / columns, j.ravel() / rows]) - 0.5
    inner = ((i > 0) & (i < columns) & (j > 0) & (j < rows)).ravel()
    points[inner] += np.random.default_rng(seed).uniform(-jitter, jitter, (inner.sum(), 2)) / [columns, rows]
    a = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    b, c, d = a + 1, a + columns + 2, a + columns + 1
    up = rising.ravel()
    first = np.column_stack([a, b, np.where(up, c, d)])
    second = np.column_stack([np.where(up, a, b), c, d])
    return points, np.concatenate([first, second])


def stretched(columns: int, rows: int, kind: str) -> Mesh:
    """Stretched cells: "regular", "jittered" (points moved by up to a fifth of a cell), "random" (cut at random), or
    "irregular" (both)."""
    at_random = np.random.default_rng(2).random((rows, columns)) < 0.5
    rising = at_random if kind in ("random", "irregular") else np.full((rows, columns), True)
    return cut_rectangles(rising, jitter=0.2 if kind in ("jittered", "irregular") else 0.0)


def regular(cells: int) -> Mesh:
    return cut_rectangles(np.full((cells, cells), True))


def four_eight(cells: int) -> Mesh:
    """Vertices of valence four and eight by turns."""
    i, j = np.meshgrid(np.arange(cells), np.arange(cells))
    return cut_rectangles((i + j) % 2 == 0)


def irregular(cells: int) -> Mesh:
    """Points moved by up to a fifth of a cell, squares cut at random."""
    return cut_rectangles(np.random.default_rng(2).random((cells, cells)) < 0.5, jitter=0.2)


def valence_three(cells: int) -> Mesh:
    """A vertex in the middle of every triangle of a coarser regular mesh: about as many vertices as the others have."""
    points, triangles = regular(round(cells / np.sqrt(3)))
    a, b, c = triangles.T
    middle = len(points) + np.arange(len(triangles))
    split = [np.column_stack(corners) for corners in ((a, b, middle), (b, c, middle), (c, a, middle))]
    return np.concatenate([points, points[triangles].mean(1)]), np.concatenate(split)


KINDS = {"regular": regular, "4-8": four_eight, "irregular": irregular, "valence 3": valence_three}
