"""Draws stripes of shapes side by side: theta of interpolated normals, as in smooth shading, averaged by pixel."""
from pathlib import Path

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import LineCollection

from figures.compare_shapes import Shapes, compute_normals, compute_theta, to_unit

PIXELS = 200        # of a picture's longer side
MARGIN = 0.06       # share of the region's size, around it
SAMPLES = 1.6       # points a pixel along the edges of a triangle
SHARPNESS = 4.0     # of the edges of stripes
STEEPEST = 0.1      # cosine to the view of normals that are drawn
BEHIND = 1.0        # pixels: what lies farther below another sheet is hidden
DPI = 100
PACKED = {"quality": 30, "method": 6}  # of WebP
COLUMNS = {"flawed": "before", "flawed_smooth": "Smooth Lines", "flawed_length": "Smooth Lines, length set",
           "flawed_fair": "Fair Tangency", "flawed_vertices": "Smooth Vertices",
           "flawed_relax": "Relax", "clean": "the clean panel"}


def list_weights(count: int) -> np.ndarray:
    """Returns barycentric weights (#P x 3) of points spread evenly over a triangle."""
    i, j = np.meshgrid(np.arange(count), np.arange(count))
    lower = np.column_stack([i.ravel(), j.ravel()])[(i + j < count).ravel()] + 1.0 / 3.0
    return np.column_stack([lower / count, 1.0 - lower.sum(axis=1) / count])


def project(shapes: Shapes, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns the vertices in pixels (#V x 3, the third towards the view) and the size of the picture: the clean panel
    decides on both.
    """
    view = to_unit(shapes["view"])
    up = np.array([0.0, 0.0, 1.0]) if abs(view[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
    right = to_unit(np.cross(up, view))
    axes = np.array([right, np.cross(view, right), view])
    region = (shapes["clean"] @ axes.T)[np.unique(shapes["F"][shapes["region"]])]
    low, high = region.min(axis=0), region.max(axis=0)
    margin = MARGIN * (high - low)[:2].max()
    pixel = ((high - low)[:2].max() + 2.0 * margin) / PIXELS
    at = (shapes[name] @ axes.T - low) / pixel
    at[:, :2] += margin / pixel
    return at, np.ceil(((high - low)[:2] + 2.0 * margin) / pixel).astype(int)


def spread_points(at: np.ndarray, normals: np.ndarray, F: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns points on the triangles, denser than pixels, with their normals (#P x 3 each)."""
    longest = SAMPLES * np.linalg.norm(at[F] - at[np.roll(F, 1, axis=1)], axis=2).max(axis=1)
    density = 2 ** np.clip(np.ceil(np.log2(np.maximum(longest, 1.0))), 2, 7).astype(int)
    points = [[np.einsum("pk,fkc->fpc", list_weights(count), values[F[density == count]]).reshape(-1, 3)
               for values in (at, normals)] for count in np.unique(density)]
    return tuple(np.concatenate(parts) for parts in zip(*points, strict=True))


def draw_stripes(shapes: Shapes, name: str) -> np.ndarray:
    """Returns the picture of a shape: brightness of height x width pixels, from the bottom up; white is nothing."""
    at, size = project(shapes, name)
    F, view = shapes["F"], to_unit(shapes["view"])
    near = ((at[F][:, :, :2] > -5) & (at[F][:, :, :2] < size + 5)).all(axis=(1, 2))
    points, normals = spread_points(at, compute_normals(shapes[name], F), F[near])
    normals, xy = to_unit(normals), np.floor(points[:, :2]).astype(int)
    kept = (normals @ view > STEEPEST) & (xy >= 0).all(axis=1) & (xy < size).all(axis=1)
    place, height = xy[kept, 1] * size[0] + xy[kept, 0], points[kept, 2]
    top = np.full(size[0] * size[1], -np.inf)
    np.maximum.at(top, place, height)
    seen = height > top[place] - BEHIND
    theta = compute_theta(normals[kept][seen], view, to_unit(shapes["light"]))
    shade = 0.5 + 0.5 * np.tanh(SHARPNESS * np.cos(int(shapes["count"]) * theta))
    total, count = (np.bincount(place[seen], weights, len(top)) for weights in (shade, None))
    return np.where(count > 0, total / np.maximum(count, 1), 1.0).reshape(size[::-1])


def find_outline(shapes: Shapes) -> np.ndarray:
    """Returns the border edges of the region in pixels (#E x 2 x 2)."""
    F = shapes["F"][shapes["region"]]
    edges = np.sort(F[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    return project(shapes, "clean")[0][edges[count == 1]][:, :, :2] - 0.5


def draw_row(row: np.ndarray, title: str, shapes: Shapes) -> None:
    """Draws the shapes of a panel into one row of axes."""
    for axes, name in zip(row, COLUMNS, strict=True):
        axes.imshow(draw_stripes(shapes, name), cmap="gray", origin="lower", vmin=0, vmax=1)
        axes.add_collection(LineCollection(find_outline(shapes), colors="#e07000", linewidths=0.6))
        axes.set(xticks=[], yticks=[])
        axes.spines[:].set_visible(False)
    row[0].set_ylabel(title, fontsize=9)


def draw_sheet(panels: dict[str, Shapes], path: Path) -> None:
    """Draws all shapes of the panels: a row each, by its title, and a column for each tool."""
    heights = [project(shapes, "clean")[1][1] for shapes in panels.values()]
    size = (len(COLUMNS) * PIXELS * 1.03 + 30, sum(heights) + 9 * len(heights) + 30)
    figure, grid = pyplot.subplots(len(panels), len(COLUMNS), figsize=np.array(size) / DPI, layout="constrained",
                                   gridspec_kw={"height_ratios": heights})
    for row, (title, shapes) in zip(grid, panels.items(), strict=True):
        draw_row(row, title, shapes)
    for axes, title in zip(grid[0], COLUMNS.values(), strict=True):
        axes.set_title(title, fontsize=10)
    figure.savefig(path, dpi=DPI, pil_kwargs=PACKED)
    pyplot.close(figure)
