"""A solve of a cage within a limit: exact for its surface, and a constrained minimum."""
import numpy as np
import pytest
import reflines
from sample_cages import LINE, VIEW, dented, hood, optimizer

SMOOTH, LEVEL = 0.35, 2
SHARES = [0.9, 0.3, 0.02]  # of the largest free move: 2, 20 and most of 143 unknowns touch


def bonnet(**options):
    return dented(hood(), VIEW, LINE, **options)


def surface_move(cage, solver, level=LEVEL):
    """The moves of the surface along the view, by nothing but the cage's positions and Subdivision."""
    V, offsets, corners = cage
    subdivision = reflines.Subdivision(offsets, corners, vertices=len(V), level=level)
    return subdivision.positions(solver.cage_positions - V)[solver.refined] @ VIEW


def solved(limit, cage=None, **options):
    cage = bonnet() if cage is None else cage
    solver = optimizer(cage, level=LEVEL, **options)
    target = reflines.smooth(solver, length=SMOOTH)
    return solver, cage, target, solver.solve(target, limit=limit)


def largest_free_move(**options):
    return solved(None, **options)[3].largest_move


@pytest.mark.parametrize("share", SHARES)
def test_no_vertex_of_the_surface_is_beyond_the_limit_by_a_bit(share):
    limit = share * largest_free_move()
    solver, cage, _, report = solved(limit)
    assert report.converged and report.limited > 0 and report.gradient_after <= 1e-6 * report.gradient_before
    start = optimizer(cage, level=LEVEL)
    way = solver.positions - start.positions
    assert np.abs(way @ VIEW).max() <= limit and np.linalg.norm(way, axis=1).max() <= limit
    assert np.abs(solver.heights - start.heights).max() <= limit
    move = surface_move(cage, solver)
    assert np.abs(move).max() <= limit and report.largest_move <= limit
    touching = solver.at_limit != 0
    assert touching.sum() == report.limited
    assert np.allclose(np.abs(move)[touching], limit, rtol=1e-4, atol=0)
    assert np.abs(solver.cage_positions - cage[0]).max() > limit  # which is for the surface alone


def test_far_from_the_origin_it_holds_as_well():
    V, offsets, corners = bonnet()
    far = (V + [300.0, -500.0, 700.0], offsets, corners)
    limit = 0.3 * largest_free_move()
    solver, _, _, report = solved(limit, far)
    assert report.converged and report.limited > 0
    assert np.abs(surface_move(far, solver)).max() <= limit
    start = optimizer(far, level=LEVEL).positions
    assert np.linalg.norm(solver.positions - start, axis=1).max() <= limit


def test_a_limit_that_nothing_touches_changes_no_bit():
    free, _, _, report = solved(None)
    for limit in (1.001 * report.largest_move, np.inf):
        limited, _, _, same = solved(limit)
        assert np.array_equal(free.cage_positions, limited.cage_positions)
        assert np.array_equal(free.positions, limited.positions)
        assert same.limited == 0 and not limited.at_limit.any()


@pytest.mark.parametrize("share", SHARES)
def test_it_beats_the_free_result_scaled_down_to_the_limit(share):
    free, cage, target, report = solved(None)
    limited, _, _, bounded = solved(share * report.largest_move)
    free.scale_move(share)
    start = optimizer(cage, level=LEVEL).energy(target)
    assert limited.energy(target) == pytest.approx(bounded.energy_after)
    assert report.energy_after < bounded.energy_after < free.energy(target) < start
    if share == 0.3:  # most of what scaling leaves is left because of a few vertices
        assert bounded.energy_after - report.energy_after < 0.1 * (free.energy(target) - report.energy_after)


def test_its_gradient_is_balanced_by_forces_into_the_limits():
    """The KKT conditions by finite differences and non-negative least squares: nothing but energies and Subdivision."""
    optimize = pytest.importorskip("scipy.optimize", reason="scipy is where the project is built, not where it is used")
    cage = dented(hood(8, 6), VIEW, LINE)
    solver = optimizer(cage, level=1, proximity=0.0)
    target = reflines.smooth(solver, length=0.6)
    limit = 0.4 * solver.solve(target).largest_move
    solver.reset()
    report = solver.solve(target, limit=limit)
    assert report.converged and report.limited > 3
    V, offsets, corners = cage
    free = np.flatnonzero(solver.cage_free)
    held = solver.at_limit
    subdivision = reflines.Subdivision(offsets, corners, vertices=len(V), level=1)

    def slopes(positions):
        result = []
        for v in free:
            energies = []
            for sign in (1.0, -1.0):
                moved = positions.copy()
                moved[v] += sign * 1e-6 * VIEW
                energies.append(optimizer((moved, offsets, corners), level=1, proximity=0.0).energy(target))
            result.append((energies[0] - energies[1]) / 2e-6)
        return np.array(result)

    columns = []
    for v in free:
        unit = np.zeros_like(V)
        unit[v, 0] = 1.0
        columns.append(-(held * subdivision.positions(unit)[solver.refined, 0])[held != 0])
    force, left = optimize.nnls(np.stack(columns), slopes(solver.cage_positions))
    assert left < 1e-4 * np.linalg.norm(slopes(V))
    assert (force > 0).sum() > 3


@pytest.mark.parametrize("side", [0, 1])
def test_one_way_only(side):
    cage = bonnet()
    solver = optimizer(cage, level=LEVEL)
    target = reflines.smooth(solver, length=SMOOTH)
    ranges = np.zeros((len(solver.positions), 2))
    ranges[:, side] = [-np.inf, np.inf][side]
    report = solver.solve(target, limit=ranges)
    assert report.converged, report.message
    move = surface_move(cage, solver) * [-1, 1][side]
    assert move.min() >= 0 and move.max() > 1e-4
    assert report.limited > 2 and report.energy_after < 0.5 * report.energy_before


def test_a_painted_limit_keeps_what_has_none():
    cage = bonnet()
    solver = optimizer(cage, level=LEVEL)
    start = solver.positions
    target = reflines.smooth(solver, length=SMOOTH)
    painted = 1e-3 * np.clip(start[:, 0] / 0.7, 0, 1)
    report = solver.solve(target, limit=np.column_stack([-painted, painted]))
    assert report.converged, report.message
    move = surface_move(cage, solver)
    assert (np.abs(move) <= painted).all() and np.abs(move).max() > 1e-4
    assert np.array_equal(solver.positions[painted == 0], start[painted == 0])


@pytest.mark.parametrize("seed", [1039, 1096, 1167, 1232])
def test_ranges_of_every_size_hold(seed):
    """Where solves from inside end without all digits, too. Moves are those of the control vertices, subdivided."""
    random = np.random.default_rng(seed)
    cage = dented(hood(*((8, 14), (12, 14), (16, 8))[seed % 3]), VIEW, LINE)
    solver = optimizer(cage, level=LEVEL, border="fixed")
    target = reflines.smooth(solver, length=SMOOTH)
    largest = solver.solve(target).largest_move
    for power in (1, 4):
        ends = 0.2 * largest * random.random((len(solver.positions), 2)) ** power
        solver.reset()
        report = solver.solve(target, limit=ends * [-1.0, 1.0])
        move = surface_move(cage, solver)
        assert (move <= ends[:, 1]).all() and (move >= -ends[:, 0]).all()
        assert report.energy_after < report.energy_before and report.limited > 0


def test_neighbours_that_may_only_go_opposite_ways():
    cage = bonnet()
    solver = optimizer(cage, level=LEVEL)
    target = reflines.smooth(solver, length=SMOOTH)
    left = solver.positions[:, 0] < 0
    report = solver.solve(target, limit=np.where(left[:, None], [-1e-3, 0.0], [0.0, 1e-3]))
    assert report.converged, report.message
    move = surface_move(cage, solver)
    assert move[left].max() <= 0 <= move[~left].min()
    assert min(move.max(), -move.min()) > 1e-4


@pytest.mark.parametrize("border", ["clamped", "fixed", "free"])
def test_borders_and_several_families(border):
    cage = bonnet()
    lines = np.array([LINE, np.cross(VIEW, LINE)])
    solver = optimizer(cage, VIEW, lines, level=LEVEL, border=border)
    targets = [reflines.smooth(solver, length=SMOOTH, family=k) for k in (0, 1)]
    limit = 0.4 * solver.solve(targets).largest_move
    solver.reset()
    report = solver.solve(targets, limit=limit)
    assert report.converged and report.limited > 2, report.message
    assert np.abs(surface_move(cage, solver)).max() <= limit


def test_mirror_images_keep_equal_moves():
    V, offsets, corners = hood()
    partner = reflines.mirror_pairs(V, point=(0, 0, 0), normal=(1, 0, 0), tolerance=1e-9)
    rough = V + 1e-3 * np.outer(np.sin(40 * np.abs(V[:, 0])) * np.sin(31 * V[:, 1]), VIEW)
    cage = (rough, offsets, corners)
    solver = optimizer(cage, level=LEVEL, partner=partner)
    target = reflines.smooth(solver, length=SMOOTH)
    limit = 0.3 * solver.solve(target).largest_move
    solver.reset()
    report = solver.solve(target, limit=limit)
    assert report.converged and report.limited > 2, report.message
    move = (solver.cage_positions - rough) @ VIEW
    assert np.array_equal(move, move[partner])
    assert np.abs(surface_move(cage, solver)).max() <= limit


def test_a_result_beyond_the_limit_is_put_back_first():
    solver, cage, target, free = solved(None)
    limit = 0.3 * free.largest_move
    report = solver.solve(target, limit=limit)
    assert report.converged, report.message
    assert report.put_back > 10 and "put back" in report.message
    assert np.abs(surface_move(cage, solver)).max() <= limit
    afresh = solved(limit)[0]
    assert np.abs(solver.cage_positions - afresh.cage_positions).max() < 1e-3 * limit


def test_solved_again_it_stays():
    limit = 0.3 * largest_free_move()
    solver, _, target, first = solved(limit)
    before = solver.cage_positions
    report = solver.solve(target, limit=limit)
    assert report.converged and report.energy_after == pytest.approx(first.energy_after, rel=1e-9)
    assert np.abs(solver.cage_positions - before).max() < 1e-4 * limit


def test_a_limit_of_nothing():
    cage = bonnet()
    solver = optimizer(cage, level=LEVEL)
    target = reflines.smooth(solver, length=SMOOTH)
    report = solver.solve(target, limit=0.0)
    assert report.termination == "already_optimal" and "Nothing may move" in report.message
    assert np.array_equal(solver.cage_positions, cage[0])
    solver.solve(target)
    back = solver.solve(target, limit=0.0)
    assert back.put_back > 10 and np.array_equal(solver.cage_positions, cage[0])
