"""Normals fitted to the surfaces that are shown; those of large surfaces in a thread, while rough ones are drawn."""
import threading
import time
from dataclasses import dataclass, field

import numpy as np

from .. import native
from . import stripes

REFIT_ANGLE = 0.005  # radians a normal may turn before its fit is made anew: a twentieth of the usual stripes' period
AT_ONCE = 8000       # vertices that are fitted within 100 ms on one slow core
AGAIN = 0.3          # seconds between the starts of two fits of a surface that moves
FIT_RINGS = 3        # triangles further away have no part in a normal


@dataclass
class Fit:
    """Normals (#V x 3) of a surface, and the native fit that made them; None where the mesh is too broken for one."""
    V: np.ndarray
    F: np.ndarray
    normals: np.ndarray
    native_fit: object | None


@dataclass
class Job:
    """A fit on its way, of the surface V."""
    V: np.ndarray
    thread: threading.Thread
    result: list = field(default_factory=list)


class Fits:
    """By the name of the object. One job a name at a time; while the surface moves the kept fit follows it."""

    def __init__(self) -> None:
        self.done: dict[str, Fit] = {}
        self.jobs: dict[str, Job] = {}
        self.wanted: dict[str, tuple[np.ndarray, np.ndarray]] = {}  # surfaces that are to be fitted, soon
        self.started: dict[str, float] = {}

    def normals(self, name: str, V: np.ndarray, F: np.ndarray) -> np.ndarray:
        """#V x 3, the best there are now; `finished` tells when better ones have come."""
        self.collect(name)
        old = self.done.get(name)
        alike = old is not None and len(old.V) == len(V) and np.array_equal(old.F, F)
        if alike and np.array_equal(old.V, V):
            return old.normals
        if len(V) <= AT_ONCE and name not in self.jobs:
            self.done[name] = fitted(V, F, old if alike else None)
            return self.done[name].normals
        if name not in self.jobs or not np.array_equal(self.jobs[name].V, V):
            self.wanted[name] = V, F
            self.advance()
        follows = alike and old.native_fit is not None
        return old.native_fit.kept_normals(V) if follows else stripes.area_normals(V, F)

    def advance(self) -> None:
        """Starts what is wanted, not too often: a fit that comes in the middle of a drag costs a redraw."""
        for name in [name for name in self.wanted if name not in self.jobs]:
            old, (V, F) = self.done.get(name), self.wanted[name]
            alike = old is not None and len(old.V) == len(V) and np.array_equal(old.F, F)
            if not alike or time.monotonic() - self.started.get(name, 0.0) > AGAIN:
                self.start(name, V, F, old if alike else None)

    def start(self, name: str, V: np.ndarray, F: np.ndarray, old: Fit | None) -> None:
        """No daemon: Blender waits for it when it is closed, where a killed thread could take Blender with it."""
        self.started[name] = time.monotonic()
        del self.wanted[name]
        job = Job(V, threading.Thread(target=lambda: job.result.append(fitted(V, F, old))))
        self.jobs[name] = job
        job.thread.start()

    def collect(self, name: str) -> None:
        job = self.jobs.get(name)
        if job is not None and not job.thread.is_alive():
            del self.jobs[name]
            self.done[name] = job.result[0]

    def finished(self) -> list[str]:
        """Names whose job has ended since they were last asked for."""
        return [name for name, job in self.jobs.items() if not job.thread.is_alive()]

    def is_waiting(self) -> bool:
        return bool(self.jobs or self.wanted)

    def forget(self) -> None:
        """Threads that still run end by themselves; nobody asks for what they bring."""
        for kept in (self.done, self.jobs, self.wanted, self.started):
            kept.clear()


def fitted(V: np.ndarray, F: np.ndarray, old: Fit | None) -> Fit:
    """In any thread: knows nothing of Blender. A mesh too broken to be fitted is still to be seen."""
    rough = Fit(V, F, stripes.area_normals(V, F), None)
    if not native.STATE.usable:
        return rough
    try:
        kept = old.native_fit if old is not None else None
        # A copy, since the kept one goes on following in the meantime.
        native_fit = kept.copy() if kept else native.reflines.NormalFit(V, F, refit_angle=REFIT_ANGLE)
        return Fit(V, F, native_fit.normals(V), native_fit)
    except (native.InvalidInput, native.SolverFailure):
        return rough
