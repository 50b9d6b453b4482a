"""Presses of Smooth with the border "follow": tangents become those of what lies beside across a gap."""
import numpy as np
import pytest
import reflines
from meshes import KINDS

Array = np.ndarray
DIRECTIONS = {"view_direction": (0.0, 0.0, 1.0), "line_direction": (1.0, 0.0, 0.3)}
REACH = 0.17  # two lengths of a panel of half the unit square
RADIUS = 1.2


def cylinder(x: Array, y: Array) -> Array:
    return np.sqrt(RADIUS**2 - (x - 0.3 * y) ** 2)


def cut(y: Array) -> Array:
    return 0.04 * np.sin(3.0 * y) + 0.02


def half(side: int, gap: float, kind: str, cells: int) -> tuple[Array, Array]:
    """One side of the cylinder, cut along a curve with a gap."""
    points, F = KINDS[kind](cells)
    u, y = points[:, 0] + 0.5, points[:, 1]
    end = cut(y) + 0.5 * side * gap
    x = end - (1.0 - u) * (end + 0.5) if side < 0 else end + u * (0.5 - end)
    return np.column_stack([x, y, cylinder(x, y)]), F


def rim(V: Array, gap: float) -> Array:
    return np.abs(V[:, 0] - cut(V[:, 1]) + 0.5 * gap) < 1e-9


def bend(V: Array) -> Array:
    """Heights that bend the left half at its rim, by up to 3.4 degrees, and leave the rim where it is."""
    s = np.clip((V[:, 0] - cut(V[:, 1]) + 0.15) / 0.15, 0.0, 1.0)
    return 0.009 * s**2 * np.clip(1.0 - s, 0.0, 1.0) * np.exp(-(V[:, 1] / 0.3) ** 4)


def follow(V: Array, F: Array, beside: tuple[Array, Array], **options: object) -> tuple[Array, object, object]:
    found = reflines.continue_over_gap(V, F, *beside, margin=REACH)
    codes = np.where(found.followed, 5, 2)
    positions, told = reflines.smooth_panel(V, F, **DIRECTIONS, border=codes, around=(found.V, found.F), **options)
    return positions, told, found


def tilt(V: Array, F: Array, at: Array) -> Array:
    """Degrees: the angle between the mesh's normal and the cylinder's at the vertices `at`, by fits to the one side."""
    angles = []
    for v in at:
        d = V - V[v]
        near = np.argsort(np.hypot(d[:, 0], d[:, 1]))[:24]
        size = np.hypot(d[near, 0], d[near, 1]).max()
        x, y = d[near, 0] / size, d[near, 1] / size
        powers = np.column_stack([x**i * y**j for i in range(4) for j in range(4 - i)])
        c = np.linalg.lstsq(powers, d[near, 2], rcond=None)[0] / size
        across = V[v, 0] - 0.3 * V[v, 1]
        wanted = -across / cylinder(V[v, 0], V[v, 1])
        angles.append(np.hypot(c[4] - wanted, c[1] + 0.3 * wanted))
    return np.degrees(np.array(angles))


@pytest.mark.parametrize("gap", [0.0, 0.001, 0.004, 0.008])
@pytest.mark.parametrize(("kind", "other", "cells"), [("regular", "regular", 40), ("irregular", "4-8", 29)])
def test_the_tangents_of_a_cut_cylinder_become_its_own(kind: str, other: str, cells: int, gap: float) -> None:
    (V, F), beside = half(-1, gap, kind, 40), half(1, gap, other, cells)
    bent = V.copy()
    bent[:, 2] += bend(V)
    at = np.flatnonzero(rim(V, gap) & (np.abs(V[:, 1]) < 0.38))
    positions, told, found = follow(bent, F, beside)
    before, after = tilt(bent, F, at).max(), tilt(positions, F, at).max()
    print(f"{kind}, {gap}: {before:.2f} degrees before, {after:.2f} after")
    assert told.applied and before > 3.0 and after < 0.3
    assert np.array_equal(positions[rim(V, gap)], bent[rim(V, gap)])
    assert told.notes[-1].kind == "border_turned" and 2.0 < told.notes[-1].after < 4.0
    middle = found.followed & (np.abs(V[:, 1]) < 0.4)
    assert np.allclose(found.width[middle], gap, rtol=0.02, atol=3e-4)


@pytest.mark.parametrize("gap", [0.0, 0.004])
def test_a_clean_half_moves_no_further_than_when_it_is_clamped(gap: float) -> None:
    V, F = half(-1, gap, "irregular", 40)
    positions, _, found = follow(V, F, half(1, gap, "regular", 33))
    clamped, _ = reflines.smooth_panel(V, F, **DIRECTIONS)
    assert found.followed.sum() > 35
    assert np.abs(positions - V).max() < 1.2 * np.abs(clamped - V).max() + 1e-6


def test_the_rings_lie_on_the_surface_beside() -> None:
    V, F = half(-1, 0.004, "regular", 40)
    found = reflines.continue_over_gap(V, F, *half(1, 0.004, "irregular", 33), margin=REACH)
    x, y, z = found.V.T
    assert len(x) > 250 and x.min() > cut(y).min() and np.ptp(x) > 0.1
    assert np.abs(z - cylinder(x, y)).max() < 2e-5


def test_a_step_stays_and_its_tangents_run_on() -> None:
    """What lies beside a thousandth higher is continued from the height of the border."""
    V, F = half(-1, 0.004, "regular", 40)
    other, G = half(1, 0.004, "regular", 40)
    other[:, 2] += 0.001
    found = reflines.continue_over_gap(V, F, other, G, margin=REACH)
    assert np.allclose(found.flush[found.followed], 0.001, rtol=0.1) and found.followed.sum() > 35
    assert np.abs(found.V[:, 2] - cylinder(*found.V.T[:2])).max() < 1e-4


NO_NEIGHBOURS = {  # what is made of a half and its triangles
    "no surface": lambda V, G: (V[:0], G[:0]),
    "faces away": lambda V, G: (V, G[:, ::-1]),
    "lies behind": lambda V, G: (V - [0.0, 0.0, 0.02], G),
    "overlaps": lambda V, G: (V - [0.2, 0.0, 0.001], G),
    "bends off": lambda V, G: (np.column_stack([V[:, :2], V[:, 2] + 0.3 * (V[:, 0] - cut(V[:, 1]))]), G),
    "no numbers": lambda V, G: (np.full_like(V, np.nan), G),
}


@pytest.mark.parametrize("change", NO_NEIGHBOURS.values(), ids=NO_NEIGHBOURS)
def test_what_is_no_neighbour_is_not_followed(change: object) -> None:
    V, F = half(-1, 0.004, "regular", 40)
    found = reflines.continue_over_gap(V, F, *change(*half(1, 0.004, "regular", 40)), margin=REACH)
    assert not found.followed.any() and len(found.F) == 0


def test_an_edge_with_a_hem_turned_away_is_open_and_one_that_runs_on_is_not() -> None:
    V, F = half(-1, 0.004, "regular", 40)
    beside = half(1, 0.004, "regular", 40)
    order = np.flatnonzero(rim(V, 0.004))
    order = order[np.argsort(V[order, 1])]
    counts = []
    for shift in ([0.0, 0.0, -0.02], [0.02, 0.0, -0.004]):
        more = len(V) + np.arange(len(order))
        strips = np.concatenate([np.column_stack([order[1:], order[:-1], more[:-1]]),
                                 np.column_stack([order[1:], more[:-1], more[1:]])])
        found = reflines.continue_over_gap(V, F, *beside, margin=REACH, around=(V[order] + shift, strips))
        counts.append(found.followed.sum())
    assert counts[0] > 35 and counts[1] == 0


def test_what_cannot_be_neighbours_is_refused() -> None:
    V, F = half(-1, 0.004, "regular", 10)
    with pytest.raises(ValueError, match="beyond the 3"):
        reflines.continue_over_gap(V, F, np.zeros((3, 3)), np.array([[0, 1, 3]]))
    with pytest.raises(ValueError, match="gap must be"):
        reflines.continue_over_gap(V, F, V, F, gap=-1.0)


def test_half_the_strength_turns_the_border_by_half() -> None:
    V, F = half(-1, 0.0, "regular", 40)
    beside = half(1, 0.0, "regular", 40)
    bent = V.copy()
    bent[:, 2] += bend(V)
    whole, some = (follow(bent, F, beside, strength=strength)[0] for strength in (1.0, 0.5))
    assert np.allclose(some - bent, 0.5 * (whole - bent), atol=1e-12)


def test_no_vertex_moves_beyond_the_limit() -> None:
    V, F = half(-1, 0.0, "regular", 40)
    bent = V.copy()
    bent[:, 2] += bend(V)
    positions, told, _ = follow(bent, F, half(1, 0.0, "regular", 40), limit=1e-3)
    assert told.largest_move <= 1e-3 and np.abs(positions - bent).max() <= 1e-3 and told.largest_move > 6e-4


@pytest.mark.parametrize("case", ["a limit that leaves most of a kink", "a kink that runs into a held corner"])
def test_a_border_is_clamped_where_following_would_make_a_worse_place(case: str) -> None:
    V, F = half(-1, 0.0, "regular", 40)
    beside = half(1, 0.0, "regular", 40)
    bent, options = V.copy(), {}
    if "limit" in case:
        bent[:, 2] += bend(V)
        options = {"limit": 3e-4}
    else:
        x = V[:, 0] - cut(V[:, 1])
        bent[:, 2] += 0.06 * x * np.exp(-(x / 0.15) ** 2)
    positions, told, found = follow(bent, F, beside, **options)
    clamped, _ = reflines.smooth_panel(bent, F, **DIRECTIONS, **options)
    assert found.followed.any() and np.array_equal(positions, clamped)
    assert told.notes[-1].kind == "following_worsens"
