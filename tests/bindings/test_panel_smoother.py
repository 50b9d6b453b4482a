"""A panel smoother gives the bits of a single press, whatever was pressed before, and finds the flaws once."""
import numpy as np
import pytest
import reflines
import sample_cages
from sample_panels import LINE, VIEW, panel
from test_curvature_border import Panel
from test_fair_border import design, flaw

Array = np.ndarray
DIRECTIONS = {"view_direction": VIEW, "line_direction": LINE}
LENGTH = 0.1
# In this order: a limit after none, a smaller strength after that, a larger limit, and the first again.
AMOUNTS = ({}, {"limit": 2e-4}, {"strength": 0.4, "limit": 2e-4}, {"limit": 4e-4}, {"strength": 0.7}, {})


def rippled_mesh() -> tuple[tuple[Array, Array], dict]:
    V, F = panel(32)
    V[:, 2] += flaw("ripples", V) + flaw("dent", V)
    return (V, F), {"length": LENGTH}


def region(kind: str) -> tuple[tuple[Array, Array], dict]:
    V, F = design("jittered")
    V[:, 2] += flaw(kind, V)
    whole = Panel(V, F)
    return (V[whole.used], whole.own), {"length": LENGTH, "around": whole.around}


def continued_region() -> tuple[tuple[Array, Array], dict]:
    mesh, settings = region("ripples")
    return mesh, {**settings, "border": "curvature"}


def faired_region() -> tuple[tuple[Array, Array], dict]:
    mesh, settings = region("noise")
    return mesh, {**settings, "fair_border": np.ones(len(mesh[0]), bool)}


def loose_vertices() -> tuple[tuple[Array, Array], dict]:
    (V, F), settings = rippled_mesh()
    return (np.vstack([V[:1] + 1, V]), F + 1), settings


@pytest.mark.parametrize("pose", [rippled_mesh, continued_region, faired_region, loose_vertices])
def test_press_is_that_of_smooth_panel(pose) -> None:
    mesh, settings = pose()
    smoother = reflines.PanelSmoother(*mesh, **DIRECTIONS, **settings)
    for amount in AMOUNTS:
        again, told_again = smoother.press(**amount)
        once, told = reflines.smooth_panel(*mesh, **DIRECTIONS, **settings, **amount)
        assert np.array_equal(again, once), amount
        assert (told_again.limited, told_again.limit, told_again.notes) == (told.limited, told.limit, told.notes)
        assert told_again.healed.area == pytest.approx(told.healed.area, rel=1e-9)
        assert told_again.unevenness_after == pytest.approx(told.unevenness_after, rel=1e-9)
        assert told_again.longer_waves == told.longer_waves
    assert told.applied and told.largest_move > 0 and told.healed.area > 0


def test_press_of_a_cage_is_that_of_smooth_cage_panel() -> None:
    V, offsets, corners = sample_cages.hood()
    cage = V + np.outer(4e-3 * np.random.default_rng(2).standard_normal(len(V)), VIEW), offsets, corners
    share = np.tile([-1.0, 0.5], (len(V), 1))
    smoother = reflines.PanelSmoother.create_for_cage(*cage, **DIRECTIONS, level=1)
    for amount in ({}, {"limit": 1e-3, "limit_range": share}, {"strength": 0.5}, {}):
        again, told = smoother.press(**amount)
        assert np.array_equal(again, reflines.smooth_cage_panel(*cage, **DIRECTIONS, level=1, **amount)[0]), amount
    assert told.largest_control_move > 0


@pytest.mark.parametrize("pose", [rippled_mesh, continued_region, faired_region])
def test_a_press_that_is_not_judged_has_the_same_positions(pose) -> None:
    mesh, settings = pose()
    smoother = reflines.PanelSmoother(*mesh, **DIRECTIONS, **settings)
    for amount in AMOUNTS:
        shown = smoother.press(judged=False, **amount)[0]
        judged, told = smoother.press(**amount)
        assert told.applied and np.array_equal(shown, judged), amount


def test_a_press_that_is_not_judged_solves_for_no_measures() -> None:
    mesh, _ = rippled_mesh()
    smoother = reflines.PanelSmoother(*mesh, **DIRECTIONS)
    smoother.press(judged=False)
    told = smoother.press(judged=False, strength=0.5)[1]
    assert (told.work.factorizations, told.work.solves) == (0, 0) and told.largest_move > 0


def test_second_press_looks_for_no_flaws() -> None:
    mesh, _ = rippled_mesh()
    smoother = reflines.PanelSmoother(*mesh, **DIRECTIONS)
    stages, factorizations = [], []
    for amount in AMOUNTS:
        progress = reflines.Progress()
        told = smoother.press(progress=progress, **amount)[1]
        stages.append(progress.stage)
        factorizations.append(told.work.factorizations)
    assert stages[0] == "smoothing the lines"  # the last stage of a press is that of the longer waves
    assert not {"smoothing the lines", "looking for dents"} & set(stages[1:]), stages
    assert factorizations[0] <= 8, factorizations
    assert factorizations[-2:] == [0, 0], factorizations


def test_work_of_a_press_is_what_its_parts_need() -> None:
    """Five lengths, one more for longer waves, and one solve, with the solves of the measures: no more on any mesh."""
    for cells in (24, 48):
        V, F = panel(cells)
        V[:, 2] += flaw("noise", V)
        work = reflines.smooth_panel(V, F, **DIRECTIONS)[1].work
        assert work.factorizations <= 8 and work.solves <= 24, (cells, work.factorizations, work.solves)


def test_faces_held_for_one_amount_are_free_for_the_next() -> None:
    """At the whole strength two hundred spikes as high as the cells turn some faces; at a tenth of it none turns."""
    V, F = panel(32)
    rng = np.random.default_rng(4)
    middle = np.flatnonzero((np.abs(V[:, :2] - V[:, :2].mean(axis=0)) < 0.3).all(axis=1))
    spikes = rng.choice(middle, 200, replace=False)
    V[spikes, 2] += 0.02 * rng.choice([-1, 1], len(spikes))
    smoother = reflines.PanelSmoother(V, F, **DIRECTIONS, length=LENGTH)
    held = []
    for amount in ({"limit": 1.0}, {"strength": 0.1, "limit": 1.0}, {"limit": 1.0}):
        positions, told = smoother.press(**amount)
        once, told_once = reflines.smooth_panel(V, F, **DIRECTIONS, length=LENGTH, **amount)
        assert np.array_equal(positions, once) and told.held_faces == told_once.held_faces
        held.append(told.held_faces)
    assert held[0] == held[2] > held[1]


def test_press_after_a_cancelled_one_begins_anew() -> None:
    mesh, settings = rippled_mesh()
    smoother = reflines.PanelSmoother(*mesh, **DIRECTIONS, **settings)
    first = smoother.press()[0]
    progress = reflines.Progress()
    progress.cancel()
    with pytest.raises(reflines.Cancelled):
        smoother.press(strength=0.5, limit=1e-4, progress=progress)
    assert np.array_equal(smoother.press()[0], first)


@pytest.mark.parametrize(("amount", "sentence"), [
    ({"strength": 1.5}, "strength must lie between 0 and 1"), ({"strength": np.nan}, "strength must lie between"),
    ({"limit": -1.0}, "limit must be a positive length"), ({"limit_range": np.zeros((3, 2))}, "3"),
])
def test_bad_amount_is_refused_and_spoils_nothing(amount: dict, sentence: str) -> None:
    mesh, settings = rippled_mesh()
    smoother = reflines.PanelSmoother(*mesh, **DIRECTIONS, **settings)
    first = smoother.press()[0]
    with pytest.raises(reflines.InvalidInput, match=sentence):
        smoother.press(**amount)
    assert np.array_equal(smoother.press()[0], first)
