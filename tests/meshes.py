"""Triangulations of the unit square, centred, for tests and figures: points (#V x 2) and triangles (#F x 3)."""
import numpy as np

Mesh = tuple[np.ndarray, np.ndarray]


def cut_squares(cells: int, rising: np.ndarray, *, jitter: float = 0.0, seed: int = 1) -> Mesh:
    """cells x cells squares, each cut along the diagonal that `rising` (cells x cells) says; inner points are moved by
    up to `jitter` cells."""
    i, j = np.meshgrid(np.arange(cells + 1), np.arange(cells + 1))
    points = np.column_stack([i.ravel(), j.ravel()]) / cells - 0.5
    inner = ((i > 0) & (i < cells) & (j > 0) & (j < cells)).ravel()
    points[inner] += np.random.default_rng(seed).uniform(-jitter, jitter, (inner.sum(), 2)) / cells
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    b, c, d = a + 1, a + cells + 2, a + cells + 1
    up = rising.ravel()
    first = np.column_stack([a, b, np.where(up, c, d)])
    second = np.column_stack([np.where(up, a, b), c, d])
    return points, np.concatenate([first, second])


def regular(cells: int) -> Mesh:
    return cut_squares(cells, np.full((cells, cells), True))


def four_eight(cells: int) -> Mesh:
    """Vertices of valence four and eight by turns."""
    i, j = np.meshgrid(np.arange(cells), np.arange(cells))
    return cut_squares(cells, (i + j) % 2 == 0)


def irregular(cells: int) -> Mesh:
    """Points moved by up to a fifth of a cell, squares cut at random."""
    return cut_squares(cells, np.random.default_rng(2).random((cells, cells)) < 0.5, jitter=0.2)


def valence_three(cells: int) -> Mesh:
    """A vertex in the middle of every triangle of a coarser regular mesh: about as many vertices as the others have."""
    points, triangles = regular(round(cells / np.sqrt(3)))
    a, b, c = triangles.T
    middle = len(points) + np.arange(len(triangles))
    split = [np.column_stack(corners) for corners in ((a, b, middle), (b, c, middle), (c, a, middle))]
    return np.concatenate([points, points[triangles].mean(1)]), np.concatenate(split)


KINDS = {"regular": regular, "4-8": four_eight, "irregular": irregular, "valence 3": valence_three}
