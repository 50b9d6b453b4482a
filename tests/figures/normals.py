"""Figure 6: vertex normals of a cylinder sampled at irregular places, against the exact ones."""
import csv
from pathlib import Path

import numpy as np
import reflines
from matplotlib import pyplot
from matplotlib.tri import LinearTriInterpolator, Triangulation
from meshes import irregular

SIZES = (8, 16, 32, 64, 128)
Errors = dict[str, np.ndarray]  # way of making normals -> angle to the exact normal at every vertex, degrees


def sampled_cylinder(cells: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, triangles and exact normals on a cylinder of radius 1 along a slanted axis."""
    points, triangles = irregular(cells)
    turn = np.array([[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]])
    across, along = (points @ turn.T).T
    normals = np.column_stack([np.sin(across), np.zeros(len(points)), np.cos(across)])
    return normals + along[:, None] * np.array([0.0, 1.0, 0.0]), triangles, normals


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def averages(positions: np.ndarray, triangles: np.ndarray, *, by_angle: bool) -> np.ndarray:
    """The usual vertex normals: face normals averaged by area, or by the angle at the vertex."""
    sides = [positions[triangles[:, (k + 1) % 3]] - positions[triangles[:, k]] for k in range(3)]
    face = np.cross(sides[0], -sides[2])
    total = np.zeros_like(positions)
    for k in range(3):
        cosine = -(unit(sides[k]) * unit(sides[k - 1])).sum(1)
        weighted = unit(face) * np.arccos(np.clip(cosine, -1, 1))[:, None] if by_angle else face
        np.add.at(total, triangles[:, k], weighted)
    return unit(total)


def errors(cells: int) -> Errors:
    positions, triangles, exact = sampled_cylinder(cells)
    ways = {"area-weighted average": averages(positions, triangles, by_angle=False),
            "angle-weighted average": averages(positions, triangles, by_angle=True),
            "quadratic fit": reflines.NormalFit(positions, triangles).normals(positions)}
    inner = np.abs(irregular(cells)[0]).max(1) < 0.5 - 1e-9
    return {way: np.degrees(2 * np.arcsin(np.linalg.norm(normals - exact, axis=1) / 2))[inner]
            for way, normals in ways.items()}


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def stripes(axes: pyplot.Axes, positions: np.ndarray, triangles: np.ndarray, normals: np.ndarray, title: str) -> None:
    """Normals are interpolated to every pixel, as a renderer does."""
    x, y = np.meshgrid(*(np.linspace(positions[:, k].min(), positions[:, k].max(), 400) for k in (0, 1)))
    mesh = Triangulation(positions[:, 0], positions[:, 1], triangles)
    pixels = [LinearTriInterpolator(mesh, normals[:, k])(x, y) for k in range(3)]
    inside = ~np.ma.getmaskarray(pixels[0])
    shade = np.full(x.shape, np.nan)
    each = np.column_stack([component[inside].data for component in pixels])
    shade[inside] = np.sin(60 * reflines.theta(each, np.array([0.0, 0.0, 1.0]), [0.3, 1.0, 0.2]))
    axes.imshow(shade, cmap="gray", origin="lower")
    axes.set(title=title, xticks=[], yticks=[])


def plot(by_size: dict[int, Errors], path: Path) -> None:
    figure, panels = pyplot.subplots(1, 4, figsize=(14, 3.7), layout="constrained")
    for way, marker in zip(by_size[SIZES[0]], "os^", strict=True):
        panels[0].loglog(list(by_size), [rms(e[way]) for e in by_size.values()], marker=marker, label=way)
    panels[0].set(xlabel="cells a side", ylabel="normal error, rms, degrees", xticks=SIZES, xticklabels=SIZES)
    panels[0].minorticks_off()
    panels[0].grid(alpha=0.3)
    panels[0].legend(fontsize=8)
    positions, triangles, exact = sampled_cylinder(24)
    stripes(panels[1], positions, triangles, averages(positions, triangles, by_angle=True), "angle-weighted average")
    fit = reflines.NormalFit(positions, triangles)
    stripes(panels[2], positions, triangles, fit.normals(positions), "quadratic fit")
    stripes(panels[3], positions, triangles, exact, "exact normals")
    figure.suptitle("Figure 6: normals of a cylinder sampled at irregular places; stripes at 24 cells a side")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def make(folder: Path) -> None:
    by_size = {cells: errors(cells) for cells in SIZES}
    with (folder / "figure6.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["cells a side", "normals", "rms error, degrees", "largest error, degrees"])
        for cells, ways in by_size.items():
            writer.writerows([cells, way, f"{rms(e):.4g}", f"{e.max():.4g}"] for way, e in ways.items())
    plot(by_size, folder / "figure6.png")
