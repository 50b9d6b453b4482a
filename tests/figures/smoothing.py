"""Figure 11: ripples taken out of a panel by its reflection lines, and by Laplacian smoothing."""
import csv
from pathlib import Path

import numpy as np
import reflines
from bindings.sample_panels import panel, rippled, rms
from matplotlib import pyplot

VIEW = np.array([0.0, 0.0, 1.0])
LINES = np.array([0.0, 1.0, 0.3])
WAVELENGTH, AMPLITUDE = 0.12, 3e-4
LENGTHS = (0.05, 0.08, 0.12, 0.18, 0.25, 0.35, 0.5)
STEPS = (1, 2, 5, 10, 20, 50, 100, 200)


def optimizer(positions: np.ndarray, triangles: np.ndarray) -> reflines.ShapeOptimizer:
    return reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW, line_direction=LINES)


def by_lines(start: np.ndarray, triangles: np.ndarray, length: float) -> reflines.ShapeOptimizer:
    solver = optimizer(start, triangles)
    solver.solve(reflines.smooth(solver, length=length))
    return solver


def laplacian(start: np.ndarray, triangles: np.ndarray, steps: int) -> np.ndarray:
    """Every free vertex moves to the mean of its neighbours, `steps` times."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = np.concatenate([edges, edges[:, ::-1]])
    degree, free = np.bincount(edges[:, 0]), optimizer(start, triangles).free
    positions = start.copy()
    for _ in range(steps):
        mean = np.zeros_like(positions)
        np.add.at(mean, edges[:, 0], positions[edges[:, 1]])
        positions[free] = (mean / degree[:, None])[free]
    return positions


def field_errors() -> tuple[float, dict[float, float], dict[int, float]]:
    """rms of |grad theta - the clean panel's|: of the rippled panel, by smoothing length, and by Laplacian steps."""
    clean, triangles = panel()
    wanted = optimizer(clean, triangles).field()
    start = rippled(clean, amplitude=AMPLITUDE, wavelength=WAVELENGTH)
    lines = {length: rms(by_lines(start, triangles, length).field() - wanted) for length in LENGTHS}
    heat = {steps: rms(optimizer(laplacian(start, triangles, steps), triangles).field() - wanted) for steps in STEPS}
    return rms(optimizer(start, triangles).field() - wanted), lines, heat


def stripes(axes: pyplot.Axes, positions: np.ndarray, triangles: np.ndarray, title: str) -> None:
    theta = reflines.theta(reflines.NormalFit(positions, triangles).normals(positions), VIEW, LINES)
    axes.tripcolor(positions[:, 0], positions[:, 1], triangles, np.sin(50 * theta), shading="gouraud", cmap="gray")
    axes.set(title=title, xticks=[], yticks=[], aspect="equal")


def plot(before: float, lines: dict[float, float], heat: dict[int, float], path: Path) -> None:
    clean, triangles = panel()
    start = rippled(clean, amplitude=AMPLITUDE, wavelength=WAVELENGTH)
    best, gentlest = min(lines, key=lines.get), min(heat, key=heat.get)
    figure, panels = pyplot.subplots(1, 4, figsize=(15, 3.7), layout="constrained")
    stripes(panels[0], start, triangles, f"ripples of {AMPLITUDE:g}, wavelength {WAVELENGTH:g}")
    stripes(panels[1], laplacian(start, triangles, 20), triangles, "Laplacian smoothing, 20 steps")
    stripes(panels[2], by_lines(start, triangles, best).positions, triangles, f"reflection lines, length {best:g}")
    panels[3].loglog(list(heat), list(heat.values()), "s-", label="Laplacian, by steps")
    panels[3].loglog([100 * length for length in lines], list(lines.values()), "o-", label="lines, by 100 x length")
    panels[3].axhline(before, color="k", linestyle=":", label="before")
    panels[3].set(xlabel="steps, or 100 x smoothing length", ylabel="error of grad theta, rms, radians / length",
                  title=f"Laplacian at its best: {heat[gentlest]:.2g}; lines: {lines[best]:.2g}")
    panels[3].grid(alpha=0.3)
    panels[3].legend(fontsize=8)
    figure.suptitle("Figure 11: smoothing by reflection lines against Laplacian smoothing (panel of 1.5 x 1.2)")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def make(folder: Path) -> None:
    before, lines, heat = field_errors()
    with (folder / "figure11.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["method", "length or steps", "rms error of grad theta, radians / length"])
        writer.writerow(["none", 0, f"{before:.4g}"])
        writer.writerows(["reflection lines", length, f"{error:.4g}"] for length, error in lines.items())
        writer.writerows(["Laplacian", steps, f"{error:.4g}"] for steps, error in heat.items())
    plot(before, lines, heat, folder / "figure11.png")
