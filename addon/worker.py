"""A thread that does the latest thing it was asked for: native work beside Blender, Python only in turns.

Blender breaks where a second thread runs Python while it does not wait for it (see native/bindings/turn.h). So the
thread gets its turns from Blender's own thread: in `submit`, and in `take`, which is for timers to call; a stopped one
from a timer of its own.
"""
import atexit
import gc
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Generic, TypeVar

import bpy

from . import native

PATIENCE = 0.012  # seconds Blender waits for native work at most; what takes longer is looked for at the next tick
LOOK = 0.02       # seconds between looks at threads that are to end

Request = TypeVar("Request")
Outcome = TypeVar("Outcome")


class Worker(Generic[Request, Outcome]):
    """Requests that were overtaken are never begun; of the outcomes only the latest is kept for the one who asks.

    All is called from Blender's thread. What the work gets and makes is touched by one thread at a time."""

    def __init__(self, work: Callable[[Request], Outcome], cancel: Callable[[], None] = lambda: None) -> None:
        """`cancel` makes native work that takes long give up."""
        self._work, self._cancel = work, cancel
        self._request: Request | None = None
        self._outcome: Outcome | None = None
        self._busy = self._failed = self._stopped = self._ended = False
        self._turn = native.reflines.PythonTurn()
        # No thread that Python itself waits for at the end, before anything could end it: see `end_all`.
        self._thread = threading.Thread(target=self._run, name="reflection lines", daemon=True)
        self._thread.start()
        self._lend()
        _workers.append(self)

    def submit(self, request: Request) -> None:
        """Nothing is begun after an error or the end."""
        if self._failed or self._ended:
            return
        self._request = request
        if not self._busy or self._turn.wanted:
            self._lend()

    def take(self) -> Outcome | None:
        if self._turn.wanted:
            self._lend()
        outcome, self._outcome = self._outcome, None
        return outcome

    def has_outcome(self) -> bool:
        """For `take`."""
        return self._outcome is not None

    def idle(self) -> bool:
        return self._request is None and not self._busy

    def alive(self) -> bool:
        """False after an error in the work, which Python has then printed."""
        return not self._failed

    def stop(self) -> None:
        """The thread ends as soon as the work that it is doing now gives up."""
        self._stopped, self._request = True, None
        self._cancel()
        if reap() and not bpy.app.timers.is_registered(reap):
            bpy.app.timers.register(reap, first_interval=LOOK, persistent=True)

    def is_stopped(self) -> bool:
        return self._stopped

    def has_ended(self) -> bool:
        """Ends a stopped thread that has done its work."""
        if self._stopped and not self._ended and self._turn.wanted:
            self._lend()
        if self._stopped and not self._ended and self.idle():
            self.end()
        return self._ended

    def end(self) -> None:
        """Waits for the thread."""
        self._stopped = self._ended = True
        self._cancel()
        with without_collection():
            self._turn.give_away()
            self._thread.join()

    def _lend(self) -> None:
        with without_collection():
            self._turn.lend(PATIENCE)
        if self._failed and not self._ended:
            self.end()

    def _run(self) -> None:
        self._turn.take()
        try:
            while not self._ended:
                if self._request is None:
                    self._turn.rest()
                else:
                    self._do()
        finally:
            self._busy, self._failed = False, not self._ended
            if self._failed:
                self._turn.rest()  # it has to end in `end`: who lends a turn waits for the next rest

    def _do(self) -> None:
        request, self._request, self._busy = self._request, None, True
        self._outcome = self._work(request)
        self._busy = False


@contextmanager
def without_collection() -> Generator[None, None, None]:
    """What Python collects may be Blender's, such as a batch on the GPU: no other thread may end it."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


_workers: list[Worker] = []


def reap() -> float | None:
    """A timer: whether there are stopped threads that are still in native code."""
    _workers[:] = [worker for worker in _workers if not worker.has_ended()]
    return LOOK if any(worker.is_stopped() for worker in _workers) else None


def end_all() -> None:
    """When Python ends, or the add-on."""
    while _workers:
        _workers.pop().end()


def register() -> None:
    atexit.register(end_all)


def unregister() -> None:
    atexit.unregister(end_all)
    end_all()
