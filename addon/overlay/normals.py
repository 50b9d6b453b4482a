"""Normals fitted to the surfaces that are shown; those of large surfaces in a thread, while rough ones are drawn."""
import threading
from dataclasses import dataclass, field

import numpy as np

from .. import native
from . import stripes

REFIT_ANGLE = 0.005  # radians a normal may turn before its fit is made anew: a twentieth of the usual stripes' period
AT_ONCE = 8000       # vertices that are fitted within 100 ms on one slow core
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
    """A fit on its way."""
    thread: threading.Thread
    result: list = field(default_factory=list)


class Fits:
    """By the name of the object. One job a name: when it ends and the surface has changed since, the next begins."""

    def __init__(self) -> None:
        self.done: dict[str, Fit] = {}
        self.jobs: dict[str, Job] = {}

    def normals(self, name: str, V: np.ndarray, F: np.ndarray) -> np.ndarray:
        """#V x 3, the best there are now; `finished` tells when better ones have come."""
        self.collect(name)
        old = self.done.get(name)
        alike = old is not None and np.array_equal(old.F, F)
        if alike and np.array_equal(old.V, V):
            return old.normals
        if name not in self.jobs:
            if len(V) <= AT_ONCE:
                self.done[name] = fitted(V, F, old if alike else None)
                return self.done[name].normals
            self.start(name, V, F, old if alike else None)
        return old.normals if alike else stripes.area_normals(V, F)

    def start(self, name: str, V: np.ndarray, F: np.ndarray, old: Fit | None) -> None:
        job = Job(threading.Thread(target=lambda: job.result.append(fitted(V, F, old)), daemon=True))
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

    def forget(self) -> None:
        """Threads that still run end by themselves; nobody asks for what they bring."""
        self.done.clear()
        self.jobs.clear()


def fitted(V: np.ndarray, F: np.ndarray, old: Fit | None) -> Fit:
    """In any thread: knows nothing of Blender. A mesh too broken to be fitted is still to be seen."""
    rough = Fit(V, F, stripes.area_normals(V, F), None)
    if not native.STATE.usable:
        return rough
    try:
        native_fit = old.native_fit if old is not None else None
        if native_fit is None:
            native_fit = native.reflines.NormalFit(V, F, refit_angle=REFIT_ANGLE)
        return Fit(V, F, native_fit.normals(V), native_fit)
    except (native.InvalidInput, native.SolverFailure):
        return rough
