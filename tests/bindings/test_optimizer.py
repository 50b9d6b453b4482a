"""The optimizer through numpy: cancelling, watching, back ends, refusals; what a script or an add-on relies on."""
import functools
import threading
import time

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, inside, panel, rippled
from sample_panels import optimizer as made


def ripples(cells):
    positions, triangles = panel(cells)
    return rippled(positions, amplitude=3e-4, wavelength=0.1), triangles


def test_cancel_from_another_thread_leaves_every_bit():
    positions, triangles = ripples(120)
    solver = made(positions, triangles)
    target = reflines.smooth(solver, length=0.3)
    progress, reports = reflines.Progress(), []
    solve = functools.partial(solver.solve, target, gradient_tolerance=0.0, progress=progress)
    worker = threading.Thread(target=lambda: reports.append(solve()))
    worker.start()
    while not progress.stage:
        time.sleep(0.001)  # the solver does not hold the GIL: this loop runs beside it
    progress.cancel()
    worker.join(120)
    assert progress.cancelled and reports[0].termination == "cancelled"
    assert np.array_equal(solver.positions, positions)
    assert solver.solve(target).converged  # and the optimizer is as good as new


@pytest.mark.parametrize("work", [lambda solver: reflines.smooth(solver, length=0.3), lambda solver: solver.score(0.3)])
def test_a_cancelled_smoothing_leaves_the_optimizer_as_it_was(work):
    positions, triangles = ripples(32)
    solver, progress = made(positions, triangles), reflines.Progress()
    expected = solver.solve(reflines.smooth(solver, length=0.3)).energy_after
    solver = made(positions, triangles)
    solver.watch(progress)
    progress.cancel()
    with pytest.raises(reflines.Cancelled):
        work(solver)
    solver.watch(None)
    assert solver.solve(reflines.smooth(solver, length=0.3)).energy_after == expected


def test_a_watcher_is_told_what_is_made():
    positions, triangles = ripples(100)
    progress, stages = reflines.Progress(), set()
    worker = threading.Thread(target=lambda: reflines.smooth(made(positions, triangles, progress=progress), length=0.3))
    worker.start()
    while worker.is_alive():
        stages.add(progress.stage)
        time.sleep(0.0005)
    assert len(stages - {""}) >= 3
    assert 0.0 < progress.fraction < 1.0


def test_both_linear_solvers_find_the_same_surface():
    positions, triangles = ripples(32)
    heights = []
    for name in ("cholmod", "umfpack"):
        solver = made(positions, triangles, linear_solver=name)
        report = solver.solve(reflines.smooth(solver, length=0.3), gradient_tolerance=1e-9)
        assert report.linear_solver == name and report.converged
        heights.append(solver.heights)
    assert np.abs(heights[0] - heights[1]).max() < 1e-9


def test_reset_brings_the_start_back_bit_for_bit():
    positions, triangles = ripples(24)
    solver = made(positions, triangles)
    solver.solve(reflines.smooth(solver, length=0.3))
    assert not np.array_equal(solver.positions, positions)
    solver.reset()
    assert np.array_equal(solver.positions, positions)


def test_border_by_segment_clamps_one_side_and_frees_another():
    positions, triangles = ripples(24)
    codes = np.full(len(positions), 2)
    right = positions[:, 0] > 0.75 - 1e-9
    codes[right] = 0
    solver = made(positions, triangles, border=codes)
    free = solver.free
    assert free[right & (abs(positions[:, 1]) < 0.5)].all()
    assert not free[positions[:, 0] < -0.7].any()


def test_free_border_moves_nothing_that_is_not_asked_for():
    positions, triangles = panel(24)
    solver = made(positions, triangles, border="free")
    report = solver.solve(reflines.Target(solver.field()))
    assert report.termination == "already_optimal" and np.array_equal(solver.positions, positions)


def test_free_border_does_not_drift():
    # One family does not see g(y) added along the lines, nor an affine function: neither may appear.
    clean, triangles = panel(32)
    bump = 1e-3 * inside(clean, margin=0.4)
    solver = made(clean + bump[:, None] * VIEW, triangles, border="free")
    wanted = made(clean, triangles, border="free").field()
    assert solver.solve(reflines.Target(wanted)).converged
    rest = solver.positions @ VIEW - clean @ VIEW
    assert np.abs(rest).max() < bump.max()  # the crossing family keeps part of the bump along the lines, nothing else


def test_two_crossing_families_in_one_call_see_what_one_does_not():
    clean, triangles = panel(32)
    frame = reflines.image_plane(VIEW, LINE)
    along = clean @ frame[1]
    blind = 1e-3 * inside(clean, margin=0.4, rim=0.1) * np.cos(3 * along)
    lines = np.array([LINE, frame[0]])
    solver = made(clean + blind[:, None] * VIEW, triangles)
    both = reflines.ShapeOptimizer(clean + blind[:, None] * VIEW, triangles, view_direction=VIEW, line_direction=lines)
    exact = reflines.ShapeOptimizer(clean, triangles, view_direction=VIEW, line_direction=lines)
    targets = [reflines.Target(exact.field(k), family=k) for k in range(2)]
    assert both.solve(targets).converged and solver.solve(targets[0]).converged
    assert np.abs(both.heights - exact.heights).max() < 1e-3 * blind.max()


def test_pieces_between_silhouettes_are_counted_and_solved_each():
    positions, triangles = ripples(20)
    shifted = positions + [3.0, 0, 0]
    V, F = np.concatenate([positions, shifted]), np.concatenate([triangles, triangles + len(positions)])
    both = made(V, F)
    alone = made(positions, triangles)
    assert both.region.pieces == 2
    both.solve(reflines.smooth(both, length=0.3))
    alone.solve(reflines.smooth(alone, length=0.3))
    assert np.abs(both.heights[:len(positions)] - alone.heights).max() < 1e-9


@pytest.mark.parametrize("options, words", [
    ({"border": "glued"}, "border"), ({"stencil": "magic"}, "stencil"), ({"linear_solver": "pardiso"}, "linear solver"),
    ({"border": np.array([7])}, "codes"), ({"border": np.ones(25)}, "float64"),
    ({"fixed": np.array([True])}, "one entry"),
])
def test_options_that_are_none_get_a_sentence(options, words):
    with pytest.raises(reflines.InvalidInput, match=words):
        made(*panel(4), **options)


@pytest.mark.parametrize("options, words", [
    ({"gradient_tolerance": float("nan")}, "tolerance is nan"), ({"gradient_tolerance": -1e-3}, "tolerance is -0.001"),
    ({"gradient_tolerance": float("inf")}, "tolerance is inf"), ({"max_iterations": -1}, "limit of steps is -1")])
def test_solves_that_could_not_end_are_refused(options, words):
    positions, triangles = ripples(16)
    solver = made(positions, triangles)
    target = reflines.smooth(solver, length=0.3)
    with pytest.raises(reflines.InvalidInput, match=words):
        solver.solve(target, **options)
    assert np.array_equal(solver.positions, positions)
    assert solver.solve(target, max_iterations=0).termination == "iteration_limit"


@pytest.mark.parametrize("name", [np.uint8, np.uint16, np.int32, np.uint32, np.int64, np.uint64, list])
def test_indices_may_be_any_integers(name):
    positions, triangles = panel(8)
    expected = made(positions, triangles).field()
    given = triangles.tolist() if name is list else np.asfortranarray(triangles.astype(name))
    assert np.array_equal(made(positions, given).field(), expected)
    assert reflines.NormalFit(positions, given).normals(positions).shape == positions.shape


@pytest.mark.parametrize("change, words", [
    (lambda F: F + 2**32, "Index 0 of an array of indices is 4294967296"),
    (lambda F: F.astype(np.uint64) + np.uint64(2**63), "is 9223372036854775808"),
    (lambda F: F - 2**32, "is -4294967296"), (lambda F: F + 0.5, "array of float64"),
    (lambda F: F.astype(bool), "array of bool"), (lambda F: F.ravel(), "3 columns"),
    (lambda F: np.concatenate([F, F], 1), "3 columns"), (lambda F: F[:0], "no face")])
def test_indices_that_would_become_others_are_refused(change, words):
    positions, triangles = panel(8)
    with pytest.raises(reflines.InvalidInput, match=words):
        made(positions, change(triangles.astype(np.int64)))


def test_region_without_a_free_vertex_is_refused():
    with pytest.raises(reflines.InvalidInput, match="No vertex of the region is free"):
        made(*panel(2))
    positions, triangles = panel(2)
    with pytest.raises(reflines.InvalidInput, match="No vertex of the region is free"):
        made(positions, triangles[:1])


def test_a_mesh_whose_faces_are_not_joined_is_refused_by_the_count_of_doubled_vertices():
    positions, triangles = panel(8)
    apart = positions[triangles].reshape(-1, 3)
    doubled = len(apart) - len(positions)
    with pytest.raises(reflines.InvalidInput, match=f"{doubled} vertices lie on others.*merge them by distance"):
        made(apart, np.arange(len(apart)).reshape(-1, 3))


def test_threads_may_solve_at_once_and_get_the_bits_of_one():
    positions, triangles = ripples(60)

    def solved(results):
        solver = made(positions, triangles)
        solver.solve(reflines.smooth(solver, length=0.3))
        results.append(solver.positions)

    alone, together = [], []
    solved(alone)
    for _ in range(15):  # a BLAS without locks spoils one in 25
        threads = [threading.Thread(target=solved, args=(together,)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert len(together) == 45 and all(np.array_equal(result, alone[0]) for result in together)


@pytest.mark.parametrize("ask", [
    lambda solver: solver.heights, lambda solver: solver.positions, lambda solver: solver.region,
    lambda solver: solver.field(), lambda solver: solver.score(0.3), lambda solver: solver.reset(),
    lambda solver: solver.watch(None), lambda solver: solver.energy(reflines.Target(np.zeros((1, 2)))),
    lambda solver: solver.solve(reflines.Target(np.zeros((1, 2)))), lambda solver: reflines.smooth(solver, length=0.3),
    lambda solver: reflines.turn(solver, angle=0.1), lambda solver: reflines.match_dense(made(*ripples(4)), solver)])
def test_what_another_thread_is_at_work_on_is_refused_at_once(ask):
    """Two at once overwrote each other's arrays; waiting would keep a window from being drawn."""
    solver = made(*ripples(100))
    target, progress = reflines.smooth(solver, length=0.3), reflines.Progress()
    expected = solver.solve(target, max_iterations=2).energy_after
    solver.reset()
    energies = []
    solve = functools.partial(solver.solve, target, gradient_tolerance=0.0, progress=progress)
    worker = threading.Thread(target=lambda: energies.append(solve().energy_after))
    worker.start()
    while not progress.stage:
        time.sleep(0.001)
    with pytest.raises(reflines.InvalidInput, match="optimizer is in use by another thread"):
        ask(solver)
    assert solver.xy.shape == (101**2, 2) and solver.free.any()
    progress.cancel()
    worker.join(120)
    assert solver.solve(target, max_iterations=2).energy_after == expected


def test_any_number_of_threads_may_read():
    solver, failures = made(*ripples(60)), []

    def read():
        try:
            for _ in range(50):
                solver.theta(), solver.heights
        except reflines.InvalidInput as refusal:
            failures.append(refusal)

    threads = [threading.Thread(target=read) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures and solver.score(0.3).shift > 0.0


def test_arrays_of_a_target_outlive_what_takes_their_place():
    target = reflines.Target(np.ones((5, 2)), np.arange(5.0), theta=np.zeros(5))
    gradient, weight, theta = target.gradient, target.weight, target.theta
    target.gradient, target.weight, target.theta = np.zeros((3, 2)), np.zeros(3), np.zeros(0)
    gradient[:], theta[:] = 7.0, 7.0
    weight[1:] += 1.0
    assert np.array_equal(weight, [0.0, 2.0, 3.0, 4.0, 5.0])
    assert not target.gradient.any() and len(target.weight) == 3 and len(target.theta) == 0
