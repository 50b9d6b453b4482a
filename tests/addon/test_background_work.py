"""The background work of drags, live warps and fits of normals, beside a Blender that is used meanwhile."""
import sys
import time
import traceback
from collections.abc import Callable, Generator

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines import background_work, native, native_call
from reflection_lines.background_work import BackgroundWork

PATIENCE = 30.0  # seconds
SHORT_CALLS = 100
OPERATORS = 500  # with a context of a script's: a thread that ran Python at any time crashed Blender within 100


@pytest.fixture
def made() -> Generator[Callable[..., object], None, None]:
    workers = []

    def make(*how: Callable) -> object:
        workers.append(BackgroundWork(*how))
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


def make_solver(cells: int = 4) -> object:
    side = cells + 1
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2) * (4.0 / cells)
    V = np.column_stack([grid, -0.05 * (grid**2).sum(axis=1)])
    corner = np.arange(cells * side).reshape(cells, side)[:, :cells].ravel()
    opposite = corner + side + 1
    F = np.concatenate([np.stack([corner, corner + 1, opposite], 1), np.stack([corner, opposite, corner + side], 1)])
    return native.reflines.ShapeOptimizer(V, F.astype(np.int32), view_direction=np.array([0.0, 0.0, 1.0]),
                                                    line_direction=np.array([0.0, 1.0, 0.0]))


def test_scripts_run_operators_while_native_calls_run(made):
    """Blender asks whether any thread has the GIL where it means whether it has been called from Python."""
    solver = make_solver()

    async def work(_: object) -> int:
        calls = 0
        while not enough:
            await native_call.call(solver.score, 1.0)
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
    solver, begun = make_solver(), []

    async def work(request: int) -> int:
        begun.append(request)
        while not hold:
            await native_call.call(solver.score, 1.0)
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
    monkeypatch.setattr(traceback, "print_exc", lambda: told.append(sys.exc_info()[0]))

    async def work(_: object) -> None:
        raise ZeroDivisionError

    worker = made(work)
    worker.submit("go")
    assert not worker.is_alive() and worker.take() is None
    assert told == [ZeroDivisionError]
    worker.submit("again")
    assert worker.is_idle()


def test_errors_of_native_calls_can_be_handled(made):
    """Those of the arguments, and those of the work."""
    solver = make_solver()

    async def work(call: tuple) -> str:
        try:
            await native_call.call(*call)
        except (TypeError, native.InvalidInput) as error:
            return type(error).__name__
        return "none"

    worker = made(work)
    for call, wanted in (((solver.score, "long"), "TypeError"), ((solver.score, -1.0), "InvalidInput"),
                         ((solver.score, 1.0), "none")):
        worker.submit(call)
        assert taken(worker) == wanted


def test_long_native_calls_are_not_waited_for_and_short_ones_are(made):
    solver, ended = make_solver(), []

    async def work(times: int) -> int:
        for _ in range(times):
            if not ended:
                await native_call.call(solver.score, 1.0)
        return times

    worker = made(work, lambda: ended.append(True))
    at_once = 0
    for _ in range(SHORT_CALLS):
        worker.submit(1)
        at_once += worker.has_outcome()
        assert taken(worker) == 1
    assert at_once >= 0.95 * SHORT_CALLS  # with six other processes on two cores 99, without the first, and 100
    start = time.monotonic()
    worker.submit(10**6)
    assert time.monotonic() - start < 1.0 and not worker.is_idle() and worker.take() is None


def test_native_calls_are_waited_for_as_long_as_the_wait_lasts(made, monkeypatch):
    """Also the first one, and one that takes several times the wait of a window."""
    for name in ("LEAST_WAIT", "MOST_WAIT"):
        monkeypatch.setattr(background_work, name, PATIENCE)
    solver = make_solver(300)

    async def work(times: int) -> int:
        for _ in range(times):
            await native_call.call(solver.score, 1.0)
        return times

    worker = made(work)
    worker.submit(2)
    assert worker.has_outcome() and worker.take() == 2


def test_stopped_work_gives_up_and_ends(made):
    said, solver = [], make_solver()

    async def work(_: object) -> str:
        while not said:
            await native_call.call(solver.score, 1.0)
        return "gave up"

    worker = made(work, lambda: said.append("give up"))
    worker.submit("go")
    assert not worker.is_idle()
    worker.stop()
    while not worker.try_to_end():
        time.sleep(0.002)
    assert said == ["give up"] and worker.is_idle()
    assert solver.score(1.0).shift >= 0.0  # it is in no call any more
