"""Meshes of stretched cells, as real panels have: errors follow the spacing in each direction, not the aspect."""
import numpy as np
import pytest
import reflines
from meshes import stretched

pytest.importorskip("matplotlib", reason="figures are drawn where the project is built, not where it is used")

from figures import sphere  # noqa: E402  (it imports it)

KINDS = ("regular", "irregular")
LENGTH = 0.25


def dented(columns: int, rows: int, kind: str, axis: int = 0) -> reflines.ShapeOptimizer:
    """A crowned plate with a dent that every mesh resolves."""
    points, triangles = stretched(columns, rows, kind)
    x, y = points.T
    dent = 0.003 * np.exp(-((x - 0.1)**2 + (y + 0.05)**2) / 0.006)
    V = np.column_stack([points, -0.15 * x**2 - 0.1 * y**2 + dent])
    return reflines.ShapeOptimizer(V, triangles, view_direction=[0, 0, 1], line_direction=np.eye(3)[axis])


def smoothing_error(columns: int, rows: int, kind: str) -> float:
    """The error of the move of Smooth against that on a fine mesh, relative to it."""
    fine, solver = dented(120, 120, "regular"), dented(columns, rows, kind)
    moves = []
    for each in (fine, solver):
        start = each.heights
        each.solve(reflines.smooth(each, length=LENGTH))
        moves.append(each.heights - start)
    place = np.rint((stretched(columns, rows, "regular")[0] + 0.5) * 120).astype(int)
    wanted = moves[0][place[:, 1] * 121 + place[:, 0]]
    return float(np.linalg.norm(moves[1] - wanted) / np.linalg.norm(wanted))


@pytest.mark.parametrize("kind", KINDS)
def test_the_sphere_is_recovered_whatever_the_aspect(kind) -> None:
    """The error was 5e-3 at 256 x 32 while the choice of stencils depended on the aspect."""
    errors = [sphere.recover_on(stretched(32 * aspect, 32, kind), kind, "consistent", 32).error
              for aspect in (1, 4, 16)]
    assert max(errors) < 1.2e-4, errors


@pytest.mark.parametrize("kind", KINDS)
def test_recovery_is_of_second_order_in_the_long_spacing(kind) -> None:
    """To be exact, of an order above 1.5: the error of a mesh made at random is one of chance too."""
    coarse, fine = (sphere.recover_on(stretched(4 * rows, rows, kind), kind, "consistent", rows).error
                    for rows in (24, 96))
    assert fine < coarse / 8, (coarse, fine)


@pytest.mark.parametrize("kind", KINDS)
def test_a_dent_scores_the_same_whatever_the_aspect(kind) -> None:
    """Nearly that of a mesh four times as fine in both directions."""
    for axis in (0, 1):
        fine, even, long = (dented(columns, rows, kind, axis).score(LENGTH).shift
                            for columns, rows in ((160, 160), (40, 40), (320, 40)))
        assert even == pytest.approx(fine, rel=0.12) and long == pytest.approx(fine, rel=0.12), (kind, axis)


@pytest.mark.parametrize("columns", [40, 120])
def test_a_refined_mesh_smooths_no_worse(columns) -> None:
    """20 x 20 cells cut finer in one direction were off by 2.2 times the move."""
    assert smoothing_error(columns, 20, "regular") < smoothing_error(20, 20, "regular")
