"""Curves along which lines are laid: through their points, near a stroke, and parallel to edges."""
import sys

import numpy as np
import pytest

import scenes  # noqa: F401  (enables the add-on)


def curves() -> object:
    return sys.modules["reflection_lines"].model.line_curve


def test_a_curve_passes_through_its_points_and_a_straight_one_stays_straight() -> None:
    points = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [4.0, 4.0]])
    sampled = curves().sample_curve(points, 8)
    assert np.allclose(sampled[::8], points, atol=1e-12) and len(sampled) == 25
    straight = curves().sample_curve(np.linspace([0.0, 0.0, 1.0], [4.0, 2.0, 1.0], 5))
    assert np.allclose(straight, np.linspace([0.0, 0.0, 1.0], [4.0, 2.0, 1.0], len(straight)), atol=1e-12)


def test_a_shaky_stroke_is_smoothed_and_keeps_its_ends() -> None:
    x = np.linspace(0.0, 1.0, 80)
    clean = np.column_stack([x, 0.2 * np.sin(3.0 * x)])
    shaky = clean + 0.01 * np.column_stack([np.zeros(80), np.cos(200.0 * x)])
    points = curves().fit_curve(shaky)
    off = curves().sample_curve(points, 20)
    near = np.interp(off[:, 0], clean[:, 0], clean[:, 1])
    assert np.abs(off[5:-5, 1] - near[5:-5]).max() < 0.01
    assert np.array_equal(points[[0, -1]], shaky[[0, -1]])


def test_the_chain_beside_a_line_is_chosen() -> None:
    corners = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]])
    ring = np.concatenate([np.linspace(a, b, 5)[:-1] for a, b in zip(corners, np.roll(corners, -1, 0), strict=True)])
    edges = np.stack([ring, np.roll(ring, -1, 0)], axis=1)
    chosen = curves().choose_loop(edges, np.array([1.0, 2.4]), np.array([1.0, 0.2]))
    assert len(chosen) == 4 and (chosen[..., 1] == 3.0).all()
    assert not len(curves().choose_loop(edges[:4], np.array([1.0, 2.4]), np.array([0.0, 1.0])))


@pytest.mark.parametrize("height", (0.3, -0.2))
def test_a_line_runs_parallel_to_a_bent_edge(height: float) -> None:
    turn = np.linspace(0.2, 2.9, 60)
    loop = np.column_stack([np.cos(turn), np.sin(turn)])
    line = loop[5:-5] * (1.0 + height + 0.03 * np.sin(9.0 * turn[5:-5, None]))
    edges = np.stack([loop[:-1], loop[1:]], axis=1)
    moved = curves().run_parallel(line, edges, line[20])
    wanted = np.linalg.norm(line[20]) - 1.0
    assert np.abs(np.linalg.norm(moved, axis=1) - 1.0 - wanted).max() < 2e-3


@pytest.mark.parametrize("held", ([0, 1, 40], [0], []))
def test_a_moved_line_leaves_its_held_ends_gradually(held: list[int]) -> None:
    line = np.column_stack([np.linspace(0.0, 1.0, 41), np.zeros(41)])
    movable = ~np.isin(np.arange(41), held)
    kept = curves().keep_ends(line, line + [0.0, 0.3], movable, 0.2)[:, 1] / 0.3
    assert not kept[~movable].any()
    ends = (0.05 if 1 in held else 0.025 if 0 in held else -1.0), (0.975 if 40 in held else 2.0)
    inside = (line[:, 0] > ends[0] + 0.2) & (line[:, 0] < ends[1] - 0.2)
    assert (np.abs(kept[inside] - 1.0) < 1e-12).all() and inside.any()
    assert np.abs(np.diff(kept)).max() < 0.2 and (kept == 1.0).all() == (not held)


def test_a_line_that_is_held_all_along_stays() -> None:
    line = np.column_stack([np.linspace(0.0, 1.0, 9), np.zeros(9)])
    assert np.array_equal(curves().keep_ends(line, line + 0.3, np.zeros(9, dtype=bool), 0.2), line)
