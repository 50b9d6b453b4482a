"""A thread that does the latest thing it was asked for. It knows neither Blender nor the solver."""
import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Request = TypeVar("Request")
Outcome = TypeVar("Outcome")


class Worker(Generic[Request, Outcome]):
    """Requests that were overtaken are never begun; of the outcomes only the latest is kept for the one who asks."""

    def __init__(self, work: Callable[[Request], Outcome]) -> None:
        self._work = work
        self._changed = threading.Condition()
        self._request: Request | None = None
        self._outcome: Outcome | None = None
        self._busy = self._stopped = False
        self._thread = threading.Thread(target=self._run, name="reflection lines")
        self._thread.start()

    def submit(self, request: Request) -> None:
        with self._changed:
            self._request = request
            self._changed.notify()

    def take(self) -> Outcome | None:
        with self._changed:
            outcome, self._outcome = self._outcome, None
            return outcome

    def idle(self) -> bool:
        with self._changed:
            return self._request is None and not self._busy

    def alive(self) -> bool:
        """False after an error in the work, which Python has then printed."""
        return self._thread.is_alive()

    def stop(self) -> None:
        """Ends the thread after what it is doing now."""
        with self._changed:
            self._stopped = True
            self._changed.notify()

    def _next(self) -> Request | None:
        with self._changed:
            self._busy = False
            self._changed.wait_for(lambda: self._stopped or self._request is not None)
            request, self._request = self._request, None
            self._busy = not self._stopped
            return request if self._busy else None

    def _run(self) -> None:
        while (request := self._next()) is not None:
            outcome = self._work(request)
            with self._changed:
                self._outcome = outcome
