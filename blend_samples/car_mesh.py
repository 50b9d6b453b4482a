"""Meshes of sheets: dense ones, and cages whose Subdivision Surfaces run through their points. numpy only."""
from dataclasses import dataclass

import numpy as np

import car_flaws
from car_panels import Sheet, normals


@dataclass(frozen=True)
class Mesh:
    name: str
    V: np.ndarray        # #V x 3
    quads: np.ndarray    # #Q x 4, their front sides outwards
    material: str
    corner: int = -1     # a vertex of the border that is a corner of the cage's surface


def limit_matrix(count: int, *, even: bool = False, corner: int = 0) -> np.ndarray:
    """From a row of a regular cage to its limit points. Both ends and `corner` are points of the cage; where the first
    point lies on a mirror's plane, about which the coordinate is `even`, it is none.
    """
    ones = np.full(count - 1, 1.0 / 6.0)
    matrix = np.diag(np.full(count, 4.0 / 6.0)) + np.diag(ones, 1) + np.diag(ones, -1)
    kept = [0, corner, count - 1]
    matrix[kept] = np.eye(count)[kept]
    if even:
        matrix[0, :2] = 4.0 / 6.0, 2.0 / 6.0
    return matrix


def cage_through(points: np.ndarray, bend: int, *, mirrored: bool) -> np.ndarray:
    """The cage (rows x columns x 3) whose Subdivision Surface runs through a grid of points; the first column lies on
    the mirror's plane where it is `mirrored`. The point `bend` of the last row is a corner, as the four of the grid.
    """
    rows, columns = points.shape[:2]
    down, cage = limit_matrix(rows), np.empty_like(points)
    for axis in range(3):
        even, wanted = mirrored and axis > 0, points[..., axis].copy()
        along = limit_matrix(columns, even=even)
        wanted[-1] = along @ np.linalg.solve(limit_matrix(columns, even=even, corner=bend), wanted[-1])
        cage[..., axis] = np.linalg.solve(along, np.linalg.solve(down, wanted).T).T
    return cage


def quads_of(points: np.ndarray) -> np.ndarray:
    """Of a grid of points on the body, their front sides outwards."""
    rows, columns = points.shape[:2]
    steps = np.cross(points[:-1, 1:] - points[:-1, :-1], points[1:, :-1] - points[:-1, :-1])
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    quads = np.stack([corner, corner + 1, corner + columns + 1, corner + columns], axis=1)
    return quads if (steps * normals(points[:-1, :-1])).sum() > 0.0 else quads[:, ::-1]


def cage_of(sheet: Sheet) -> Mesh:
    points = sheet.grid()
    rows, columns = points.shape[:2]
    bend = int(np.argmin(np.abs(sheet.columns(columns - 1) - sheet.bend))) if sheet.bend else 0
    V = cage_through(points, bend, mirrored=bool(np.abs(points[:, 0, 0]).max() < 1e-9))
    return Mesh(sheet.name, V.reshape(-1, 3), quads_of(points), sheet.material,
                (rows - 1) * columns + bend if bend else -1)


def dense_of(sheet: Sheet, *, flawed: bool = True) -> Mesh:
    """The points themselves, with the flaws of the panel."""
    points = sheet.grid()
    out = car_flaws.flaws(sheet.name, points)[..., None] * normals(points) if flawed else 0.0
    return Mesh(sheet.name, (points + out).reshape(-1, 3), quads_of(points), sheet.material)
