"""A background thread for native work, which runs the latest request and drops those overtaken.

Blender crashes where another thread runs Python while Blender's own thread is not waiting for it, since it asks whether
any thread holds the GIL where it means its own. So the GIL is handed over explicitly (native/python/gil_handover.h):
Blender's thread lends it in `submit` and in `take`, which timers call, and waits until the background thread gives it
back.
"""
import atexit
import gc
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Generic, TypeVar

import bpy

from .. import native

LONGEST_WAIT = 0.012  # seconds that Blender waits for native work; longer work is taken at a later tick
LOOK_INTERVAL = 0.02  # seconds between two checks of threads that are to end

Request = TypeVar("Request")
Outcome = TypeVar("Outcome")


class BackgroundThread(Generic[Request, Outcome]):
    """Runs `work` on requests: overtaken requests are never begun, and only the latest outcome is kept.

    All methods are called from Blender's thread. Requests and outcomes are used by one thread at a time.
    """

    def __init__(self, work: Callable[[Request], Outcome], cancel: Callable[[], None] = lambda: None) -> None:
        """Starts the thread. `cancel` makes long native work give up."""
        self._work, self._cancel = work, cancel
        self._request: Request | None = None
        self._outcome: Outcome | None = None
        self._busy = self._failed = self._stopped = self._ended = False
        self._turn = native.reflines.PythonTurn()
        # A daemon: Python joins other threads at exit before `end_all_threads` could end this one.
        self._thread = threading.Thread(target=self._run, name="reflection lines", daemon=True)
        self._thread.start()
        self._lend()
        _threads.append(self)

    def submit(self, request: Request) -> None:
        """Hands over a request in place of one not yet begun; ignored after an error or the end."""
        if self._failed or self._ended:
            return
        self._request = request
        if not self._busy or self._turn.wanted:
            self._lend()

    def take(self) -> Outcome | None:
        """Returns the latest outcome once, None where there is none; lends the GIL where the thread waits for it."""
        if self._turn.wanted:
            self._lend()
        outcome, self._outcome = self._outcome, None
        return outcome

    def has_outcome(self) -> bool:
        """Returns whether `take` has an outcome to return."""
        return self._outcome is not None

    def is_idle(self) -> bool:
        """Returns whether no request waits or runs."""
        return self._request is None and not self._busy

    def is_alive(self) -> bool:
        """Returns False after an error in the work, which Python has printed then."""
        return not self._failed

    def stop(self) -> None:
        """Cancels the work; the thread ends as soon as it gives up."""
        self._stopped, self._request = True, None
        self._cancel()
        if end_stopped_threads() and not bpy.app.timers.is_registered(end_stopped_threads):
            bpy.app.timers.register(end_stopped_threads, first_interval=LOOK_INTERVAL, persistent=True)

    def is_stopped(self) -> bool:
        return self._stopped

    def try_to_end(self) -> bool:
        """Ends a stopped thread whose work has given up; returns whether it has ended."""
        if self._stopped and not self._ended and self._turn.wanted:
            self._lend()
        if self._stopped and not self._ended and self.is_idle():
            self.end()
        return self._ended

    def end(self) -> None:
        """Cancels the work and waits for the thread."""
        self._stopped = self._ended = True
        self._cancel()
        with pause_garbage_collection():
            self._turn.give_away()
            self._thread.join()

    def _lend(self) -> None:
        with pause_garbage_collection():
            self._turn.lend(LONGEST_WAIT)
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
                self._turn.rest()  # ends in `end`: the thread that lends the GIL waits for this

    def _do(self) -> None:
        request, self._request, self._busy = self._request, None, True
        self._outcome = self._work(request)
        self._busy = False


@contextmanager
def pause_garbage_collection() -> Generator[None, None, None]:
    """Disables Python's garbage collector while another thread holds the GIL: it may free Blender's data, such as GPU
    batches, which only Blender's thread may do.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


_threads: list[BackgroundThread] = []


def end_stopped_threads() -> float | None:
    """Ends stopped threads once they leave native code; a timer that runs as long as there are some."""
    _threads[:] = [worker for worker in _threads if not worker.try_to_end()]
    return LOOK_INTERVAL if any(worker.is_stopped() for worker in _threads) else None


def end_all_threads() -> None:
    """Ends all threads, when Python exits or the add-on is disabled."""
    while _threads:
        _threads.pop().end()


def register() -> None:
    atexit.register(end_all_threads)


def unregister() -> None:
    atexit.unregister(end_all_threads)
    end_all_threads()
