"""Tools on designed panels: rims keep their lines and own nothing else, and lines that cross the wanted ones stay."""

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, panel, rms

CROSSED = np.cross(VIEW, LINE)


def hemmed(cells=48):
    """A quiet panel whose last twelfth bends down as a hem does: (#V x 3, #F x 3)."""
    positions, triangles = panel(cells)
    over = np.maximum(positions[:, 0] - positions[:, 0].max() + np.ptp(positions[:, 0]) / 12, 0.0)
    return positions - np.outer(12.0 * over**2, VIEW), triangles


def optimizer(border="clamped"):
    positions, triangles = hemmed()
    return reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW, line_direction=np.array([LINE, CROSSED]),
                                   border=border)


def find_hem(solver):
    """Triangles of the hem, and those of the quiet rest, by the sizes of their gradients: #F each."""
    bend = np.linalg.norm(solver.field(), axis=1)
    order = np.argsort(bend)
    half = np.searchsorted(np.cumsum(solver.area[order]), 0.5 * solver.area.sum())
    strong = max(8.0 * bend[order[half]], 10.0 / np.linalg.norm(np.ptp(solver.centers, axis=0)))
    return bend > 1.34 * strong, bend < 0.33 * strong


@pytest.fixture
def solver():
    return optimizer()


def test_the_region_s_own_direction_and_density_are_the_geometric_median(solver):
    """Its first-order condition: the unit vectors from it to the gradients cancel."""
    field, wanted = solver.field(), reflines.uniform(solver).gradient
    median = wanted[np.linalg.norm(field, axis=1).argmin()]
    away = field - median
    cancel = solver.area @ (away / np.linalg.norm(away, axis=1)[:, None])
    assert np.linalg.norm(cancel) < 1e-6 * solver.area.sum()
    mean = solver.area @ field / solver.area.sum()
    assert np.linalg.norm(mean - median) > 0.5 * np.linalg.norm(median)  # here the hem would have owned a mean


@pytest.mark.parametrize("build", [
    lambda o: reflines.uniform(o, density=1.5), lambda o: reflines.turn(o, angle=0.5),
    lambda o: reflines.pattern(o, image=np.random.default_rng(0).random((20, 20)), width=2.0)])
def test_tools_act_in_full_on_the_panel_and_not_at_all_on_its_hem(solver, build):
    field, target = solver.field(), build(solver)
    hem, quiet = find_hem(solver)
    assert 0.03 < solver.area[hem].sum() / solver.area.sum() < 0.2 and quiet.sum() > 0.7 * len(quiet)
    assert np.array_equal(target.gradient[hem], field[hem])
    assert (np.linalg.norm(target.gradient - field, axis=1)[quiet] > 1e-3 * rms(field[quiet])).mean() > 0.98


def test_a_hem_does_not_own_the_panel():
    """With its lines flattened like all others, it takes what was wanted of the panel and moves it far."""
    solver = optimizer("free")
    field, wanted = solver.field(), reflines.uniform(solver)
    _, quiet = find_hem(solver)
    line = wanted.gradient[np.linalg.norm(field, axis=1).argmin()]
    results = []
    for target in (wanted, reflines.Target(np.tile(line, (len(field), 1)), reachable_only=True)):
        solver.reset()
        assert solver.solve(target).converged
        moved = np.linalg.norm(solver.positions - hemmed()[0], axis=1).max()
        results.append((rms((solver.field() - line)[quiet]) / rms((field - line)[quiet]), moved))
    (left, moved), (left_flat, moved_flat) = results
    assert left < 0.7
    assert left_flat > 1.3 * left and moved_flat > 2.0 * moved


def test_lines_are_kept_bit_for_bit_where_nothing_else_is_wanted(solver):
    assert np.array_equal(reflines.keep(solver, family=1).gradient, solver.field(1))
    report = solver.solve([reflines.Target(solver.field()), reflines.keep(solver, family=1)])
    assert report.termination == "already_optimal"


def test_crossing_lines_are_kept_as_far_as_the_wanted_ones_allow(solver):
    crossed, kept = solver.field(1), reflines.keep(solver, family=1)
    influence = reflines.falloff(solver, centre=solver.centers.mean(0), radius=0.3, curve=np.array([1.0, 0.5, 0.0]))
    wanted = reflines.uniform(solver, density=1.5, influence=influence)
    asked, results = rms(wanted.gradient - solver.field()), []
    for targets in ([wanted], [wanted, kept]):
        solver.reset()
        assert solver.solve(targets).converged
        results.append((rms(solver.field() - wanted.gradient) / asked, rms(solver.field(1) - crossed)))
    (alone, lost), (together, less_lost) = results
    assert less_lost < 0.95 * lost
    assert together < alone + 0.02


def test_a_flat_panel_has_no_direction_of_its_own():
    positions, triangles = panel(12)
    flat = positions * [1.0, 1.0, 0.0]
    solver = reflines.ShapeOptimizer(flat, triangles, view_direction=(0, 0, 1), line_direction=(0, 1, 0))
    with pytest.raises(reflines.InvalidInput, match="no median direction"):
        reflines.uniform(solver)
    assert np.isfinite(reflines.uniform(solver, direction=(1, 0), density=1.0, relative=False).gradient).all()
