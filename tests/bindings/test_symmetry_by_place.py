"""A press compares the halves of a panel where they are alike, and keeps what they differ by smoothly."""
import numpy as np
import pytest
import reflines
from dented_dome import grid

from bench.restoration import JUDGE, load_judge, load_panel

Array = np.ndarray
VIEW, LINES = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.3, 0.0])
DEPTH = 0.002


def ribbed(x: Array, y: Array) -> Array:
    """The heights of a panel that is symmetric in x and not in y, with a rib and a step on both halves."""
    rib = 0.006 * np.exp(-((np.abs(x) - 0.45) / 0.05) ** 2) * np.cos(7 * y)
    return -0.15 * x * x - 0.1 * y * y - 0.05 * y**3 + rib + 0.004 * np.tanh((np.abs(x) - 0.25) / 0.03)


def bowed(x: Array, y: Array) -> Array:
    """One half is bowed more than the other, by 1 per mille of the diagonal, on purpose."""
    return ribbed(x, y) + 0.003 * np.clip(x, 0.0, None) ** 2 * (1.0 - 0.3 * y)


def cut_off(x: Array, y: Array) -> Array:
    """Beyond y = 0.3 one half slopes away, as on a panel that is selected with a part of what lies beside it."""
    return ribbed(x, y) - 0.4 * np.clip(x, 0.0, None) * np.clip(y - 0.3, 0.0, None)


def dents(x: Array, y: Array) -> Array:
    return -DEPTH * (np.exp(-((x - 0.4) ** 2 + (y + 0.2) ** 2) / 0.09**2)
                     + np.exp(-((x + 0.5) ** 2 + (y + 0.5) ** 2) / 0.08**2))


def press(V: Array, F: Array, *, symmetric: bool = True) -> tuple[Array, reflines.SmoothPanelReport]:
    return reflines.smooth_panel(V, F, view_direction=VIEW, line_direction=LINES, symmetric=symmetric)


def fraction_left(design, *, symmetric: bool) -> tuple[float, int]:
    """How much of the dents a press leaves where they are, root mean square, and how many vertices it compared."""
    V, F = grid(lambda x, y: design(x, y) + dents(x, y))
    wanted, there = design(V[:, 0], V[:, 1]), dents(V[:, 0], V[:, 1]) < -1e-4
    P, report = press(V, F, symmetric=symmetric)
    return np.linalg.norm((P[:, 2] - wanted)[there]) / np.linalg.norm((V[:, 2] - wanted)[there]), report.mirrored


@pytest.mark.parametrize("design", [ribbed, bowed, cut_off])
def test_the_other_half_tells_dents_where_it_is_alike(design) -> None:
    """Dents that lie on ribs can be told by the other half alone. A panel of which less than 95 % was symmetric kept
    them."""
    left, mirrored = fraction_left(design, symmetric=True)
    alone, _ = fraction_left(design, symmetric=False)
    assert left < 0.85 * alone and mirrored > 0.5 * 61 * 61   # measured: 0.57, 0.76 and 0.58 of 0.98


@pytest.mark.parametrize("design", [bowed, cut_off])
def test_what_halves_differ_by_smoothly_stays(design) -> None:
    """Evened out, a bow of one half was halved and the other half got as much."""
    V, F = grid(design)
    largest = [np.abs(press(V, F, symmetric=each)[0] - V).max() for each in (True, False)]
    assert largest[0] < 1.25 * largest[1]   # measured: 0.96 and 1.15


def test_a_panel_that_is_alike_in_part_is_counted_by_place() -> None:
    V, F = grid(cut_off)
    mirrored = press(V, F)[1].mirrored
    alike = np.count_nonzero(V[:, 1] < 0.3)
    assert 0.8 * alike < mirrored < 1.1 * alike   # measured: 2,404 of 2,440


@pytest.mark.skipif(not JUDGE.is_file(), reason="the judge's panels are not here")
def test_slivers_of_a_mesh_that_is_not_symmetric_keep_their_normals() -> None:
    """The halves of a clean boot lid have different meshes, with slivers. What vertices differ by from the tangent
    planes of partners beside them turned these by up to 97 degrees, seen from 12 degrees aside."""
    V, F, view, lines = load_panel("porsche_boot_lid")
    view = load_judge().unit(np.cos(np.radians(12)) * view + np.sin(np.radians(12)) * lines)
    lines = load_judge().unit(lines - (lines @ view) * view)
    P, report = reflines.smooth_panel(V, F, view_direction=view, line_direction=lines)
    normals = [np.cross(each[F[:, 1]] - each[F[:, 0]], each[F[:, 2]] - each[F[:, 0]]) for each in (V, P)]
    length = np.prod([np.linalg.norm(each, axis=1) for each in normals], axis=0)
    turned = np.degrees(np.arccos(np.clip((normals[0] * normals[1]).sum(axis=1) / np.maximum(length, 1e-300), -1, 1)))
    assert report.mirrored > len(V) / 2 and turned.max() < 4   # measured: 1.3; 9.9 with all that partners differ by
