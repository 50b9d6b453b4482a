"""The press of Smooth with a share of its limit for each vertex."""
import numpy as np
import pytest
import reflines
from sample_cages import LINE as CAGE_LINE
from sample_cages import VIEW as CAGE_VIEW
from sample_cages import dented, hood
from sample_panels import LINE, VIEW, panel, rippled

LIMIT, ROUNDING = 5e-4, 1e-15


def press(V: np.ndarray, F: np.ndarray, **options: object) -> np.ndarray:
    """Returns the moves along the view."""
    positions, report = reflines.smooth_panel(V, F, view_direction=VIEW, line_direction=LINE, limit=LIMIT, **options)
    assert report.applied
    return (positions - V) @ VIEW


@pytest.mark.parametrize(("lowest", "highest"), [(-1.0, 0.0), (0.0, 1.0), (-0.2, 0.7)])
def test_no_vertex_leaves_its_range(lowest: float, highest: float) -> None:
    V, F = panel(24, jitter=0.0)
    V = rippled(V, amplitude=0.002, wavelength=0.3)
    moves = press(V, F, limit_range=np.tile([lowest, highest], (len(V), 1)))
    assert lowest * LIMIT - ROUNDING <= moves.min() and moves.max() <= highest * LIMIT + ROUNDING
    assert np.abs(moves).max() > 0.1 * LIMIT


def test_the_whole_share_is_no_share() -> None:
    V, F = panel(24, jitter=0.0)
    V = rippled(V, amplitude=0.002, wavelength=0.3)
    assert np.array_equal(press(V, F), press(V, F, limit_range=np.tile([-1.0, 1.0], (len(V), 1))))


def test_a_cage_has_shares_too() -> None:
    V, offsets, corners = dented(hood(), CAGE_VIEW, CAGE_LINE)
    share = np.tile([-1.0, 0.0], (len(V), 1))
    positions, report = reflines.smooth_cage_panel(V, offsets, corners, view_direction=CAGE_VIEW,
                                                   line_direction=CAGE_LINE, limit_range=share)
    moves = (positions - V) @ CAGE_VIEW
    assert moves.max() <= ROUNDING
    assert moves.min() >= -report.limit - ROUNDING


def test_without_a_limit_a_share_of_nothing_is_nothing() -> None:
    V, F = panel(24, jitter=0.0)
    V = rippled(V, amplitude=0.002, wavelength=0.3)
    share = np.tile([-1.0, 1.0], (len(V), 1))
    share[V[:, 0] > 0] = 0
    positions, report = reflines.smooth_panel(V, F, view_direction=VIEW, line_direction=LINE, limit=np.inf,
                                              limit_range=share)
    assert report.applied and report.limited > 0
    assert np.array_equal(positions[V[:, 0] > 0], V[V[:, 0] > 0]) and not np.array_equal(positions, V)


def test_partners_of_a_cage_keep_equal_moves_under_unequal_shares() -> None:
    V, offsets, corners = hood()
    V += 0.002 * np.sin(50 * np.abs(V[:, :1])) * np.cos(45 * V[:, 1:2]) * CAGE_VIEW
    partner = reflines.mirror_pairs(V, point=(0, 0, 0), normal=(1, 0, 0), tolerance=1e-6)
    share = np.tile([-1.0, 1.0], (len(V), 1))
    share[V[:, 0] > 0] *= 0.1
    positions, _ = reflines.smooth_cage_panel(V, offsets, corners, view_direction=CAGE_VIEW, line_direction=CAGE_LINE,
                                              level=1, partner=partner, limit_range=share, limit=1e-3)
    moves = (positions - V) @ CAGE_VIEW
    assert np.abs(moves).max() > 1e-5
    assert np.abs(moves - moves[partner]).max() < 1e-12


@pytest.mark.parametrize(("share", "said"), [
    (np.zeros((3, 2)), "3 lowest and 3 highest"),
    (np.tile([0.5, 1.0], (81, 1)), "limit of 81 of the 81"),
    (np.tile([-1.0, np.nan], (81, 1)), "limit of 81 of the 81"),
    (np.tile([-2.0, 1.0], (81, 1)), "share of the limit of 81 of the 81"),
])
def test_shares_that_cannot_be_are_counted(share: np.ndarray, said: str) -> None:
    V, F = panel(8)
    with pytest.raises(reflines.InvalidInput, match=said):
        press(V, F, limit_range=share)
