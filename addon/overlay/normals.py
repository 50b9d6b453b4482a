"""Normals fitted to the surfaces that are shown, on each side of a crease by themselves.

Across one they would bend the lines beside it. Those of large surfaces are fitted in a thread, while rough ones are
drawn.
"""
import time
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..worker import Worker
from . import stripes

REFIT_ANGLE = 0.005  # radians a normal may turn before its fit is made anew: a twentieth of the usual stripes' period
AT_ONCE = 8000       # vertices that are fitted within 100 ms on one slow core
AGAIN = 0.3          # seconds between the starts of two fits of a surface that moves
FIT_RINGS = 5        # triangles further away have no part in a normal: 3 of its fit, 1 of its start, 1 of their areas


@dataclass(frozen=True)
class Shaded:
    """A surface cut open along its creases."""
    F: np.ndarray        # #F x 3: triangles of split vertices
    vertex: np.ndarray   # #S: the vertex of the surface that each was
    normals: np.ndarray  # #S x 3


@dataclass
class Fit:
    """Normals of a surface, and the native fit that made them; None where the mesh is too broken for one."""
    V: np.ndarray
    F: np.ndarray
    shaded: Shaded
    native_fit: object | None


@dataclass
class Job:
    """A surface to be fitted for the object with this name, and the fit to begin with."""
    name: str
    V: np.ndarray
    F: np.ndarray
    old: Fit | None


class Fits:
    """By the name of the object. One job at a time; while the surface moves the kept fit follows it."""

    def __init__(self) -> None:
        self.done: dict[str, Fit] = {}
        self.wanted: dict[str, tuple[np.ndarray, np.ndarray]] = {}  # surfaces that are to be fitted, soon
        self.started: dict[str, float] = {}
        self.job: Job | None = None
        self.obsolete = False  # the job
        self.worker: Worker[Job, Fit] | None = None

    def shaded(self, name: str, V: np.ndarray, F: np.ndarray) -> Shaded:
        """With the best normals there are now; `finished` tells when better ones have come."""
        old = self.done.get(name)
        alike = old is not None and len(old.V) == len(V) and np.array_equal(old.F, F)
        if alike and np.array_equal(old.V, V):  # also after a way there and back: what was begun on it is not wanted
            self.wanted.pop(name, None)
            self.obsolete |= self.is_at(name)
            return old.shaded
        if not native.STATE.usable:
            return smooth(V, F)
        if len(V) <= AT_ONCE and not self.is_at(name):
            self.done[name] = fitted(V, F, old if alike else None)
            return self.done[name].shaded
        if self.is_at(name) and np.array_equal(self.job.V, V):
            self.obsolete = False
        else:
            self.wanted[name] = V, F
            self.advance()
        if not alike or old.native_fit is None:
            return smooth(V, F)
        return replace(old.shaded, normals=old.native_fit.kept_normals(V[old.shaded.vertex]))

    def is_at(self, name: str) -> bool:
        return self.job is not None and self.job.name == name

    def advance(self) -> None:
        """Starts what is wanted, not too often: a fit that comes in the middle of a drag costs a redraw."""
        for name, (V, F) in self.wanted.items():
            old = self.done.get(name)
            alike = old is not None and len(old.V) == len(V) and np.array_equal(old.F, F)
            if self.job is None and (not alike or time.monotonic() - self.started.get(name, 0.0) > AGAIN):
                self.start(Job(name, V, F, old if alike else None))
                return

    def start(self, job: Job) -> None:
        self.started[job.name], self.job, self.obsolete = time.monotonic(), job, False
        del self.wanted[job.name]
        self.worker = self.worker or Worker(lambda job: fitted(job.V, job.F, job.old))
        self.worker.submit(job)

    def finished(self) -> str | None:
        """The name whose job has ended since this was last asked."""
        if self.job is None:
            return None
        job, fit = self.job, self.worker.take()
        if not self.worker.alive():
            fit, self.worker = rough(job.V, job.F), None
        if fit is None:
            return None
        self.job = None
        if self.obsolete:
            return None
        self.done[job.name] = fit
        return job.name

    def is_waiting(self) -> bool:
        return bool(self.job or self.wanted)

    def drop(self, name: str) -> None:
        self.obsolete |= self.is_at(name)
        for kept in (self.done, self.wanted, self.started):
            kept.pop(name, None)

    def forget(self) -> None:
        """Nobody asks for what a thread that still runs brings."""
        if self.worker is not None:
            self.worker.stop()
        self.job = self.worker = None
        for kept in (self.done, self.wanted, self.started):
            kept.clear()


def fitted(V: np.ndarray, F: np.ndarray, old: Fit | None) -> Fit:
    """In a thread, too: knows nothing of Blender. A mesh too broken to be fitted is still to be seen."""
    try:
        split, vertex = native.reflines.split_at_creases(V, F)
        points = V[vertex]
        if old is not None and old.native_fit is not None and np.array_equal(old.shaded.F, split):
            native_fit = old.native_fit.copy()  # since the kept one goes on following in the meantime
        else:
            native_fit = native.reflines.NormalFit(points, split, refit_angle=REFIT_ANGLE)
        return Fit(V, F, Shaded(split, vertex, native_fit.normals(points)), native_fit)
    except (native.InvalidInput, native.SolverFailure):
        return rough(V, F)


def rough(V: np.ndarray, F: np.ndarray) -> Fit:
    return Fit(V, F, smooth(V, F), None)


def smooth(V: np.ndarray, F: np.ndarray) -> Shaded:
    """Without creases, and as rough as Blender's own: what takes no time."""
    return Shaded(F, np.arange(len(V)), stripes.area_normals(V, F))
