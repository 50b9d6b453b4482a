"""Figure 5: a spherical patch is recovered from its exact reflection lines, over mesh kinds, stencils and sizes."""
import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import reflines
from matplotlib import pyplot
from meshes import KINDS, Mesh

RADIUS = 2.0
VIEW = np.array([0.0, 0.0, 1.0])
LINES = np.array([0.0, np.cos(np.radians(20)), np.sin(np.radians(20))])
STENCILS = ("averaged", "quadratic", "hybrid", "consistent")
SIZES = (8, 16, 32, 64, 128)


@dataclass(frozen=True)
class Recovery:
    mesh: str
    stencil: str
    cells: int
    error: float  # largest, relative to the patch's depth; nan: the stencil is not defined on the mesh
    iterations: int
    ended: str


def height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.sqrt(RADIUS**2 - x**2 - y**2)


def exact_theta(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return reflines.theta(np.column_stack([x, y, height(x, y)]), VIEW, LINES)


def exact_gradient(points: np.ndarray, step: float = 1e-4) -> np.ndarray:
    """grad theta in the image plane, by central differences; their error is some 1e-9."""
    x, y = points.T
    along_x = exact_theta(x + step, y) - exact_theta(x - step, y)
    along_y = exact_theta(x, y + step) - exact_theta(x, y - step)
    plane = reflines.image_plane(VIEW, LINES)[:2, :2]
    return np.column_stack([along_x, along_y]) / (2 * step) @ plane.T


def pushed_in(points: np.ndarray, exact: np.ndarray, depth: float) -> np.ndarray:
    """The start: the patch with its middle pushed in by half of its depth, smoothly, nothing moved at the border."""
    inside = np.clip(1 - (2 * points) ** 2, 0, None).prod(1)
    return exact - 0.5 * depth * inside**3


def optimizer(points: np.ndarray, heights: np.ndarray, triangles: np.ndarray, stencil: str) -> reflines.ShapeOptimizer:
    return reflines.ShapeOptimizer(np.column_stack([points, heights]), triangles, view_direction=VIEW,
                                   line_direction=LINES, stencil=stencil)


def recover(mesh: str, stencil: str, cells: int) -> Recovery:
    return recover_on(KINDS[mesh](cells), mesh, stencil, cells)


def recover_on(points_and_triangles: Mesh, mesh: str, stencil: str, cells: int) -> Recovery:
    points, triangles = points_and_triangles
    exact = height(*points.T)
    depth = float(np.ptp(exact))
    try:
        free = optimizer(points, exact, triangles, stencil).free
        solver = optimizer(points, np.where(free, pushed_in(points, exact, depth), exact), triangles, stencil)
        target = reflines.Target(exact_gradient(points[triangles].mean(1)))
        report = solver.solve(target, gradient_tolerance=1e-9, max_iterations=200)
    except (reflines.InvalidInput, reflines.SolverFailure) as failure:
        return Recovery(mesh, stencil, cells, np.nan, 0, str(failure))
    error = float(np.abs(solver.positions[:, 2] - exact).max()) / depth
    return Recovery(mesh, stencil, cells, error, report.iterations, report.termination)


def recoveries(sizes: tuple[int, ...] = SIZES) -> list[Recovery]:
    return [recover(mesh, stencil, cells) for mesh in KINDS for stencil in STENCILS for cells in sizes]


def write(rows: list[Recovery], path: Path) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["mesh", "stencil", "cells a side", "largest error / depth", "iterations", "ended"])
        writer.writerows([r.mesh, r.stencil, r.cells, f"{r.error:.4g}", r.iterations, r.ended] for r in rows)


def plot(rows: list[Recovery], path: Path) -> None:
    figure, panels = pyplot.subplots(1, len(KINDS), figsize=(13, 3.8), sharey=True, layout="constrained")
    for axes, mesh in zip(panels, KINDS, strict=True):
        for stencil, marker in zip(STENCILS, "os^D", strict=True):
            own = [r for r in rows if (r.mesh, r.stencil) == (mesh, stencil)]
            axes.loglog([r.cells for r in own], [r.error for r in own], marker=marker, label=stencil)
        cells = np.array(sorted({r.cells for r in rows}))
        axes.loglog(cells, 0.05 * (cells / 8.0) ** -2, "k:", label="second order")
        axes.set(title=f"{mesh} mesh", xlabel="cells a side", xticks=cells, xticklabels=cells)
        axes.minorticks_off()
        axes.grid(alpha=0.3)
    panels[0].set_ylabel("largest height error / depth of the patch")
    panels[-1].legend(fontsize=8)
    figure.suptitle("Figure 5: a sphere recovered from its exact reflection lines")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def make(folder: Path) -> None:
    rows = recoveries()
    write(rows, folder / "figure5.csv")
    plot(rows, folder / "figure5.png")
