"""Presses with a set of lights, each with the eye that sees it: none becomes worse, and bad sets get a sentence."""
from functools import cache

import numpy as np
import pytest
import reflines
import sample_cages
from dented_dome import LIGHT, VIEW, clean, dented, grid
from sample_panels import find_normals, theta_of

Array = np.ndarray
EYES, LINES = reflines.walk_around(VIEW, LIGHT, (0, 1, 0))
CELLS = 40
PAIRS = [(eye, line) for eye in EYES for line in LINES[[0, 4]]]


def walk(**options: object) -> reflines.LightSet:
    eyes, lines = (np.array(each) for each in zip(*PAIRS, strict=True))
    return reflines.LightSet(lines, eyes, **options)


def press(V: Array, F: Array, light_set: reflines.LightSet | None = None,
          **options: object) -> tuple[Array, reflines.SmoothPanelReport]:
    return reflines.smooth_panel(V, F, view_direction=VIEW, line_direction=LIGHT, light_set=light_set, **options)


def measure(V: Array, F: Array, eye: Array, line: Array) -> float:
    """Degrees of theta from the lines of the clean dome, root mean square over the triangles."""
    x, y = V[:, :2].T
    values = [theta_of(find_normals(each, F), eye, line) for each in (V, np.stack([x, y, clean(x, y)], 1))]
    return float(np.degrees(np.sqrt(np.mean(np.angle(np.exp(1j * (values[0] - values[1]))) ** 2))))


@cache
def press_dome(limit: float | None) -> tuple[Array, Array, Array, reflines.SmoothPanelReport]:
    """Presses a dome with three dents with the walk around: vertices before, triangles, vertices after, report."""
    V, F = grid(dented(count=3), CELLS)
    return V, F, *press(V, F, walk(), limit=limit)


@pytest.mark.parametrize("limit", [None, 0.001])
def test_no_light_from_no_side_is_worse_after_a_press_with_the_walk_around(limit: float | None):
    V, F, positions, report = press_dome(limit)
    assert report.applied and len(report.seen) == len(PAIRS)
    assert all(after < before for before, after in
               zip(report.unevenness_before, report.unevenness_after, strict=True))
    for eye in EYES:
        for line in LINES:
            assert measure(positions, F, eye, line) < 0.8 * measure(V, F, eye, line)


def test_the_set_serves_each_light_nearly_as_well_as_a_press_for_it_alone():
    """That holds with a limit, too, where the lights compete; and the press moves no further."""
    V, F, positions, report = press_dome(0.001)
    assert report.limited
    for eye, line in PAIRS:
        alone, own = press(V, F, reflines.LightSet([line], [eye]), limit=0.001)
        assert measure(positions, F, eye, line) < 1.35 * measure(alone, F, eye, line)
        assert report.largest_move <= 1.1 * own.largest_move


def test_which_flaws_are_found_does_not_depend_on_the_lights_of_the_set():
    """Where nothing holds a press back it ends in the shape without flaws, whatever lights it is for."""
    V, F = grid(dented(count=3), CELLS)
    crossed, _ = press(V, F)
    for eye, line in ((EYES[0], LINES[1]), (EYES[2], LINES[6])):
        assert np.abs(press(V, F, reflines.LightSet([line], [eye]))[0] - crossed).max() < 1e-9 * np.abs(V).max()


def test_a_cage_is_pressed_for_the_set():
    cage = sample_cages.dented(sample_cages.hood(), sample_cages.VIEW, sample_cages.LINE)
    eyes, lines = reflines.walk_around(sample_cages.VIEW, sample_cages.LINE)
    light_set = reflines.LightSet(np.tile(lines[[0, 4]], (5, 1)), np.repeat(eyes, 2, axis=0))
    _, report = reflines.smooth_cage_panel(*cage, view_direction=sample_cages.VIEW, line_direction=sample_cages.LINE,
                                           light_set=light_set)
    assert report.applied and len(report.unevenness_after) == 10
    assert max(np.divide(report.unevenness_after, report.unevenness_before)) < 0.9


def test_a_heavier_light_ends_more_even_where_a_limit_holds_the_press_back():
    V, F = grid(dented(), CELLS)
    straight = [reflines.LightSet(LINES[[0, 4]], weight=weight) for weight in ([1.0, 0.0], [0.0, 1.0])]
    off = [[measure(press(V, F, light_set, limit=4e-4)[0], F, VIEW, line) for line in LINES[[0, 4]]]
           for light_set in straight]
    assert off[0][0] < off[1][0] and off[1][1] < off[0][1]


def test_the_place_that_became_worse_is_told_with_its_light():
    """A limit leaves most of a dent, and an edge round it, where the lines were even."""
    V, F = grid(dented(depth=0.004), 60)
    positions, report = press(V, F, limit=6e-4)
    worse = report.healed.worse
    away = np.linalg.norm(V[F].mean(1) - worse.place, axis=1)
    there = F[away < 0.35 * report.length]
    line = (LIGHT, np.cross(VIEW, LIGHT))[worse.light]
    assert measure(positions, there, VIEW, line) > 0.1 + measure(V, there, VIEW, line)
    assert worse.after > 0.1 + worse.before and worse.after > 0.3
    assert press(V, F, limit=0.1)[1].healed.worse.light == -1


def test_lights_that_took_no_part_judge_a_press():
    """A limit leaves an edge round the dent, which is told with the light that shows it most; the press stays as it is.
    """
    V, F = grid(dented(depth=0.004), 60)
    plain, own = press(V, F, limit=6e-4)
    positions, report = press(V, F, limit=6e-4, judges=walk())
    worse = report.healed.worse_for_judges
    there = F[np.linalg.norm(V[F].mean(1) - worse.place, axis=1) < 0.35 * report.length]
    assert np.array_equal(plain, positions) and own.healed.worse_for_judges.light == -1
    assert worse.after - worse.before >= report.healed.worse.after - report.healed.worse.before
    gains = [measure(positions, there, *pair) - measure(V, there, *pair) for pair in PAIRS]
    assert gains[worse.light] > 0.9 * max(gains) > 0.5
    assert press(V, F, limit=0.1, judges=walk())[1].healed.worse_for_judges.light == -1


def test_what_a_change_made_worse_is_found_and_what_it_healed_is_not():
    V, F = grid(clean, 60)
    bent = V.copy()
    bent[:, 2] -= 0.001 * np.exp(-((V[:, 0] - 0.3)**2 + V[:, 1]**2) / 0.1**2)
    judged = {"view_direction": VIEW, "lights": walk(), "length": 0.2}
    worse = reflines.judge_change(V, bent, F, **judged)
    there = F[np.linalg.norm(V[F].mean(1) - worse.place, axis=1) < 0.07]
    assert np.linalg.norm(worse.place[:2] - (0.3, 0.0)) < 0.1 and worse.before < 0.01
    assert 0.6 < worse.after / measure(bent, there, *PAIRS[worse.light]) < 1.1
    assert reflines.judge_change(bent, V, F, **judged).light == -1
    behind = reflines.LightSet([LIGHT], [-VIEW])
    assert reflines.judge_change(V, bent, F, **{**judged, "lights": behind}).light == -1


def test_what_of_the_panel_lies_far_from_a_change_hides_it():
    """A plate of the panel's own hides the dent from an eye aside, beyond the part that is looked at."""
    V, F = grid(clean, 60)
    bent = V.copy()
    bent[:, 2] -= 0.003 * np.exp(-((V[:, 0] + 0.5)**2 + V[:, 1]**2) / 0.1**2)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * 0.45
    plate = np.column_stack([corners + (0.5, 0.0), np.full(4, 1.0)])
    whole = np.concatenate([F, len(V) + np.array([[0, 1, 2], [0, 2, 3]])])
    aside = reflines.LightSet(LINES[[0, 4]], np.tile([1.0, 0.0, 1.0], (2, 1)))
    for faces, hidden in ((F, False), (whole, True)):
        worse = reflines.judge_change(*(np.concatenate([each, plate]) for each in (V, bent)), faces,
                                      view_direction=VIEW, lights=aside, length=0.2)
        assert (worse.light == -1) == hidden


def test_what_an_optimizer_solved_for_is_judged_as_its_positions_are():
    V, F = grid(clean, CELLS)
    optimizer = reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LIGHT)
    target = reflines.smooth(optimizer, length=0.3)
    target.gradient = target.gradient + np.where(np.linalg.norm(V[F].mean(1)[:, :2], axis=1) < 0.2, 1.0, 0.0)[:, None]
    optimizer.solve([target])
    found = reflines.judge_solve(optimizer, lights=walk(), length=0.2)
    same = reflines.judge_change(V, optimizer.positions, F, view_direction=VIEW, lights=walk(), length=0.2)
    assert found.light == same.light >= 0 and found.after == pytest.approx(same.after)


@pytest.mark.parametrize(("changed", "sentence"), [
    ({"length": 0.0}, "must be a positive length"), ({"lights": reflines.LightSet([LIGHT])}, "need eye directions"),
    ({"after": np.zeros((3, 3))}, "one for each vertex"), ({"lights": reflines.LightSet([VIEW], [VIEW])}, "parallel"),
])
def test_changes_that_cannot_be_judged_get_a_sentence(changed: dict, sentence: str):
    V, F = grid(clean, 20)
    asked = {"before": V, "after": V, "F": F, "view_direction": VIEW, "lights": walk(), "length": 0.2, **changed}
    with pytest.raises(reflines.InvalidInput, match=sentence):
        reflines.judge_change(**asked)


def test_judges_without_eyes_get_a_sentence():
    with pytest.raises(reflines.InvalidInput, match="Lights that judge a press need eye directions"):
        press(*grid(dented(), 20), judges=reflines.LightSet([LIGHT]))


def test_an_eye_that_sees_nothing_is_told_of_and_judges_nothing():
    V, F = grid(dented(), CELLS)
    positions, report = press(V, F, reflines.LightSet([LIGHT, LIGHT], [VIEW, -VIEW]))
    assert report.seen == [1.0, 0.0] and report.unevenness_before[1] == report.unevenness_after[1] == 0
    assert [note.count for note in report.region.notes if note.kind == "unseen"] == [1]
    assert np.array_equal(positions, press(V, F, lights="single")[0])


def test_the_border_that_is_faired_and_the_one_that_follows_take_the_set():
    V, F = grid(dented(count=3), CELLS)
    inner = (np.abs(V[:, :2]) < 0.7).all(1)
    region = inner[F].all(1)
    numbers = np.full(len(V), -1)
    own = np.unique(F[region])
    numbers[own] = np.arange(len(own))
    others = np.setdiff1d(np.arange(len(V)), own)
    numbers[others] = len(own) + np.arange(len(others))
    around = V[others], numbers[F[~region]]
    for options in ({"fair_border": np.ones(len(own), bool)}, {"border": "follow"}, {"border": "curvature"}):
        _, report = press(V[own], numbers[F[region]], walk(), around=around, **options)
        assert report.applied and report.healed.worst_after < 0.5 * report.healed.worst_before
        assert len(report.seen) == len(PAIRS)


@pytest.mark.parametrize(("light_set", "sentence"), [
    (lambda: reflines.LightSet([LIGHT, VIEW], [VIEW, VIEW]), "Light lines 1 are parallel to eye direction 1"),
    (lambda: walk(weight=[1.0]), "has 1 weights for 10 lights"),
    (lambda: walk(weight=[-1.0] * 10), "negative or not a finite number"),
    (lambda: walk(weight=[0.0] * 10), "All lights of the set have weight 0"),
    (lambda: walk(blockers=(np.zeros((3, 3)), [[0, 1, 7]])), "7"),
    (lambda: reflines.LightSet([LIGHT], [-VIEW]), "No eye direction sees the region"),
    (lambda: reflines.LightSet([LIGHT[:2]]), "three numbers"),
])
def test_bad_sets_get_a_sentence(light_set: object, sentence: str):
    with pytest.raises(reflines.InvalidInput, match=sentence):
        press(*grid(dented(), 20), light_set())
