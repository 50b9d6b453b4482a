"""Presses of Smooth on several panels at once: one surface that gaps cut is healed as if it were whole."""
import numpy as np
import pytest
import reflines
from meshes import KINDS
from test_follow_border import DIRECTIONS, REACH, Array, bend, cut, cylinder, half, rim, tilt

Mesh = tuple[Array, Array]
CLAMPED, FOLLOW = 2, 5  # codes of borders


def press(*meshes: Mesh, strength: float = 1.0, limit: float | None = None, **options: object) -> list:
    smoother = reflines.JointSmoother([reflines.JointPanel(*mesh, **DIRECTIONS, margin=REACH, **options)
                                       for mesh in meshes])
    count = len(meshes)
    return smoother.press(strengths=[strength] * count, limits=[limit] * count, limit_ranges=[None] * count)


def dent(V: Array) -> Array:
    """Heights of a dent that lies across the cut."""
    return -0.004 * np.exp(-((V[:, 0] - cut(V[:, 1])) ** 2 + V[:, 1] ** 2) / 0.05**2)


def bend_right(V: Array) -> Array:
    s = np.clip((cut(V[:, 1]) - V[:, 0] + 0.15) / 0.15, 0.0, 1.0)
    return 0.009 * s**2 * np.clip(1.0 - s, 0.0, 1.0) * np.exp(-(V[:, 1] / 0.3) ** 4)


def change(V: Array, heights: Array) -> Array:
    return V + heights[:, None] * [0.0, 0.0, 1.0]


def off(V: Array) -> Array:
    return np.abs(V[:, 2] - cylinder(V[:, 0], V[:, 1]))


def halves(gap: float) -> tuple[Mesh, Mesh]:
    return half(-1, gap, "regular", 40), half(1, gap, "irregular", 29)


@pytest.mark.parametrize("gap", [0.0, 0.001, 0.004, 0.008])
def test_both_sides_of_a_kink_are_turned_and_the_gap_stays(gap: float) -> None:
    (V, F), (W, G) = halves(gap)
    bent = change(V, bend(V)), change(W, bend_right(W))
    (left, told), (right, _) = press((bent[0], F), (bent[1], G))
    at = np.flatnonzero(rim(V, gap) & (np.abs(V[:, 1]) < 0.38))
    assert told.applied and tilt(bent[0], F, at).max() > 3.0 and tilt(left, F, at).max() < 0.55
    assert np.abs(left - bent[0])[rim(V, gap)].max() < 3e-4
    assert np.array_equal(left[:, :2], V[:, :2]) and np.array_equal(right[:, :2], W[:, :2])


@pytest.mark.parametrize("gap", [0.0, 0.004])
def test_a_dent_across_a_gap_goes_and_both_rims_move_alike(gap: float) -> None:
    (V, F), (W, G) = halves(gap)
    (left, told), (right, other) = press((change(V, dent(V)), F), (change(W, dent(W)), G))
    assert told.applied and other.applied
    assert max(off(left).max(), off(right).max()) < 0.3 * np.abs(dent(V)).max()
    alone = reflines.smooth_panel(change(V, dent(V)), F, **DIRECTIONS)[0]
    assert off(alone).max() > 0.9 * np.abs(dent(V)).max()
    moved, moved_right = (left - V)[:, 2] - dent(V), (right - W)[:, 2] - dent(W)
    own, across = rim(V, gap), np.abs(W[:, 0] - cut(W[:, 1]) - 0.5 * gap) < 1e-9
    order = np.flatnonzero(across)[np.argsort(W[across, 1])]
    apart = moved[own] - np.interp(V[own, 1], W[order, 1], moved_right[order])
    assert np.abs(moved[own]).max() > 0.0029 and np.abs(apart).max() < 3e-4


def sheet(low: tuple[float, float], high: tuple[float, float], kind: str, cells: int) -> Mesh:
    """A rectangle of the cylinder."""
    points, F = KINDS[kind](cells)
    x, y = (np.array(low) + (points[:, :2] + 0.5) * (np.array(high) - low)).T
    return np.column_stack([x, y, cylinder(x, y)]), F


def test_clean_halves_move_no_further_than_the_uncut_sheet() -> None:
    sheets = [sheet((-0.5, -0.5), (0.5, 0.5), kind, 40) for kind in ("regular", "irregular")]
    most = max(np.abs(reflines.smooth_panel(V, F, **DIRECTIONS)[0] - V).max() for V, F in sheets)
    meshes = halves(0.004)
    for (positions, _), (start, _) in zip(press(*meshes), meshes, strict=True):
        assert np.abs(positions - start).max() < 1.2 * most + 1e-6


def test_dents_across_the_gaps_of_three_panels_go() -> None:
    gap = 0.002
    panels = [sheet((-0.5, -0.5), (-gap, 0.5), "regular", 40), sheet((gap, -0.5), (0.5, -gap), "irregular", 30),
              sheet((gap, gap), (0.5, 0.5), "4-8", 14)]
    dents = [-0.002 * (np.exp(-(V[:, 0] ** 2 + (V[:, 1] - 0.25) ** 2) / 0.05**2)
                       + np.exp(-((V[:, 0] - 0.25) ** 2 + V[:, 1] ** 2) / 0.05**2)) for V, _ in panels]
    dented = [(change(V, heights), F) for (V, F), heights in zip(panels, dents, strict=True)]
    results = press(*dented)
    assert all(told.applied for _, told in results)
    before, after = (np.sqrt(np.mean(np.concatenate([off(V) for V, _ in each]) ** 2)) for each in (dented, results))
    assert after < 0.3 * before


def test_the_order_of_the_panels_does_not_matter() -> None:
    (V, F), (W, G) = halves(0.004)
    meshes = (change(V, dent(V)), F), (change(W, dent(W)), G)
    one, other = press(*meshes), press(*meshes[::-1])[::-1]
    assert all(np.array_equal(a, b) for (a, _), (b, _) in zip(one, other, strict=True))


def test_a_second_press_is_that_of_a_new_smoother() -> None:
    (V, F), (W, G) = halves(0.004)
    panels = [reflines.JointPanel(change(P, dent(P)), T, **DIRECTIONS, margin=REACH) for P, T in ((V, F), (W, G))]
    smoother = reflines.JointSmoother(panels)
    amount = {"limits": [None] * 2, "limit_ranges": [None] * 2}
    smoother.press(strengths=[1.0, 1.0], **amount)
    again = smoother.press(strengths=[0.5, 0.5], **amount)
    fresh = reflines.JointSmoother(panels).press(strengths=[0.5, 0.5], **amount)
    assert all(np.array_equal(a, b) for (a, _), (b, _) in zip(again, fresh, strict=True))


def test_panels_that_face_nothing_are_pressed_alone() -> None:
    (V, F), (W, G) = halves(0.004)
    far = W + [1.0, 0.0, 0.0]
    for (positions, _), mesh in zip(press((V, F), (far, G)), ((V, F), (far, G)), strict=True):
        assert np.array_equal(positions, reflines.smooth_panel(*mesh, **DIRECTIONS)[0])


def test_a_panel_that_faces_others_with_held_vertices_alone_is_pressed_alone() -> None:
    """Clamped vertices hold those beside them: of two that follow none is free."""
    (V, F), (W, G) = half(-1, 0.004, "regular", 40), half(1, 0.004, "regular", 29)
    border = np.full(len(V), CLAMPED)
    at = np.flatnonzero(rim(V, 0.004))
    border[at[np.argsort(np.abs(V[at, 1]))[:2]]] = FOLLOW
    panels = (reflines.JointPanel(change(V, dent(V)), F, **DIRECTIONS, margin=REACH, border=border),
              reflines.JointPanel(W, G, **DIRECTIONS, margin=REACH))
    (left, _), (right, _) = reflines.JointSmoother(panels).press(strengths=[1.0] * 2, limits=[None] * 2,
                                                                 limit_ranges=[None] * 2)
    assert np.array_equal(left, reflines.smooth_panel(change(V, dent(V)), F, **DIRECTIONS)[0])
    assert right.shape == W.shape


def test_what_stays_beside_is_followed_and_the_other_panels_move() -> None:
    """Of three halves in a row the first one stays: all of the kink beside it is turned by the second."""
    (V, F), (W, G) = half(-1, 0.004, "regular", 40), half(1, 0.004, "regular", 33)
    bent = change(V, bend(V))
    stays = reflines.JointPanel(bent, F, **DIRECTIONS, margin=REACH, beside=(W, G))
    other = reflines.JointPanel(W + [3.0, 0.0, 0.0], G, **DIRECTIONS, margin=REACH)
    smoother = reflines.JointSmoother([stays, other])
    (left, _), _ = smoother.press(strengths=[1.0] * 2, limits=[None] * 2, limit_ranges=[None] * 2)
    at = np.flatnonzero(rim(V, 0.004) & (np.abs(V[:, 1]) < 0.38))
    assert tilt(left, F, at).max() < 0.3 and np.array_equal(left[rim(V, 0.004)], bent[rim(V, 0.004)])


def test_no_vertex_moves_beyond_the_limit() -> None:
    (V, F), (W, G) = halves(0.004)
    meshes = (change(V, dent(V)), F), (change(W, dent(W)), G)
    for (positions, told), (start, _) in zip(press(*meshes, limit=1e-3), meshes, strict=True):
        assert np.abs(positions - start).max() <= 1e-3 and told.largest_move <= 1e-3


def test_what_cannot_be_pressed_is_refused() -> None:
    with pytest.raises(reflines.InvalidInput, match="no panels"):
        reflines.JointSmoother([])
    (V, F), _ = halves(0.004)
    smoother = reflines.JointSmoother([reflines.JointPanel(V, F, **DIRECTIONS)])
    with pytest.raises(reflines.InvalidInput, match="strength, a limit"):
        smoother.press(strengths=[1.0], limits=[], limit_ranges=[None])
    with pytest.raises(reflines.InvalidInput, match="amount of its own"):
        smoother.press(strengths=[1.0] * 2, limits=[None] * 2, limit_ranges=[None] * 2)
