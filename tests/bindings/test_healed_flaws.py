"""What a press says that it healed: degrees off the lines' course at the worst place, and the share of the panel."""
from functools import cache

import numpy as np
import pytest
import reflines
from dented_dome import CENTRES, LIGHT, RADIUS, VIEW, Height, clean, correlate_ranks, dented, grid


@cache
def press(height: Height, *mesh: int, turned: bool = False) -> reflines.SmoothPanelReport:
    return reflines.smooth_panel(*grid(height, *mesh, turned=turned), view_direction=VIEW, line_direction=LIGHT)[1]


def theta(height: Height, x: np.ndarray, y: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Equation 1 of the paper, with derivatives by central differences of the formula."""
    step = 1e-5
    slope = [(height(x + step, y) - height(x - step, y)) / (2.0 * step),
             (height(x, y + step) - height(x, y - step)) / (2.0 * step)]
    n = np.stack([-slope[0], -slope[1], np.ones_like(x)], axis=-1)
    r = 2.0 * n[..., 2:] * n / (n * n).sum(axis=-1, keepdims=True) - VIEW
    third = VIEW - (VIEW @ across) * across
    third /= np.linalg.norm(third)
    return np.arctan2(r @ np.cross(across, third), r @ third)


def worst_deviation(height: Height, length: float) -> float:
    """Degrees: root mean square over a disk of 0.35 lengths with weights 1 - (distance / radius)^2, the largest around
    the first dent, in the light in which it is largest.
    """
    reach = 0.35 * length
    u, v = (each.ravel() for each in np.meshgrid(*2 * [np.linspace(-reach, reach, 25)]))
    weight = np.maximum(1.0 - (u * u + v * v) / reach**2, 0.0)
    places = np.stack(np.meshgrid(*2 * [np.linspace(-1.5 * RADIUS, 1.5 * RADIUS, 31)]), axis=-1).reshape(-1, 2)
    x, y = places[:, :1] + u + CENTRES[0][0], places[:, 1:] + v + CENTRES[0][1]
    lights = (LIGHT, np.cross(VIEW, LIGHT))
    off = [np.degrees(theta(height, x, y, a / np.linalg.norm(a)) - theta(clean, x, y, a / np.linalg.norm(a)))
           for a in lights]
    return max(float(np.sqrt((each**2 @ weight / weight.sum()).max())) for each in off)


def test_the_worst_place_is_as_far_off_as_the_formulas_say() -> None:
    report = press(dented(), 120)
    assert report.healed.worst_before == pytest.approx(worst_deviation(dented(), report.length), rel=0.04)


@pytest.mark.parametrize(("mesh", "turned"), [
    ((40,), False), ((40,), True), ((120,), False), ((50, 100), False), ((50, 100), True)])
def test_it_is_a_number_of_the_surface(mesh, turned) -> None:
    """However it is sampled and cut."""
    told, wanted = press(dented(), *mesh, turned=turned).healed, press(dented()).healed
    assert told.worst_before == pytest.approx(wanted.worst_before, rel=0.08)
    assert told.mean_before == pytest.approx(wanted.mean_before, rel=0.05)
    assert told.area == pytest.approx(wanted.area, rel=0.05)
    assert told.worst_after < 0.05


def test_facets_of_a_clean_panel_are_no_flaws() -> None:
    for cells in (40, 60):
        told = press(clean, cells).healed
        assert told.worst_before < 0.05 and told.area == 0.0


def test_a_deeper_dent_has_larger_numbers_in_proportion() -> None:
    shapes = dented(5e-4), dented(1e-3), dented(), dented(4e-3)  # the third is 2e-3 deep
    told = [press(shape).healed for shape in shapes]
    assert [each.worst_before / told[2].worst_before for each in told] == pytest.approx([0.25, 0.5, 1.0, 2.0], rel=0.01)
    assert all(a.area < b.area and a.mean_before < b.mean_before for a, b in zip(told, told[1:], strict=False))


def test_more_dents_have_more_area_and_are_no_worse() -> None:
    told = [press(shape).healed for shape in (dented(), dented(count=2), dented(count=3))]
    assert [each.area / told[0].area for each in told] == pytest.approx([1.0, 2.0, 3.0], rel=0.05)
    assert [each.worst_before / told[0].worst_before for each in told] == pytest.approx([1.0, 1.0, 1.0], rel=0.02)


def test_what_strength_and_limit_leave_is_told() -> None:
    whole = press(dented()).healed
    smoother = reflines.PanelSmoother(*grid(dented()), view_direction=VIEW, line_direction=LIGHT)
    for strength in (0.0, 0.25, 0.5, 0.75):
        told = smoother.press(strength=strength)[1].healed
        assert told.worst_before == pytest.approx(whole.worst_before, rel=1e-9)
        assert told.worst_after == pytest.approx((1.0 - strength) * whole.worst_before, rel=0.03)
    limited = [smoother.press(limit=limit)[1].healed.worst_after for limit in (1e-4, 5e-4, 1e-3, 2e-3)]
    assert all(a > b for a, b in zip(limited, limited[1:], strict=False))


def test_results_are_ranked_as_by_their_true_distance_from_the_design() -> None:
    """Twelve of them, by the height and by the lines in either light."""
    assert min(correlate_ranks().values()) > 0.9
