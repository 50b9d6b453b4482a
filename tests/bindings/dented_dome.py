"""A dome with dents given by formulas, so that how far its lines are off those of the clean dome is known without the
module; and how well what a press says of its results ranks them.
"""
from collections.abc import Callable
from functools import cache

import numpy as np
import reflines

VIEW, TILT = np.array([0.0, 0.0, 1.0]), np.radians(70.0)
LIGHT = np.array([np.sin(TILT), 0.0, np.cos(TILT)])
SIDE = 1.9
RADIUS, DEPTH = 0.09, 0.002
CENTRES = ((0.2, 0.1), (-0.4, 0.5), (-0.3, -0.5), (0.55, -0.45))
# The settings of twelve presses, from nothing to the best.
PRESSES = (*({"strength": strength} for strength in (0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)),
           *({"limit": limit} for limit in (2e-4, 6e-4, 1e-3, 1.4e-3, 1.8e-3)))
Height = Callable[[np.ndarray, np.ndarray], np.ndarray]


def clean(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return -0.15 * x * x - 0.1 * y * y - 0.03 * x**3


@cache
def dented(depth: float = DEPTH, radius: float = RADIUS, count: int = 1) -> Height:
    return lambda x, y: clean(x, y) - depth * sum(np.exp(-((x - a) ** 2 + (y - b) ** 2) / radius**2)
                                                  for a, b in CENTRES[:count])


def grid(height: Height, cells: int = 60, rows: int | None = None, *, turned: bool = False) -> tuple[np.ndarray, ...]:
    rows = rows or cells
    x, y = (each.ravel() for each in np.meshgrid(np.linspace(-0.5 * SIDE, 0.5 * SIDE, cells + 1),
                                                 np.linspace(-0.5 * SIDE, 0.5 * SIDE, rows + 1)))
    corner = (np.arange(rows)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    quads = np.stack([corner, corner + 1, corner + cells + 2, corner + cells + 1], axis=1)
    quads = np.roll(quads, -1, axis=1) if turned else quads
    return np.stack([x, y, height(x, y)], axis=1), np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def measure_lines(V: np.ndarray, F: np.ndarray) -> list[np.ndarray]:
    """Measures theta at the vertices, degrees, in the light given and in the crossed one, by fitted normals."""
    normals = reflines.NormalFit(V, F).normals(V)
    return [np.degrees(reflines.theta(normals, VIEW, light)) for light in (LIGHT, np.cross(VIEW, LIGHT))]


def correlate_ranks() -> dict[str, float]:
    """Presses the dome in twelve ways, and correlates the ranks by what each says is left at the worst place with those
    by how far it is off the clean dome: in height, and by the lines in each light.
    """
    V, F = grid(dented(count=3))
    design = grid(clean)[0]
    wanted = measure_lines(design, F)
    told, true = [], {"height": [], "given": [], "crossed": []}
    smoother = reflines.PanelSmoother(V, F, view_direction=VIEW, line_direction=LIGHT)
    for settings in PRESSES:
        positions, report = smoother.press(**settings)
        told.append(report.healed.worst_after)
        off = [np.abs(some - other).max() for some, other in zip(measure_lines(positions, F), wanted, strict=True)]
        for name, value in zip(true, (np.abs(positions - design).max(), *off), strict=True):
            true[name].append(value)
    return {name: float(np.corrcoef(rank(told), rank(values))[0, 1]) for name, values in true.items()}


def rank(values: list[float]) -> np.ndarray:
    return np.argsort(np.argsort(values))
