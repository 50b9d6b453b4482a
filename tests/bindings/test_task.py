"""Calls in the background: the same results and errors as calls at once, and no second thread ever runs Python."""
import contextlib
import gc
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, panel, rippled

PATIENCE = 60.0  # seconds


def solver(cells: int) -> reflines.ShapeOptimizer:
    positions, triangles = panel(cells)
    return reflines.ShapeOptimizer(rippled(positions, amplitude=1e-3, wavelength=0.3), triangles, view_direction=VIEW,
                                   line_direction=LINE)


def start_solve(optimizer: reflines.ShapeOptimizer, **options: object) -> "reflines.Task[reflines.Report]":
    return reflines.start(optimizer.solve, reflines.smooth(optimizer, length=0.3), **options)


VIEWED = {"view_direction": VIEW, "line_direction": LINE}
UNIT = {"low": (0.0, 0.0), "high": (1.0, 1.0), "columns": 1, "rows": 1}


@pytest.mark.parametrize(("prepare", "read"), [
    (lambda optimizer: partial(optimizer.score, 0.3), lambda score: score.shift),
    (lambda optimizer: partial(reflines.smooth, optimizer, length=0.3), lambda target: target.gradient),
    (lambda optimizer: partial(reflines.warp, optimizer, **UNIT, position=[[0, 0], [1, 0], [0, 1], [1.1, 1]]),
     lambda warped: warped[0].gradient),
    (lambda _: partial(reflines.smooth_panel, *panel(8), **VIEWED), lambda pressed: pressed[0]),
    (lambda _: partial(reflines.ShapeOptimizer.create, *panel(8), **VIEWED), lambda built: built.heights),
    (lambda optimizer: partial(reflines.LineHandles.create, optimizer), lambda lines: lines.read_theta([[0.1, 0.1]])),
    (lambda _: partial(reflines.NormalFit.create, *panel(8)), lambda fit: fit.normals(panel(8)[0])),
    (lambda _: partial(reflines.split_at_creases, *panel(8)), lambda split: split[1]),
])
def test_results_have_the_bits_of_calls_at_once(prepare: Callable, read: Callable) -> None:
    call = prepare(solver(8))
    assert np.array_equal(read(reflines.start(call.func, *call.args, **call.keywords).result()), read(call()))


def test_a_solve_has_the_bits_of_a_solve_at_once() -> None:
    here, there = solver(24), solver(24)
    report = here.solve(reflines.smooth(here, length=0.3))
    task = start_solve(there)
    assert task.result().iterations == report.iterations and task.result() is task.result()
    assert np.array_equal(here.positions, there.positions)


def test_no_other_thread_runs_python() -> None:
    task, frames, steps = start_solve(solver(150)), set(), 0
    assert not task.done and not task.wait(0.0)
    while not task.done:
        frames.add(len(sys._current_frames()))
        steps += 1
        time.sleep(0.0001)
    assert frames == {1} and steps > 10
    assert task.wait(0.0) and task.result().converged


def test_arrays_that_change_after_the_start_do_not_change_the_result() -> None:
    positions, triangles = panel(60)
    V, F = rippled(positions, amplitude=1e-3, wavelength=0.3), triangles.copy()
    wanted = reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LINE).heights
    task = reflines.start(reflines.ShapeOptimizer.create, V, F, view_direction=VIEW, line_direction=LINE)
    V[:], F[:] = np.nan, -1
    assert np.array_equal(task.result().heights, wanted)


def test_objects_live_until_the_call_has_ended() -> None:
    task = start_solve(solver(150))  # nothing else holds the optimizer
    gc.collect()
    assert task.result().converged


def test_errors_come_with_the_result() -> None:
    optimizer = solver(4)
    for function, arguments, error in ((reflines.smooth, {"length": -1.0}, reflines.InvalidInput),
                                       (reflines.uniform, {"influence": "all"}, TypeError)):
        task = reflines.start(function, optimizer, **arguments)
        for _ in range(2):
            with pytest.raises(error):
                task.result()
    assert optimizer.score(0.3).shift > 0.0


def test_an_optimizer_at_work_refuses_others() -> None:
    optimizer = solver(150)
    task = start_solve(optimizer)
    with pytest.raises(reflines.InvalidInput, match="in use"):  # also before the thread has begun
        optimizer.score(0.3)
    with pytest.raises(reflines.InvalidInput, match="in use"):
        reflines.start(optimizer.score, 0.3).result()
    assert task.result().converged and optimizer.score(0.3).shift > 0.0


def test_work_that_is_started_is_not_refused_by_calls_that_come_later() -> None:
    """Had the thread reserved the optimizer, a call that is made before it runs would have the task refused."""
    optimizer = solver(4)
    for _ in range(200):
        task = reflines.start(optimizer.score, 0.3)
        with contextlib.suppress(reflines.InvalidInput):
            optimizer.energy(reflines.smooth(optimizer, length=0.3))
        assert task.result().shift > 0.0


def test_a_collected_task_leaves_nothing_at_work() -> None:
    optimizer = solver(100)
    task = start_solve(optimizer)
    del task
    assert optimizer.score(0.3).shift > 0.0


def test_a_call_is_cancelled_by_its_progress() -> None:
    optimizer, progress = solver(200), reflines.Progress()
    task = start_solve(optimizer, progress=progress)
    progress.cancel()
    assert task.result().termination == "cancelled"


def test_what_is_no_long_work_is_done_at_once() -> None:
    task = reflines.start(reflines.image_plane, VIEW, LINE)
    assert task.done and np.array_equal(task.result(), reflines.image_plane(VIEW, LINE))


class LengthThatScores:
    """An argument whose conversion makes a call of its own."""

    def __init__(self, optimizer: reflines.ShapeOptimizer) -> None:
        self.optimizer = optimizer

    def __float__(self) -> float:
        self.optimizer.score(0.3)
        return 0.3


def test_a_task_is_one_call() -> None:
    optimizer = solver(4)
    with pytest.raises(reflines.InvalidInput, match="one native call"):
        reflines.start(optimizer.score, LengthThatScores(optimizer)).result()
    assert optimizer.score(0.3).shift > 0.0


def test_functions_of_python_are_refused() -> None:
    """What they alone refer to could be deleted while native work uses it."""
    optimizer = solver(4)
    for function in (lambda: optimizer.score(0.3), partial(optimizer.score, 0.3), print_nothing,
                     Scorer(optimizer).score):
        with pytest.raises(reflines.InvalidInput, match="not start\\(lambda"):
            reflines.start(function)


def print_nothing() -> None:
    """A function of Python."""


class Scorer:
    """An object with a method of Python."""

    def __init__(self, optimizer: reflines.ShapeOptimizer) -> None:
        self.optimizer = optimizer

    def score(self) -> "reflines.Score":
        return self.optimizer.score(0.3)


@pytest.mark.parametrize("seconds", [-1.0, np.nan])
def test_times_that_are_none_are_refused(seconds: float) -> None:
    task = reflines.start(reflines.image_plane, VIEW, LINE)
    with pytest.raises(reflines.InvalidInput):
        task.wait(seconds)
    assert task.wait(np.inf)


def test_many_calls_run_at_the_same_time() -> None:
    optimizers = [solver(20) for _ in range(12)]
    tasks = [start_solve(each) for each in optimizers]
    assert all(task.result().converged for task in tasks)
    assert all(np.array_equal(each.positions, optimizers[0].positions) for each in optimizers)


def test_the_end_of_python_waits_for_what_runs() -> None:
    code = ("import sys; sys.path[:] = " + repr(sys.path) + "\n"
            "from test_task import solver, start_solve\n"
            "kept = [solver(150)]; kept.append(start_solve(kept[0])); print('started')\n")
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=PATIENCE)
    assert (ended.returncode, ended.stdout) == (0, "started\n"), ended.stderr
