"""A worker thread runs Python while its owner lends it the turn, and never else; native work needs no turn."""
import threading
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager

import pytest
import reflines
from sample_panels import LINE, VIEW, panel, rippled

PATIENCE = 30.0  # seconds


@contextmanager
def worker(work: Callable[[], None]) -> Generator[reflines.PythonTurn, None, None]:
    """Does `work` in the turns that it gets; is joined at the end."""
    turn = reflines.PythonTurn()
    thread = threading.Thread(target=lambda: (turn.take(), work(), turn.rest()))
    thread.start()
    try:
        yield turn
    finally:
        turn.give_away()
        thread.join()


def solver(cells: int) -> reflines.ShapeOptimizer:
    positions, triangles = panel(cells)
    return reflines.ShapeOptimizer(rippled(positions, amplitude=1e-3, wavelength=0.3), triangles, view_direction=VIEW,
                                   line_direction=LINE)


def wait_until(true: Callable[[], bool]) -> None:
    end = time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < end
        time.sleep(0.001)


def test_python_runs_in_turns_only():
    optimizer, steps = solver(8), []

    def work() -> None:
        for step in range(40):
            steps.append(step)
            optimizer.score(0.3)

    with worker(work) as turn:
        while len(steps) < 40:
            wait_until(lambda: turn.wanted)
            before = len(steps)
            time.sleep(0.002)  # lets go of Python's lock: a thread as any other would go on here
            assert len(steps) == before
            turn.lend(0.0)
            assert len(steps) > before


def test_short_native_work_is_waited_for_and_long_is_not():
    long, ended = solver(150), []
    with worker(lambda: ended.append(long.solve(reflines.smooth(long, length=0.3)))) as turn:
        turn.lend(0.0)
        assert not ended and not turn.wanted  # it is in native code
        wait_until(lambda: turn.wanted)
        turn.lend(PATIENCE)
        assert ended[0].converged
    short, ended = solver(4), []
    with worker(lambda: ended.append(short.solve(reflines.smooth(short, length=0.3)))) as turn:
        turn.lend(PATIENCE)
        assert ended


def test_errors_of_native_code_come_in_a_turn_too():
    optimizer, caught = solver(4), []

    def work() -> None:
        with pytest.raises(reflines.InvalidInput):
            reflines.smooth(optimizer, length=-1.0)
        caught.append(True)

    with worker(work) as turn:
        turn.lend(PATIENCE)
        assert caught


def test_given_away_it_is_the_workers_for_ever():
    optimizer, steps = solver(4), []

    def work() -> None:
        for step in range(20):
            steps.append(step)
            optimizer.score(0.3)

    with worker(work) as turn:
        turn.lend(0.0)
    assert len(steps) == 20


@pytest.mark.parametrize("given_away", [True, False])
def test_one_that_is_collected_gives_itself_away(given_away: bool) -> None:
    """Else the worker's next native call asks freed memory, or waits for a turn that nobody is left to lend."""
    optimizer, steps, turns = solver(100), [], [reflines.PythonTurn()]
    taken, ended = threading.Event(), threading.Event()

    def work() -> None:
        turns[0].take()
        taken.set()
        optimizer.solve(reflines.smooth(optimizer, length=0.3))
        for step in range(20):
            steps.append((step, bytearray(150)))  # where freed memory would be taken again
            optimizer.score(0.3)
        ended.set()

    threading.Thread(target=work, daemon=True).start()
    if given_away:
        turns[0].give_away()
    else:
        turns[0].lend(0.0)
    assert taken.wait(PATIENCE)
    turns.clear()
    assert ended.wait(PATIENCE) and len(steps) == 20
