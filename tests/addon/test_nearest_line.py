"""The line that a stroke of Draw Highlight takes where it takes the nearest one."""
import sys

import numpy as np
import pytest


def compute(theta: list[float], along: list[float]) -> float:
    """The value for a stroke along a straight way."""
    line_surface = sys.modules["reflection_lines.model.line_surface"]
    return line_surface.compute_mean_theta(np.array(theta), np.outer(along, [0.6, 0.0, 0.8]))


def test_it_has_the_mean_over_the_length_however_the_points_lie() -> None:
    even = np.linspace(0.0, 1.0, 101)
    crowded = np.sort(np.concatenate([even, np.linspace(0.0, 0.1, 400)]))
    for along in (even, crowded):
        assert compute(0.2 + 0.3 * along, along) == pytest.approx(0.35, abs=1e-6)


def test_of_all_values_it_is_the_least_changed() -> None:
    rng = np.random.default_rng(1)
    along = np.linspace(0.0, 1.0, 400)
    theta = 0.4 + 0.2 * np.cumsum(rng.normal(size=400)) / 20.0
    best = compute(theta, along)
    for other in (best - 0.01, best + 0.01):
        assert np.mean((theta - best)**2) < np.mean((theta - other)**2)


def test_lines_across_the_turn_are_taken_as_one_way() -> None:
    along = np.linspace(0.0, 1.0, 21)
    theta = np.pi - 0.1 + 0.3 * along
    wrapped = (theta + np.pi) % (2.0 * np.pi) - np.pi
    assert wrapped[0] > 3.0 and wrapped[-1] < -2.8
    assert compute(wrapped, along) == pytest.approx(np.pi + 0.05)
