"""A solve within a limit of the move: exact to the bit, a constrained minimum, refused where it is none."""
import time
from types import ModuleType

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, panel, rippled

SMOOTH = 0.3


def ripples(cells=24, amplitude=3e-3, wavelength=0.3):
    positions, triangles = panel(cells)
    return rippled(positions, amplitude=amplitude, wavelength=wavelength), triangles


def made(positions, triangles, view=VIEW, **options):
    return reflines.ShapeOptimizer(positions, triangles, view_direction=view, line_direction=LINE, **options)


def moves(solver, positions):
    return (solver.positions - positions) @ (VIEW / np.linalg.norm(VIEW))


def solved(limit, *, cells=24, amplitude=3e-3, **options):
    positions, triangles = ripples(cells, amplitude)
    solver = made(positions, triangles)
    target = reflines.smooth(solver, length=SMOOTH)
    return solver, positions, target, solver.solve(target, limit=limit, **options)


def largest_free_move(**options):
    return solved(None, **options)[3].largest_move


@pytest.mark.parametrize("share", [0.02, 0.3, 0.9])
@pytest.mark.parametrize("view", [VIEW, (0, 0, 1), (0.6, -0.2, 1.7)])
def test_no_vertex_is_beyond_the_limit_by_a_bit(share, view):
    positions, triangles = ripples()
    solver = made(positions + [3, 5, 7], triangles, view)
    target = reflines.smooth(solver, length=SMOOTH)
    limit = share * solver.solve(target).largest_move
    solver.reset()
    heights = solver.heights
    report = solver.solve(target, limit=limit)
    assert report.converged and report.limited > 0
    along = np.asarray(view) / np.linalg.norm(view)
    way = solver.positions - (positions + [3, 5, 7])
    assert np.abs(way @ along).max() <= limit and np.linalg.norm(way, axis=1).max() <= limit
    assert np.abs(solver.heights - heights).max() <= limit
    assert report.largest_move == limit
    touching = solver.at_limit != 0
    assert touching.sum() == report.limited
    assert np.allclose(np.abs(way @ along)[touching], limit, rtol=0, atol=1e-14)


def test_a_limit_that_nothing_touches_changes_no_bit():
    free, _, _, report = solved(None)
    limited, _, _, same = solved(1.001 * report.largest_move)
    infinite, _, _, _ = solved(np.inf)
    assert np.array_equal(free.positions, limited.positions) and np.array_equal(free.positions, infinite.positions)
    assert same.limited == 0 and not limited.at_limit.any()


def energy_of(solver, positions, triangles, target):
    """The energy as a function of the moves of the free vertices."""
    free = solver.free

    def energy(x):
        moved = positions.copy()
        moved[free] += np.outer(x, VIEW)
        return made(moved, triangles).energy(target)

    return energy


def test_the_projected_gradient_is_that_of_a_minimum():
    solver, positions, target, report = solved(2e-4, cells=10)
    assert report.gradient_after <= 1e-6 * report.gradient_before
    x = moves(solver, positions)[solver.free]
    held = solver.at_limit[solver.free]
    energy, step = energy_of(solver, positions, ripples(10)[1], target), 1e-7
    assert energy(x) == pytest.approx(report.energy_after)
    slopes = np.array([(energy(x + step * e) - energy(x - step * e)) / (2 * step) for e in np.eye(len(x))])
    first = np.array([(energy(step * e) - energy(-step * e)) / (2 * step) for e in np.eye(len(x))])
    small = 1e-5 * np.linalg.norm(first)  # differences of energies have seven digits
    assert np.abs(slopes[held == 0]).max() < small
    assert (slopes[held > 0] < small).all() and (slopes[held < 0] > -small).all()
    assert (held > 0).sum() > 3 and (held < 0).sum() > 3


def referee_library() -> ModuleType:
    """Returns scipy.optimize, which roots of the matrix do not have: they test the package, not the mathematics."""
    return pytest.importorskip("scipy.optimize", reason="scipy is where the project is built, not where it is used")


def test_nearly_flat_it_is_bounded_linear_least_squares():
    """Heights small enough make the energy quadratic: the Jacobian of its residuals and scipy's solver say the same."""
    positions, triangles = panel(10)
    positions[:, 2] = 1e-7 * np.random.default_rng(4).normal(size=len(positions))
    solver = made(positions, triangles, (0, 0, 1))
    free = solver.free
    target = reflines.Target(np.zeros((len(triangles), 2)))
    shares = np.array([solver.energy(reflines.Target(target.gradient, each)) for each in np.eye(len(triangles))])
    weight = np.sqrt(shares / (solver.field()**2).sum(1))[:, None]
    field, columns = (weight * solver.field()).ravel(), []
    for v in np.flatnonzero(free):
        moved = positions.copy()
        moved[v, 2] += 1e-8
        columns.append(((weight * made(moved, triangles, (0, 0, 1)).field()).ravel() - field) / 1e-8)
    limit = 8e-8
    report = solver.solve(target, limit=limit, gradient_tolerance=1e-10)
    referee = referee_library().lsq_linear(
        np.stack(columns, 1), -field / limit, bounds=(-1, 1), tol=1e-14, method="bvls")
    assert report.converged and 0.1 < report.limited_fraction < 0.9
    assert np.abs(moves_z(solver, positions)[free] / limit - referee.x).max() < 1e-6


def moves_z(solver, positions):
    return solver.positions[:, 2] - positions[:, 2]


def test_only_outward_lies_on_the_obstacle_where_it_would_go_inward():
    positions, triangles = ripples()
    solver = made(positions, triangles)
    target = reflines.smooth(solver, length=SMOOTH)
    n = len(positions)
    report = solver.solve(target, limit=np.column_stack([np.zeros(n), np.full(n, np.inf)]))
    assert report.converged, report.message
    move = moves(solver, positions)
    assert move.min() >= 0 and move.max() > 1e-4
    held = (solver.at_limit < 0) & solver.free
    assert held.sum() > 10 and np.array_equal(solver.positions[held], positions[held])


def test_a_painted_limit():
    positions, triangles = ripples()
    solver = made(positions, triangles)
    target = reflines.smooth(solver, length=SMOOTH)
    painted = 1e-3 * np.clip(positions[:, 0] / 0.7, 0, 1)
    report = solver.solve(target, limit=np.column_stack([-painted, painted]))
    assert report.converged, report.message
    move = moves(solver, positions)
    assert (np.abs(move) <= painted).all() and np.abs(move).max() > 1e-4
    still = painted == 0
    assert np.array_equal(solver.positions[still], positions[still])


def test_several_families():
    positions, triangles = ripples()
    solver = reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW,
                                     line_direction=np.array([LINE, np.cross(VIEW, LINE)]))
    targets = [reflines.smooth(solver, length=SMOOTH, family=k) for k in (0, 1)]
    report = solver.solve(targets, limit=5e-4)
    assert report.converged and report.limited > 10
    assert np.abs(moves(solver, positions)).max() <= 5e-4


def test_a_result_beyond_the_limit_is_put_back_first():
    solver, positions, target, _ = solved(None)
    report = solver.solve(target, limit=3e-4)
    assert report.converged, report.message
    assert report.put_back > 10 and "put back" in report.message
    assert np.abs(moves(solver, positions)).max() <= 3e-4
    afresh = solved(3e-4)[0]
    assert np.abs(solver.positions - afresh.positions).max() < 1e-2 * 3e-4


def test_a_limit_of_nothing():
    positions, triangles = ripples()
    solver = made(positions, triangles)
    report = solver.solve(reflines.smooth(solver, length=SMOOTH), limit=0.0)
    assert report.termination == "already_optimal" and "Nothing may move" in report.message
    assert np.array_equal(solver.positions, positions)


@pytest.mark.parametrize("limit, count", [(-1e-3, 625), (np.nan, 625), ("crossed", 2), ("one", 625), ("short", 625)])
def test_no_limits(limit, count):
    positions, triangles = ripples()
    solver = made(positions, triangles)
    if limit == "crossed":
        limit = np.tile([-1.0, 1.0], (625, 1))
        limit[7:9] = [1, -1]
    elif limit == "one":
        limit = np.tile([0.1, 1.0], (625, 1))
    elif limit == "short":
        limit = np.zeros((3, 2))
    with pytest.raises(reflines.InvalidInput, match=rf"\b{count} .*vertices"):
        solver.solve(reflines.smooth(solver, length=SMOOTH), limit=limit)
    assert np.array_equal(solver.positions, positions)


def test_cancelled_everything_is_as_it_was():
    solver, positions, target, _ = solved(2e-4)
    before, limit = solver.positions, solver.at_limit
    progress = reflines.Progress()
    progress.cancel()
    assert solver.solve(target, limit=1e-4, progress=progress).termination == "cancelled"
    assert np.array_equal(solver.positions, before) and np.array_equal(solver.at_limit, limit)
    again = solved(2e-4)[0].solve(target, limit=1e-4)
    report = solver.solve(target, limit=1e-4)
    assert report.energy_after == again.energy_after


def test_a_solve_that_ends_at_its_limit_at_once_can_be_followed_by_another():
    """One free vertex: the start on the way to the free minimum is the result, and no model was made."""
    positions, triangles = panel(2)
    options = {"view": (0, 0, 1), "border": "fixed", "crease_rule": "none"}
    positions[4, 2] += 0.05
    free = made(positions, triangles, **options)
    target = reflines.Target(np.zeros((len(triangles), 2)))
    largest = free.solve(target).largest_move
    solver = made(positions, triangles, **options)
    for share in (0.3, 0.3, 0.2, 0.5):
        solver.solve(target, limit=share * largest)
        assert np.abs(solver.positions - positions).max() == share * largest


def test_a_cancelled_limited_solve_can_be_followed_by_another():
    limit = 0.3 * largest_free_move()
    expected = solved(limit)[0].positions
    stages = set()
    for wanted in range(1, 12):
        positions, triangles = ripples()
        solver = made(positions, triangles)
        target, progress = reflines.smooth(solver, length=SMOOTH), reflines.Progress()
        task = reflines.start(solver.solve, target, limit=limit, progress=progress)
        time.sleep(1e-3 * wanted)
        progress.cancel()
        stages.add((task.result().termination, progress.stage))
        assert solver.solve(target, limit=limit).converged
        assert np.abs(solver.positions - expected).max() < 1e-4 * limit
    print(stages)


@pytest.mark.parametrize("share", [0.3, 0.1, 0.03, 0.01])
def test_rounds_that_change_few_of_many_contacts_take_no_factorization(share):
    """A factorization for each round made these 11, 14, 10 and 11; without relaxation the first takes 4."""
    positions, triangles = ripples(60, amplitude=1e-3)
    positions[:, 2] += np.random.default_rng(1).normal(0, 1e-4, len(positions))
    largest = made(positions, triangles).solve(reflines.smooth(made(positions, triangles), length=0.5)).largest_move
    solver = made(positions, triangles)
    report = solver.solve(reflines.smooth(solver, length=0.5), limit=share * largest)
    assert report.converged and report.limited_fraction > 0.05
    assert report.factorizations <= 3


@pytest.mark.parametrize(("noise", "angle"), [(1e-5, 0.02), (1e-5, 0.2), (1e-4, 0.1)])
def test_active_sets_that_follow_each_other_in_a_ring_are_left(noise, angle):
    """Without, these went on to the last round of each step, and ended unconverged after 265, 5246 and 381 solves."""
    positions, triangles = ripples(amplitude=1e-2)
    positions[:, 2] += np.random.default_rng(1).normal(0, noise, len(positions))
    target = reflines.turn(made(positions, triangles, border="free"), angle=angle)
    largest = made(positions, triangles, border="free").solve(target).largest_move
    report = made(positions, triangles, border="free").solve(target, limit=0.01 * largest)
    assert report.converged, report.message
    assert report.factorizations <= 15


def test_few_contacts_take_no_factorization_of_their_own():
    """Eliminated, the contacts of these took 9 and 8 factorizations, and at last an estimate from inside."""
    positions, triangles = panel(24)
    positions[:, 2] += np.random.default_rng(1).normal(0, 3e-4, len(positions))
    largest = made(positions, triangles, border="free").solve(turned(positions, triangles)).largest_move
    for share in (0.15, 0.17):
        report = made(positions, triangles, border="free").solve(turned(positions, triangles), limit=share * largest)
        assert report.converged, report.message
        assert report.factorizations <= 3


def turned(positions, triangles):
    return reflines.turn(made(positions, triangles, border="free"), angle=0.1)


def test_a_drag_of_the_target_makes_few_factors():
    positions, triangles = ripples(40)
    solver = made(positions, triangles)
    targets = [reflines.smooth(solver, length=SMOOTH, strength=s) for s in (0.8, 0.82)]
    solver.solve(targets[0], limit=5e-4)
    for k in range(6):
        report = solver.solve(targets[(k + 1) % 2], limit=5e-4, gradient_tolerance=1e-2)
        assert report.converged and report.analyses == 0, report.message
        assert report.factorizations <= 4


def test_a_drag_whose_steps_cost_more_than_a_new_matrix_gets_one():
    """With the first solve's matrix each update took four steps: 40 in all."""
    positions, triangles = ripples(40, amplitude=0.03)
    positions[:, 2] += np.random.default_rng(1).normal(0, 1e-3, len(positions))
    solver = made(positions, triangles)
    targets = [reflines.smooth(solver, length=SMOOTH, strength=s) for s in (0.8, 0.82)]
    limit = 0.5 * made(positions, triangles).solve(targets[0]).largest_move
    solver.solve(targets[0], limit=limit)
    reports = [solver.solve(targets[(k + 1) % 2], limit=limit, gradient_tolerance=1e-2) for k in range(10)]
    assert all(report.converged and report.limited > 0 for report in reports)
    assert sum(report.factorizations for report in reports) == 1
    assert sum(report.iterations for report in reports) <= 20


def test_an_update_of_a_drag_takes_few_solves():
    """Contacts that pull are released without a solve, and the model is solved at once: else six took 27 and 26."""
    positions, triangles = ripples(60, amplitude=1e-3)
    solver = made(positions, triangles)
    targets = [reflines.smooth(solver, length=0.5, strength=s) for s in (0.8, 0.9)]
    largest = made(positions, triangles).solve(targets[0]).largest_move
    for share in (0.5, 0.3):
        solver.solve(targets[0], limit=share * largest)
        reports = [
            solver.solve(targets[(k + 1) % 2], limit=share * largest, gradient_tolerance=1e-2) for k in range(6)
        ]
        assert all(report.converged and report.iterations == 1 and report.limited > 100 for report in reports)
        assert sum(report.solves for report in reports) <= 20
