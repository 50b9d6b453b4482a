"""The score of lines: two numbers that can be checked on a picture, and that never fall where a flaw gets deeper."""
from collections.abc import Callable

import numpy as np
import pytest
import reflines
from sample_panels import grid

VIEW, LINE = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
DEPTHS = (1e-5, 3e-4, 1e-3, 2e-3, 3e-3, 5e-3, 1e-2)
CELLS = 100
BEND, TWIST, WAVE = 0.15, 2e-3, 0.2  # z = -BEND y^2 + TWIST y sin(2 pi x / WAVE)


def score(height: Callable[[np.ndarray, np.ndarray], np.ndarray], length: float) -> reflines.LineScore:
    plane, F = grid(CELLS)
    x, y = plane.T - 0.5
    V = np.column_stack([x, y, height(x, y)])
    return reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LINE, crease_rule="none").score(length)


def dent(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.exp(-((x - 0.1)**2 + (y + 0.05)**2) / 0.006)


def ripple(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return 0.1 * np.sin(2 * np.pi * x / 0.12) * np.sin(2 * np.pi * y / 0.12)


def groove(x: np.ndarray, y: np.ndarray, slant: float = 0.0) -> np.ndarray:
    along, across = np.cos(slant) * x + np.sin(slant) * y, np.cos(slant) * y - np.sin(slant) * x
    return np.exp(-across**2 / (2 * 0.014**2)) / (1 + np.exp((abs(along) - 0.3) / 0.01))


def slanted_groove(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return groove(x, y, 0.5)


@pytest.mark.parametrize("length", [0.1, 0.25])
@pytest.mark.parametrize("flaw", [dent, ripple, groove, slanted_groove])
def test_a_deeper_flaw_shifts_the_lines_more(flaw, length) -> None:
    """The score before left strong bends out: of a groove 2, 3 and 5 mm deep it had 14.4, 12.3 and 9.6 degrees."""
    shifts = [score(lambda x, y, depth=depth: -0.15 * x**2 - 0.1 * y**2 - depth * flaw(x, y), length).shift
              for depth in DEPTHS]
    assert np.diff(shifts).min() > 0, shifts


@pytest.mark.parametrize("cells", [40, 80, 160])
def test_the_facets_of_a_mesh_are_no_flaws(cells) -> None:
    """Waves far longer than the length are no flaws at it, on any mesh: 0.34, 0.18 and 0.09 degrees were facets."""
    plane, F = grid(cells)
    x, y = plane.T - 0.5
    z = -0.15 * x**2 - 0.1 * y**2 + 0.001 * np.sin(12 * x) * np.sin(10 * y)
    solver = reflines.ShapeOptimizer(np.column_stack([x, y, z]), F, view_direction=VIEW, line_direction=LINE)
    assert solver.score(0.15).shift < 0.05


def twisted(x: np.ndarray, y: np.ndarray, bend: float = BEND) -> np.ndarray:
    """A cylinder whose lines are waves: theta is about -2 z_y = 4 BEND y - 2 TWIST sin(2 pi x / WAVE)."""
    return -bend * y**2 + TWIST * y * np.sin(2 * np.pi * x / WAVE)


@pytest.mark.parametrize("bend", [0.1, 0.2, 0.4])
def test_the_turn_is_that_of_a_protractor(bend) -> None:
    """The lines are y = TWIST / (2 bend) sin(2 pi x / WAVE): their angles to the straight course are known."""
    phase = np.linspace(0, 2 * np.pi, 1000, endpoint=False)
    drawn = np.degrees(np.arctan(TWIST / (2 * bend) * 2 * np.pi / WAVE * abs(np.cos(phase)))).mean()
    assert score(lambda x, y: twisted(x, y, bend), 0.8).turn == pytest.approx(drawn, rel=0.05)


@pytest.mark.parametrize("length", [0.8, 1.6])
def test_the_shift_is_the_change_of_theta_within_a_length(length) -> None:
    """|grad theta| strays by 2 TWIST 2 pi / WAVE |cos|, whose mean is 2 / pi of its most, whatever is below."""
    strays = 2 * TWIST * 2 * np.pi / WAVE * 2 / np.pi
    assert score(twisted, length).shift == pytest.approx(np.degrees(strays) * length, rel=0.05)


def test_clean_lines_score_nothing() -> None:
    clean = score(lambda x, y: -0.15 * x**2 - 0.1 * y**2, 0.1)
    assert clean.shift < 0.01 and clean.turn < 0.01


@pytest.mark.parametrize("length", [0.0, -1.0, np.nan, np.inf])
def test_a_length_that_is_none_is_refused(length) -> None:
    with pytest.raises(reflines.InvalidInput, match="positive length"):
        score(dent, length)


def stage_of_score(solver: reflines.ShapeOptimizer, length: float, family: int) -> str:
    """The last stage that a score reports; none where it only solves."""
    progress = reflines.Progress()
    solver.watch(progress)
    solver.score(length, family)
    return progress.stage


def test_smoothing_and_score_factor_one_system_for_both_lights() -> None:
    """Where no feature is kept they are the same matrix; it is that of one length, and not of lines kept sharp."""
    plane, F = grid(24)
    x, y = plane.T - 0.5
    smooth, sharp = (reflines.ShapeOptimizer(np.column_stack([x, y, -0.15 * x**2 - 0.1 * y**2 + step]), F,
                                             view_direction=VIEW, line_direction=[LINE, (0.0, 1.0, 0.0)],
                                             crease_rule="none")
                     for step in (np.zeros_like(x), 0.05 * np.tanh(y / 0.05)))
    for solver in (smooth, sharp):
        assert stage_of_score(solver, 0.2, 0) == "smoothing"
        assert stage_of_score(solver, 0.2, 1) == ""
        assert stage_of_score(solver, 0.3, 1) == "smoothing"
        reflines.smooth(solver, length=0.4)
    assert stage_of_score(smooth, 0.4, 0) == stage_of_score(smooth, 0.4, 1) == ""
    assert sharp.region.features > 0 and stage_of_score(sharp, 0.4, 0) == "smoothing"
