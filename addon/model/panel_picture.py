"""Pictures of a panel with its reflection lines, drawn without a window."""
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from .steps import Steps, wait_for

FINE = 2  # samples of a pixel each way
BAND = 30000  # pixels that are drawn in one step, within 50 ms
DARK, LIGHT = 0.09, 0.98        # of stripes
GROUND = 0.87                   # behind all
NEAR, FAR = 0.78, 0.60          # of what lies beside the panel: facing the viewer, and edge on
CREASE = np.radians(30.0)       # edges that bend by more have normals of their own on each side


@dataclass(frozen=True)
class Pictured:
    """A surface that is drawn, in world space, cut open along its creases."""
    V: np.ndarray        # #V x 3
    F: np.ndarray        # #F x 3
    normals: np.ndarray  # #V x 3
    region: np.ndarray   # #F, bool: what has stripes


@dataclass(frozen=True)
class Looked:
    """The way a surface is looked at: in parallel, as a drawing."""
    right: np.ndarray   # 3, unit, in the picture
    up: np.ndarray      # 3, unit
    eye: np.ndarray     # 3, unit, towards the viewer
    center: np.ndarray  # 3, in the middle of the picture
    width: float        # world units from its left to its right
    line: np.ndarray    # 3, along the line lights
    count: float        # stripes round the circle

    def find_pixels(self, points: np.ndarray, width: int, height: int) -> np.ndarray:
        """Returns places in a picture of this size: #points x 2, to the right and down."""
        scale, away = width / self.width, points - self.center
        return np.column_stack([0.5 * width + scale * (away @ self.right), 0.5 * height - scale * (away @ self.up)])


def turn_to(looked: Looked, eye: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the right and up of a picture from another eye, turned no further than needed."""
    axis = np.cross(looked.eye, eye)
    cosine = float(looked.eye @ eye)
    if cosine < -0.999:
        return -looked.right, looked.up
    return tuple(each + np.cross(axis, each) + np.cross(axis, np.cross(axis, each)) / (1.0 + cosine)
                 for each in (looked.right, looked.up))


def cut_surface(V: np.ndarray, F: np.ndarray, region: np.ndarray) -> Steps[Pictured]:
    """Prepares a surface: its panel with fitted normals, as the stripes of the window have them. What lies beside it at
    places that are no numbers is left out.
    """
    points, own = split(V, F[region])
    around, beside = split(V, F[~region & np.isfinite(V).all(axis=1)[F].all(axis=1)])
    fit = yield from wait_for(native.reflines.start(native.reflines.NormalFit.create, points, own))
    fitted = fit.normals(points)
    return Pictured(np.concatenate([points, around]), np.concatenate([own, beside + len(points)]),
                    np.concatenate([fitted, average_normals(around, beside)]),
                    np.arange(len(own) + len(beside)) < len(own))


def split(V: np.ndarray, F: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the vertices and the triangles of a surface that is cut open, without vertices in none of them."""
    if not len(F):
        return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    used, corners = np.unique(F, return_inverse=True)
    cut, vertex = native.reflines.split_at_creases(V[used], corners.reshape(-1, 3), angle=CREASE)
    return V[used[vertex]], cut


def average_normals(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Returns normals of vertices (#V x 3, of any length) by the areas of their triangles."""
    a, b, c = (V[F[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    return np.column_stack([np.bincount(F.ravel(), np.repeat(cross[:, k], 3), minlength=len(V)) for k in range(3)])


def draw_panel(shown: Pictured, looked: Looked, width: int, height: int) -> np.ndarray:
    """Draws the surface: height x width x 3, 0 to 1."""
    size = {"width": FINE * width, "height": FINE * height}
    pixels = looked.find_pixels(shown.V, **size)
    points = np.column_stack([pixels, (shown.V - looked.center) @ looked.eye])
    seen, second, third = native.reflines.rasterize(points, shown.F, **size)
    hit = seen >= 0
    triangle, weights = seen[hit], np.stack([second[hit], third[hit]], axis=1).astype(np.float64)
    corners = shown.F[triangle]
    normals = sum(weight[:, None] * shown.normals[corners[:, k]] for k, weight in
                  enumerate([1.0 - weights.sum(axis=1), *weights.T]))
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    shades = np.full(hit.shape, GROUND, dtype=np.float32)
    shades[hit] = np.where(shown.region[triangle], stripe(normals, looked),
                           FAR + (NEAR - FAR) * np.abs(normals @ looked.eye))
    grey = shades.reshape(height, FINE, width, FINE).mean(axis=(1, 3))
    return np.repeat(grey[..., None], 3, axis=2)


def draw_in_bands(shown: Pictured, looked: Looked, width: int, height: int) -> Steps[np.ndarray]:
    """Draws the surface likewise, one band of the picture after the other from its top."""
    count, drawn = count_bands(width, height), []
    for band in range(count):
        first, last = (round(height * each / count) for each in (band, band + 1))
        lower = (0.5 * (first + last) - 0.5 * height) * looked.width / width
        drawn.append(draw_panel(shown, replace(looked, center=looked.center - lower * looked.up), width, last - first))
        yield
    return np.concatenate(drawn)


def count_bands(width: int, height: int) -> int:
    return min(-(-width * height // BAND), height)


def measure_turn(shown: Pictured, looked: Looked, height: float) -> float:
    """Measures by how many degrees theta differs over the panel in a picture of this height (world units), without its
    outermost twentieths; 0 where nothing is in it.
    """
    away = shown.V - looked.center
    inside = (np.abs(away @ looked.right) < 0.5 * looked.width) & (np.abs(away @ looked.up) < 0.5 * height)
    inside &= np.bincount(shown.F[shown.region].ravel(), minlength=len(shown.V)) > 0
    if not inside.any():
        return 0.0
    theta = native.reflines.theta(face(shown.normals[inside], looked), looked.eye, looked.line)
    middle = theta[np.argmin(np.linalg.norm(away[inside], axis=1))]
    low, high = np.percentile(np.mod(theta - middle + np.pi, 2.0 * np.pi), (5.0, 95.0))
    return float(np.degrees(high - low))


def face(normals: np.ndarray, looked: Looked) -> np.ndarray:
    """Returns the normals on the viewer's side."""
    return np.where((normals @ looked.eye < 0.0)[:, None], -normals, normals)


def stripe(normals: np.ndarray, looked: Looked) -> np.ndarray:
    """Returns how light stripes are on these normals."""
    theta = native.reflines.theta(face(normals, looked), looked.eye, looked.line)
    return np.where(np.mod(theta * looked.count / (2.0 * np.pi), 1.0) < 0.5, DARK, LIGHT)
