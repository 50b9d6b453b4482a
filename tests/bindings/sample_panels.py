"""Small panels as arrays, for tests: V (#V x 3), F (#F x 3), made afresh by every call."""
import numpy as np
import reflines

VIEW = np.array([0.0, 0.3, 1.0]) / np.hypot(0.3, 1.0)
LINE = np.array([1.0, 0.2, 0.1])
Array = np.ndarray


def grid(cells: int, *, jitter: float = 0.0, seed: int = 0) -> tuple[Array, Array]:
    """Positions (#V x 2) in the unit square and triangles; inner vertices moved by up to `jitter` cells."""
    rng = np.random.default_rng(seed)
    i, j = np.meshgrid(np.arange(cells + 1), np.arange(cells + 1), indexing="xy")
    plane = np.stack([i.ravel(), j.ravel()], 1) / cells
    inner = ((i > 0) & (i < cells) & (j > 0) & (j < cells)).ravel()
    plane[inner] += rng.uniform(-jitter / cells, jitter / cells, (int(inner.sum()), 2))
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    lower = np.stack([first, first + 1, first + cells + 2], 1)
    upper = np.stack([first, first + cells + 2, first + cells + 1], 1)
    return plane, np.concatenate([lower, upper])


def panel(cells: int = 48, *, jitter: float = 0.2) -> tuple[Array, Array]:
    """A clean, gently crowned panel of 1.5 x 1.2, given by an analytic function."""
    plane, triangles = grid(cells, jitter=jitter)
    x, y = plane[:, 0] * 1.5 - 0.75, plane[:, 1] * 1.2 - 0.6
    height = -0.12 * x**2 - 0.08 * y**2 + 0.02 * x**2 * y - 0.03 * x**4 + 0.004 * np.sin(3 * y)
    return np.stack([x, y, height], 1), triangles


def inside(positions: Array, *, margin: float = 0.15, rim: float = 0.0) -> Array:
    """1 well inside the panel's rectangle, 0 up to `rim` from its border, smooth over `margin` between (#V)."""
    distance = np.minimum(0.75 - abs(positions[:, 0]), 0.6 - abs(positions[:, 1]))
    t = np.clip((distance - rim) / margin, 0, 1)
    return t * t * (3 - 2 * t)


def rippled(positions: Array, *, amplitude: float, wavelength: float) -> Array:
    """The panel with an egg-box of ripples along z that die out at the border."""
    k = 2 * np.pi / wavelength
    result = positions.copy()
    result[:, 2] += amplitude * inside(positions) * np.sin(k * positions[:, 0]) * np.sin(k * positions[:, 1])
    return result


def rms(field: Array) -> float:
    return float(np.sqrt((field**2).sum(1).mean()))


def optimizer(positions: Array, triangles: Array, **options: object) -> reflines.ShapeOptimizer:
    return reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW, line_direction=LINE, **options)


def find_normals(V: Array, F: Array) -> Array:
    """Of triangles (#F x 3), twice as long as their areas."""
    return np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])


def unit(vector: Array) -> Array:
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def theta_of(normals: Array, eye: Array, line: Array) -> Array:
    """Returns equation 1 of the paper in space: the mirrored eye direction, projected along the lines, from its own."""
    n, v, a = unit(normals), unit(eye), unit(line)
    mirrored = 2 * (n @ v)[:, None] * n - v
    start = unit(v - (v @ a) * a)
    return np.arctan2(mirrored @ np.cross(a, start), mirrored @ start)
