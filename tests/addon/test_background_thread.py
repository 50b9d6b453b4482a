"""The thread of drags, live warps and fits of normals, beside a Blender that is used meanwhile."""
import threading
import time
from collections.abc import Callable, Generator

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines import native
from reflection_lines.interactive.background_thread import BackgroundThread

PATIENCE = 30.0  # seconds
OPERATORS = 500  # with a context of a script's: a thread that ran Python at any time crashed Blender within 100


@pytest.fixture
def made() -> Generator[Callable[..., object], None, None]:
    workers = []

    def make(*how: Callable) -> object:
        workers.append(BackgroundThread(*how))
        return workers[-1]

    yield make
    for worker in workers:
        worker.end()


def taken(worker: object) -> object:
    end = time.monotonic() + PATIENCE
    while (outcome := worker.take()) is None:
        assert time.monotonic() < end
        time.sleep(0.002)
    return outcome


def small_solver() -> object:
    grid = np.stack(np.meshgrid(np.arange(5.0), np.arange(5.0)), axis=-1).reshape(-1, 2)
    V = np.column_stack([grid, -0.05 * (grid**2).sum(axis=1)])
    corner = np.arange(20).reshape(4, 5)[:, :4].ravel()
    F = np.concatenate([np.stack([corner, corner + 1, corner + 6], 1), np.stack([corner, corner + 6, corner + 5], 1)])
    return native.reflines.ShapeOptimizer(V, F.astype(np.int32), view_direction=np.array([0.0, 0.0, 1.0]),
                                                    line_direction=np.array([0.0, 1.0, 0.0]))


def test_scripts_run_operators_while_the_thread_works(made):
    """Blender asks whether any thread has Python's lock where it means whether it has been called from Python."""
    solver = small_solver()

    def work(_: object) -> int:
        calls = 0
        while not enough:
            solver.score(1.0)
            calls += 1
        return calls

    ob, worker, enough = scenes.panel(cells=2), made(work), []
    worker.submit("go")
    for _ in range(OPERATORS):
        with bpy.context.temp_override(object=ob, active_object=ob, selected_objects=[ob]):
            bpy.ops.object.select_all(action='TOGGLE')
        worker.take()
    enough.append(True)
    assert taken(worker) > OPERATORS


def test_overtaken_requests_are_never_begun(made):
    solver, begun = small_solver(), []

    def work(request: int) -> int:
        begun.append(request)
        while not hold:
            solver.score(1.0)
        return request

    worker, hold = made(work), []
    for request in range(5):
        worker.submit(request)
    assert begun == [0] and not worker.is_idle()
    hold.append(True)
    while taken(worker) != 4:
        pass
    assert begun == [0, 4] and worker.is_idle()


def test_an_error_ends_the_work_and_is_told(made, monkeypatch):
    told = []
    monkeypatch.setattr(threading, "excepthook", lambda error: told.append(error.exc_type))

    def work(_: object) -> None:
        raise ZeroDivisionError

    worker = made(work)
    worker.submit("go")
    assert not worker.is_alive() and worker.take() is None
    assert told == [ZeroDivisionError]
    worker.submit("again")
    assert worker.is_idle()


def test_a_stopped_thread_gives_up_and_ends(made):
    said = []
    worker = made(lambda request: request, lambda: said.append("give up"))
    worker.submit("go")
    threads = threading.active_count()
    worker.stop()
    assert said and threading.active_count() == threads - 1
