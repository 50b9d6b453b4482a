"""The transfer function of Smooth with a length of its own: the share of a wave that is left, by its wavelength."""
import csv
from pathlib import Path

import numpy as np
import reflines
from matplotlib import pyplot
from meshes import KINDS

VIEW, LINES = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])
LENGTH, CELLS, MIDDLE = 0.15, 120, 0.2
MESHES = ("regular", "4-8", "irregular", "valence 3")
RATIOS = (0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0)  # wavelength / length
SLANT = 0.5  # angle between the waves and the grid, radians


def expected(ratio: np.ndarray) -> np.ndarray:
    """A wave left by the filter: an implicit step of fourth order, halved at the length, with a sharpened response."""
    step = 1.0 / (1.0 + ratio**-4.0)
    return step**4 * (35.0 - 84.0 * step + 70.0 * step**2 - 20.0 * step**3)


def ramp(points: np.ndarray) -> np.ndarray:
    """1 in the middle, 0 on the border, smooth between."""
    t = np.clip((0.5 - np.abs(points).max(1)) / 0.2, 0, 1)
    return t * t * (3 - 2 * t)


def smoothed(points: np.ndarray, triangles: np.ndarray, heights: np.ndarray, length: float) -> np.ndarray:
    """The heights after Smooth."""
    solver = reflines.ShapeOptimizer(np.column_stack([points, heights]), triangles, view_direction=VIEW,
                                     line_direction=LINES)
    solver.solve(reflines.smooth(solver, length=length))
    return solver.heights


def share_left(mesh: str, ratio: float) -> float:
    """The share of a wave's heights that Smooth leaves, in the middle of a crowned plate."""
    points, triangles = KINDS[mesh](CELLS)
    x, y = points.T
    base = -0.15 * x**2 - 0.1 * y**2
    along = x * np.cos(SLANT) + y * np.sin(SLANT)
    wave = 1e-4 * ratio**2 * np.sin(2 * np.pi * along / (ratio * LENGTH)) * ramp(points)
    left = smoothed(points, triangles, base + wave, LENGTH) - smoothed(points, triangles, base, LENGTH)
    middle = np.abs(points).max(1) < MIDDLE
    return float(left[middle] @ wave[middle] / (wave[middle] @ wave[middle]))


def dent_left(radius: float, mesh: str = "irregular") -> tuple[float, float]:
    """What is left of an isolated Gaussian dent whose standard deviation is `radius` lengths: in its middle, and the
    largest rise around it, as shares of its depth."""
    points, triangles = KINDS[mesh](CELLS)
    x, y = points.T
    base, length = -0.15 * x**2 - 0.1 * y**2, 0.2
    dent = 1e-3 * np.exp(-(x**2 + y**2) / (2 * (radius * length)**2))
    left = (smoothed(points, triangles, base - dent, length) - base) / 1e-3
    return float(-left[np.argmin(x**2 + y**2)]), float(left.max())


def make(folder: Path) -> None:
    rows = [(mesh, ratio, share_left(mesh, ratio)) for mesh in MESHES for ratio in RATIOS]
    with (folder / "transfer.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["mesh", "wavelength / length", "share left"])
        writer.writerows([mesh, ratio, f"{left:.4g}"] for mesh, ratio, left in rows)
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6), layout="constrained")
    ratios = np.geomspace(RATIOS[0], RATIOS[-1], 100)
    axes.semilogx(ratios, expected(ratios), "k:", label="sharpened step of fourth order")
    for mesh, marker in zip(MESHES, "osD^", strict=True):
        own = [(ratio, left) for kind, ratio, left in rows if kind == mesh]
        axes.semilogx(*zip(*own, strict=True), marker, label=f"{mesh} mesh", fillstyle="none")
    axes.set(xlabel="wavelength / length", ylabel="share of the wave that is left", xticks=RATIOS, xticklabels=RATIOS)
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(folder / "transfer.png", dpi=100)
    pyplot.close(figure)
