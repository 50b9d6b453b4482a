"""Work in the background, which serves the latest request and drops those overtaken.

The work is a coroutine whose native calls run on threads that never take the GIL (native/python/native_call.h), while
all of its Python runs on Blender's thread, in `submit` and in `take`, which timers call: Blender crashes where another
thread runs Python.
"""
import atexit
import time
import traceback
from collections.abc import Callable
from typing import Generic, TypeVar

import bpy

from . import native
from .native_call import Calling

# Seconds that Blender waits for native calls; longer ones are taken at a later tick. Where it draws slowly, a tick is a
# frame away, and a step has several calls: waiting a fraction of the last frame costs less than that.
LEAST_WAIT, MOST_WAIT, FRAME_FRACTION = 0.012, 0.05, 0.25
LOOK_INTERVAL = 0.02  # seconds between two looks at work that is to end

Request = TypeVar("Request")
Outcome = TypeVar("Outcome")


class BackgroundWork(Generic[Request, Outcome]):
    """Runs a coroutine on requests: overtaken requests are never begun, and only the latest outcome is kept."""

    def __init__(self, work: Callable[[Request], Calling[Outcome]], cancel: Callable[[], None] = lambda: None) -> None:
        """Takes the work, and what makes its long native calls give up."""
        self._work, self._cancel = work, cancel
        self._request: Request | None = None
        self._outcome: Outcome | None = None
        self._running: Calling[Outcome] | None = None
        self._task: native.Task | None = None  # the call that the running coroutine awaits
        self._failed = self._stopped = self._ended = False
        self._looked_at = time.monotonic()
        self._wait = LEAST_WAIT
        _works.append(self)

    def submit(self, request: Request) -> None:
        """Hands over a request in place of one not yet begun; ignored after an error or the end."""
        if self._failed or self._ended:
            return
        self._request = request
        self._advance()

    def take(self) -> Outcome | None:
        """Returns the latest outcome once, None where there is none, and goes on with work whose native call has ended.
        """
        now = time.monotonic()
        self._wait = min(max(FRAME_FRACTION * (now - self._looked_at), LEAST_WAIT), MOST_WAIT)
        self._looked_at = now
        self._advance()
        outcome, self._outcome = self._outcome, None
        return outcome

    def has_outcome(self) -> bool:
        """Returns whether `take` has an outcome to return."""
        return self._outcome is not None

    def is_idle(self) -> bool:
        """Returns whether no request waits or runs."""
        return self._request is None and self._running is None

    def is_alive(self) -> bool:
        """Returns False after an error in the work, which was printed then."""
        return not self._failed

    def stop(self) -> None:
        """Cancels the work, which ends as soon as its native call gives up."""
        self._stopped, self._request = True, None
        self._cancel()
        if end_stopped_works() and not bpy.app.timers.is_registered(end_stopped_works):
            bpy.app.timers.register(end_stopped_works, first_interval=LOOK_INTERVAL, persistent=True)

    def is_stopped(self) -> bool:
        return self._stopped

    def try_to_end(self) -> bool:
        """Ends stopped work whose native call has given up; returns whether it has ended."""
        if self._stopped and not self._ended:
            self._advance()
            self._ended = self.is_idle()
        return self._ended

    def end(self) -> None:
        """Cancels the work and waits for its end."""
        self._stopped = self._ended = True
        self._request = None
        self._cancel()
        while self._running is not None:
            self._resume()

    def _advance(self) -> None:
        """Goes on until nothing is left to do, or a native call takes long."""
        if self._task is not None and not self._task.done:
            return
        end = time.monotonic() + self._wait
        while not self.is_idle():
            self._resume()
            if self._task is not None and not self._task.wait(max(end - time.monotonic(), 0.0)):
                return

    def _resume(self) -> None:
        """Goes on to the next native call, or to the end of the request; begins with the next one where none runs."""
        try:
            if self._running is None:
                self._running, self._request = self._work(self._request), None
            wanted = self._running.send(self._task and self._task.result)
            self._task = native.reflines.start(wanted.func, *wanted.args, **wanted.keywords)
        except StopIteration as end:
            self._outcome, self._running, self._task = end.value, None, None
        except Exception:  # noqa: BLE001  (printed as that of a thread: operators have to end in order)
            traceback.print_exc()
            self._failed, self._request, self._running, self._task = True, None, None, None


_works: list[BackgroundWork] = []


def end_stopped_works() -> float | None:
    """Ends stopped works once their native calls give up; a timer that runs as long as there are some."""
    _works[:] = [work for work in _works if not work.try_to_end()]
    return LOOK_INTERVAL if any(work.is_stopped() for work in _works) else None


def end_all_works() -> None:
    """Ends all works, when Python exits or the add-on is disabled."""
    while _works:
        _works.pop().end()


def register() -> None:
    atexit.register(end_all_works)


def unregister() -> None:
    atexit.unregister(end_all_works)
    end_all_works()
