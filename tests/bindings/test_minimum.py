"""What is found does not depend on how: one minimum for every strategy; values of theta alone (eq. 3) find it too."""

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, inside, panel, rippled
from sample_panels import optimizer as made

STRATEGIES = ("adaptive", "linearized", "gauss_newton", "newton")


def test_every_strategy_ends_in_the_same_minimum():
    """The wish has curl and cannot be met, so that the energy left is a number of its own and no rounding."""
    clean, triangles = panel(20)
    start = rippled(clean, amplitude=1e-3, wavelength=0.3)
    energies, heights = [], []
    for strategy in STRATEGIES:
        solver = made(start, triangles)
        report = solver.solve(reflines.smooth(solver, length=0.4), strategy=strategy, gradient_tolerance=1e-9,
                              max_iterations=2000)
        assert report.strategy == strategy and report.converged, report.message
        assert 1e-3 < report.energy_after / report.energy_before < 0.5
        energies.append(report.energy_after)
        heights.append(solver.heights)
    move = np.abs(heights[0] - made(start, triangles).heights).max()
    assert np.ptp(energies) < 1e-9 * energies[0]
    assert np.ptp(heights, axis=0).max() < 1e-6 * move


def test_values_of_theta_and_a_held_border_find_a_known_surface():
    clean, triangles = panel(24)
    wanted = made(clean, triangles)
    start = clean + 0.02 * inside(clean, margin=0.4)[:, None] * VIEW
    solver = made(start, triangles, border="fixed")
    before = np.abs(solver.heights - wanted.heights).max()
    target = reflines.Target(np.zeros((0, 2)), theta=wanted.theta())
    report = solver.solve(target, gradient_tolerance=1e-10)
    assert report.converged, report.message
    assert report.energy_after < 1e-12 * report.energy_before
    assert np.abs(solver.heights - wanted.heights).max() < 1e-6 * before


def test_values_beside_gradients_that_are_no_numbers_are_refused():
    solver = made(*panel(12))
    before, gradient = solver.heights, solver.field()
    gradient[[3, 5], 1] = np.nan
    with pytest.raises(reflines.InvalidInput, match="gradient of the target for theta is not finite in 2 of its 288"):
        solver.solve(reflines.Target(gradient, theta=solver.theta() + 0.1))
    assert np.array_equal(solver.heights, before)
    assert solver.solve(reflines.Target(np.zeros((0, 2)), theta=solver.theta())).converged


def test_a_pole_of_many_spokes_finds_a_known_surface():
    """Of its spokes each of the pole's triangles reads a few, spread around it."""
    spokes, rings = 512, 6
    angle, ring = np.meshgrid(np.linspace(0, 2 * np.pi, spokes, endpoint=False), np.arange(1, rings + 1) / rings)
    x, y = (np.concatenate([[0.0], (ring * turn(angle)).ravel()]) for turn in (np.cos, np.sin))
    clean = np.stack([x, y, -0.2 * x**2 - 0.12 * y**2 + 0.03 * x**3], 1)
    i = np.arange(spokes)
    a, b = 1 + i, 1 + (i + 1) % spokes
    strips = [part + k * spokes for k in range(rings - 1)
              for part in (np.stack([a, a + spokes, b + spokes], 1), np.stack([a, b + spokes, b], 1))]
    triangles = np.concatenate([np.stack([0 * i, a, b], 1), *strips])
    dent = 1e-3 * np.exp(-((x - 0.1) ** 2 + y**2) / 0.03) * np.clip((0.8 - np.hypot(x, y)) * 5, 0, 1)
    solver = made(clean + dent[:, None] * VIEW, triangles)
    assert solver.solve(reflines.Target(made(clean, triangles).field())).converged
    assert np.abs(solver.positions - clean).max() < 0.01 * dent.max()


@pytest.mark.parametrize("border", ["free", "fixed"])
@pytest.mark.parametrize("among_gradients", [False, True])
def test_a_pattern_by_value_is_the_same_in_every_unit_of_length(border, among_gradients):
    """Beside the proximity, the family across the lines and targets that ask for gradients, values keep their say."""
    clean, triangles = panel(24)
    across = (np.arange(64) - 32.0) ** 2
    image = np.exp(-(across[:, None] + across) / 200.0)
    moves, steps = [], []
    for scale in (1e-3, 1.0, 1e3):
        solver = reflines.ShapeOptimizer(clean * scale, triangles, view_direction=VIEW, border=border,
                                         line_direction=[LINE, (0.0, 1.0, 0.1)])
        targets = [reflines.pattern(solver, image=image, width=scale, strength=0.1, by_value=True)]
        if among_gradients:
            targets.append(reflines.smooth(solver, length=0.3 * scale, family=1))
        report = solver.solve(targets)
        assert report.converged
        moves.append(report.largest_move / scale)
        steps.append((report.iterations, report.factorizations))
    assert moves[1] > 2e-3 and np.ptp(moves) < 1e-6 * moves[1]
    assert steps[0] == steps[1] == steps[2]
