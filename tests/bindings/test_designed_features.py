"""What a design has pressed into a panel stays in a press of Smooth, whatever flaws lie beside it and on it.

The panels are analytic: a crown with a scoop, a handle's recess or nothing. Errors are read by the paper's eq. 1 at the
triangles' normals, which shares no code with the solver.
"""
import numpy as np
import pytest
import reflines
from sample_panels import Array, find_normals, grid, theta_of
from test_smooth_panel import VIEW

LINES = np.array([0.0, -1.0, 0.0])
SIZE = np.array([1.4, 1.0])
DIAGONAL = float(np.hypot(*SIZE))


def plain(x: Array, _: Array) -> Array:
    return 0.0 * x


def scoop(x: Array, y: Array) -> Array:
    """0.6 % of the diagonal deep, steep at its front and gentle behind."""
    u, v = (x - 0.15) / 0.08, (y - 0.08) / 0.056
    return -0.006 * DIAGONAL * np.exp(-np.where(u > 0, u / 0.6, u / 1.6)**2 - v**2)


def handle(x: Array, y: Array) -> Array:
    """A recess with a floor, 4 mm deep, on one side of a panel of 1.7 m."""
    return -0.004 * np.exp(-(((x - 0.1) / 0.11)**2 + ((y - 0.05) / 0.045)**2)**2)


def make_panel(design: object, cells: int, *, jitter: float) -> tuple[Array, Array]:
    plane, F = grid(cells, jitter=jitter)
    x, y = ((plane - 0.5) * SIZE).T
    return np.column_stack([x, y, -0.15 * x**2 - 0.1 * y**2 + design(x, y)]), F.astype(np.int32)


def inside(V: Array) -> Array:
    """1 inside, 0 within 2 % of the diagonal from the border."""
    t = np.clip(((SIZE / 2 - np.abs(V[:, :2])).min(1) / DIAGONAL - 0.02) / 0.04, 0, 1)
    return t * t * (3 - 2 * t)


def ripples(V: Array) -> Array:
    """6 % of the diagonal long, 0.2 per mille high."""
    k = 2 * np.pi / (0.06 * DIAGONAL)
    u, v = V[:, :2] @ [0.8, 0.6], V[:, :2] @ [-0.6, 0.8]
    return 0.0002 * DIAGONAL * inside(V) * np.sin(k * u) * np.sin(k * v)


def dents(V: Array, depth: float = 0.0006) -> Array:
    """Two, 5 % of the diagonal wide, away from the features."""
    centers = np.array([[-0.35, -0.2], [0.4, -0.25]])
    return -depth * DIAGONAL * np.exp(-((V[:, None, :2] - centers)**2).sum(2) / (0.025 * DIAGONAL)**2).sum(1)


def noise(V: Array, F: Array) -> Array:
    """1 % of an edge."""
    edge = np.median(np.linalg.norm(V[F[:, 0]] - V[F[:, 1]], axis=1))
    return 0.01 * edge * np.random.default_rng(3).standard_normal(len(V)) * inside(V)


def error(V: Array, clean: Array, F: Array, where: Array | float = 1.0) -> float:
    """Degrees of theta, root mean square by area, of both lights."""
    squared = 0.0
    normals = [find_normals(each, F) for each in (V, clean)]
    area = np.linalg.norm(normals[1], axis=1) * where
    for light in (LINES, np.array([1.0, 0.0, 0.0])):
        off = np.subtract(*(theta_of(n, VIEW, light) for n in normals))
        squared += (off**2 * area).sum() / area.sum() / 2
    return float(np.degrees(np.sqrt(squared)))


def press(V: Array, F: Array, z: Array) -> tuple[Array, object]:
    return reflines.smooth_panel(V + z[:, None] * VIEW, F, view_direction=VIEW, line_direction=LINES)


@pytest.mark.parametrize("cells", [30, 42])
def test_a_clean_scoop_is_no_dent(cells: int) -> None:
    """Its parts look like bumps, less high than the deepest dents: taken out, the lines were 0.6 degrees off."""
    V, F = make_panel(scoop, cells, jitter=0.25)
    positions, report = press(V, F, 0 * V[:, 0])
    assert report.mirrored == 0
    assert error(positions, V, F) < 0.15


def test_ripples_go_from_a_panel_with_a_scoop() -> None:
    V, F = make_panel(scoop, 42, jitter=0.25)
    z = ripples(V)
    positions, _ = press(V, F, z)
    assert error(positions, V, F) < 0.4 * error(V + z[:, None] * VIEW, V, F)


@pytest.mark.parametrize("depth", [0.0006, 0.0012, 0.0018])
def test_dents_of_a_plain_panel_go(depth: float) -> None:
    V, F = make_panel(plain, 42, jitter=0.25)
    z = dents(V, depth)
    positions, _ = press(V, F, z)
    assert error(positions, V, F) < 0.25 * error(V + z[:, None] * VIEW, V, F)


def test_what_one_half_has_by_design_stays_and_its_dents_go() -> None:
    """Of a panel whose mesh is symmetric, and whose design is not, the handle went: 4.5 degrees on it."""
    V, F = make_panel(handle, 42, jitter=0.0)
    there = np.abs(handle(*V[:, :2].T)[F]).max(1) > 4e-4
    for z in (0 * V[:, 0], dents(V)):
        positions, report = press(V, F, z)
        assert report.mirrored == len(V)
        assert error(positions, V, F, there) < 0.6
    assert error(positions, V, F, ~there) < 0.25 * error(V + z[:, None] * VIEW, V, F, ~there)


def test_noise_of_a_fine_mesh_is_no_design() -> None:
    """Its curvature varies far more than that of features, but alike all around and in all directions."""
    V, F = make_panel(plain, 96, jitter=0.2)
    z = noise(V, F)
    positions, _ = press(V, F, z)
    assert error(positions, V, F) < 0.55 * error(V + z[:, None] * VIEW, V, F)
