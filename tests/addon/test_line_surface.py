"""Lines traced on a region: from border to border at one value, through places that are found again."""
import sys

import numpy as np
import pytest

line_surface = sys.modules["reflection_lines.model.line_surface"]
CELLS = 20


@pytest.fixture
def surface() -> object:
    """A square of side 1 whose theta is 3 x + y: the value 2 runs from one border to another."""
    x, y = (each.ravel() for each in np.meshgrid(np.linspace(0.0, 1.0, CELLS + 1), np.linspace(0.0, 1.0, CELLS + 1)))
    first = (np.arange(CELLS)[:, None] * (CELLS + 1) + np.arange(CELLS)).ravel()
    F = np.concatenate([np.column_stack([first, first + 1, first + CELLS + 2]),
                        np.column_stack([first, first + CELLS + 2, first + CELLS + 1])])
    theta = 3.0 * x + y
    state = line_surface.LineState(np.column_stack([x, y, 0.1 * x]), theta)
    return line_surface.LineSurface(state, F, np.eye(3))


def test_a_line_is_traced_from_border_to_border(surface) -> None:
    place = surface.find_place(np.array([0.5, 0.5, 7.0]))
    line = surface.trace(place, surface.start, surface.read_theta(place, surface.start))
    assert np.allclose(3.0 * line[:, 0] + line[:, 1], 2.0) and np.allclose(line[:, 2], 0.1 * line[:, 0])
    assert abs(np.ptp(line[:, 1]) - 1.0) < 1e-9  # from the lower border to the upper one
    assert (np.diff(line[:, 1]) > -1e-12).all() or (np.diff(line[:, 1]) < 1e-12).all()


def test_a_line_is_traced_where_theta_jumps_by_a_full_turn(surface) -> None:
    turned = line_surface.LineState(surface.start.V, line_surface.wrap(surface.start.theta + 1.0))
    place = surface.find_place(np.array([0.7, 0.04, 0.0]))
    value = surface.read_theta(place, turned)
    line = surface.trace(place, turned, value)
    assert len(line) > CELLS and np.allclose(line_surface.wrap(3.0 * line[:, 0] + line[:, 1] + 1.0 - value), 0.0)


def test_the_source_of_a_moved_line_is_found(surface) -> None:
    moved = line_surface.LineState(surface.start.V, surface.start.theta + 0.3)
    place = surface.find_place(np.array([0.5, 0.5, 0.0]))
    source = surface.read_point(surface.find_source(place, moved), surface.start)
    assert abs(3.0 * source[0] + source[1] - 2.3) < 1e-8
    assert np.linalg.norm(source[:2] - 0.5) < 0.1  # straight across the lines
    beyond = line_surface.LineState(surface.start.V, surface.start.theta + 3.0)
    assert surface.find_source(place, beyond) is place  # there is none in the region


def test_places_beside_the_region_are_none(surface) -> None:
    assert surface.find_place(np.array([1.2, 0.5, 0.0])) is None
