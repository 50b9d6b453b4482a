"""Parts of one region that touch without a common edge: lines are smoothed as if joined, and nothing tears."""
import numpy as np
import pytest
import reflines
from test_follow_border import DIRECTIONS, Array, bend, cut, half, rim, tilt
from test_joint_smoother import bend_right, change, dent, off
from test_shut_lines import Mesh, join

INNER = 0.38  # of y, beside the corners


def parts(gap: float, other: str = "irregular", cells: int = 29) -> tuple[Mesh, Mesh]:
    return half(-1, gap, "regular", 40), half(1, gap, other, cells)


def press(*meshes: Mesh, **options: object) -> tuple[list[Array], object]:
    V, F = join(*meshes)
    positions, told = reflines.smooth_panel(V, F, **DIRECTIONS, **options)
    return np.split(positions, np.cumsum([len(W) for W, _ in meshes])[:-1]), told


@pytest.mark.parametrize("border", ["clamped", "free"])
def test_the_kink_of_two_parts_that_touch_goes(border: str) -> None:
    (V, F), (W, G) = parts(0.0)
    bent = change(V, bend(V)), change(W, bend_right(W))
    (left, right), told = press((bent[0], F), (bent[1], G), border=border)
    at = np.flatnonzero(rim(V, 0.0) & (np.abs(V[:, 1]) < INNER))
    assert told.applied and tilt(bent[0], F, at).max() > 3.0 and tilt(left, F, at).max() < 0.4
    alone = reflines.smooth_panel(bent[0], F, **DIRECTIONS)[0]
    assert tilt(alone, F, at).max() > 1.0
    assert np.abs(left - bent[0])[:, :2].max() == 0.0 and np.abs(right - bent[1])[:, 2].max() > 1e-4


@pytest.mark.parametrize("border", ["clamped", "free"])
def test_a_dent_goes_and_vertices_on_each_other_stay_so(border: str) -> None:
    (V, F), (W, G) = parts(0.0, "regular", 40)
    (left, right), told = press((change(V, dent(V)), F), (change(W, dent(W)), G), border=border)
    assert told.applied and max(off(left).max(), off(right).max()) < 0.3 * np.abs(dent(V)).max()
    one, other = np.flatnonzero(rim(V, 0.0)), np.flatnonzero(np.isclose(W[:, 0], cut(W[:, 1]), rtol=0.0, atol=1e-9))
    one, other = one[np.argsort(V[one, 1])], other[np.argsort(W[other, 1])]
    same = np.flatnonzero((V[one] == W[other]).all(axis=1))
    assert len(same) > 20 and np.array_equal(left[one][same], right[other][same])
    assert np.abs((left - change(V, dent(V)))[one]).max() > 0.0029


def test_parts_across_a_gap_are_one_where_that_is_asked_for() -> None:
    (V, F), (W, G) = parts(0.004)
    dented = (change(V, dent(V)), F), (change(W, dent(W)), G)
    for options, share in (({}, 0.7), ({"parts_gap": 0.01}, 0.3)):
        (left, _), _ = press(*dented, **options)
        assert (off(left).max() < share * np.abs(dent(V)).max()) == ("parts_gap" in options)


def test_the_report_is_of_all_parts() -> None:
    (V, F), (W, G) = parts(0.0)
    far = W + [1.0, 0.0, 0.0]
    _, told = press((change(V, dent(V)), F), (change(W, dent(W)), G), (far, G))
    assert told.region.triangles == len(F) + 2 * len(G) == len(told.line_deviation)
    assert told.healed.worst_after < 0.3 * told.healed.worst_before
    assert told.largest_move > 0.0029 and len(told.unevenness_after) == 2


def test_images_in_two_parts_move_alike() -> None:
    (V, F), _ = parts(0.0)
    x = V[:, 0] - cut(V[:, 1])
    V = np.column_stack([x, V[:, 1], 0.3 - 0.4 * x**2])
    dented = change(V, -0.004 * np.exp(-(V[:, 0] ** 2 + V[:, 1] ** 2) / 0.05**2))
    image = dented * [-1.0, 1.0, 1.0]
    partner = np.concatenate([np.arange(len(V)) + len(V), np.arange(len(V))])
    (left, right), told = press((dented, F), (image, F[:, ::-1]), partner=partner)
    assert told.applied and np.array_equal(left * [-1.0, 1.0, 1.0], right)
    assert np.abs(left - dented).max() > 0.0029


def test_a_held_border_keeps_its_bits() -> None:
    (V, F), (W, G) = parts(0.0)
    bent = change(V, bend(V)), change(W, bend_right(W))
    (left, _), _ = press((bent[0], F), (bent[1], G), border="fixed")
    assert np.array_equal(left[rim(V, 0.0)], bent[0][rim(V, 0.0)])


def test_a_gap_that_is_no_length_is_refused() -> None:
    (V, F), _ = parts(0.0)
    with pytest.raises(reflines.InvalidInput, match="gap between parts"):
        reflines.smooth_panel(V, F, **DIRECTIONS, parts_gap=-1.0)


def test_a_scrap_that_touches_keeps_nothing_from_being_healed() -> None:
    """A part without an inner vertex stays as it is."""
    (V, F), (W, G) = parts(0.0)
    corner = V[np.argmax(np.where(rim(V, 0.0), V[:, 1], -1.0))]
    scrap = corner + np.array([[0.0, 0.0, 0.0], [0.02, 0.0, 0.0], [0.0, 0.02, 0.0]])
    (left, _, last), told = press((change(V, dent(V)), F), (change(W, dent(W)), G), (scrap, np.array([[0, 1, 2]])))
    assert told.applied and off(left).max() < 0.3 * np.abs(dent(V)).max() and np.array_equal(last, scrap)
