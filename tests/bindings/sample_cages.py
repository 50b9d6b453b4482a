"""Cages as arrays, for tests: V (#V x 3), faces as offsets and corners, made afresh by every call."""
import numpy as np
import reflines
from real_meshes import obj

Array = np.ndarray
VIEW = np.array([0.0, -0.5, 1.0]) / np.hypot(0.5, 1.0)
LINE = np.array([0.0, 1.0, 0.1])
DENT = 0.002


def hood(columns: int = 16, rows: int = 14) -> tuple[Array, Array, Array]:
    """A bonnet of 1.4 x 1.2 metres that is exactly symmetric about x = 0, seen from above and before it."""
    right = np.linspace(0.0, 0.7, columns // 2 + 1)
    x, y = np.meshgrid(np.concatenate([-right[:0:-1], right]), np.linspace(-0.6, 0.6, rows + 1))
    V = np.stack([x, y, -0.13 * x**2 - 0.14 * x**4 - 0.06 * y**2 + 0.1 * y], axis=2).reshape(-1, 3)
    return V, *sheet(columns, rows)


def sheet(columns: int, rows: int) -> tuple[Array, Array]:
    """Offsets and corners of quads in rows, of vertices that are numbered row by row."""
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    quads = np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)
    return np.arange(0, 4 * len(quads) + 1, 4), quads.ravel()


def ball(around: int = 8, down: int = 8) -> tuple[Array, Array, Array]:
    """A closed body: a sphere of radius 1 with triangles at its poles."""
    polar, turn = np.pi * np.arange(1, down) / down, 2 * np.pi * np.arange(around) / around
    V = np.stack([np.outer(np.sin(polar), np.cos(turn)), np.outer(np.sin(polar), np.sin(turn)),
                  np.repeat(np.cos(polar)[:, None], around, axis=1)], axis=2).reshape(-1, 3)
    north, south, last = len(V), len(V) + 1, (down - 2) * around
    faces = [[row + k, row + around + k, row + around + (k + 1) % around, row + (k + 1) % around]
             for row in range(0, last, around) for k in range(around)]
    faces += [[north, k, (k + 1) % around] for k in range(around)]
    faces += [[south, last + (k + 1) % around, last + k] for k in range(around)]
    offsets = np.cumsum([0] + [len(face) for face in faces])
    return np.vstack([V, [[0, 0, 1], [0, 0, -1]]]), offsets, np.concatenate(faces)


def roof() -> tuple[Array, Array, Array]:
    """The roof of a real car as its authors modelled it, in metres."""
    V, faces = obj("subaru_roof_cage.obj")
    return V, np.cumsum([0] + [len(face) for face in faces]), np.concatenate(faces)


def optimizer(cage: tuple, view: Array = VIEW, line: Array = LINE, **options: object) -> reflines.CageOptimizer:
    return reflines.CageOptimizer(*cage, view_direction=view, line_direction=line, **options)


def dented(cage: tuple, view: Array, line: Array, **options: object) -> tuple:
    """Every second vertex of the cage that may move, moved up or down."""
    V, offsets, corners = cage
    rng = np.random.default_rng(7)
    free = np.flatnonzero(optimizer(cage, view, line, **options).cage_free)
    moved = V.copy()
    pick = rng.choice(free, len(free) // 2, replace=False)
    moved[pick] += DENT * rng.choice([-1.0, 1.0], len(pick))[:, None] * view
    return moved, offsets, corners
