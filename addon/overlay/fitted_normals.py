"""Normals fitted to the surfaces shown, separately on each side of a crease, across which a fit would bend the lines.

Small surfaces are fitted at once, large ones in the background while estimated normals are drawn.
"""
import time
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..background_work import BackgroundWork
from ..model.triangulation import compute_area_normals
from ..native_call import call, run_now

REFIT_ANGLE = 0.005  # radians a normal may turn before it is fitted again: a twentieth of the default stripes' period
FIT_AT_ONCE = 8000  # vertices that are fitted within 100 ms on one slow core
REFIT_INTERVAL = 0.3  # seconds between the starts of two fits of a surface that moves
FIT_RINGS = 5  # rings of triangles that a normal depends on: 3 of its fit, 1 of its start, 1 of their areas


@dataclass(frozen=True)
class ShadedSurface:
    """A surface cut open along its creases."""
    F: np.ndarray        # #F x 3: triangles of split vertices
    vertex: np.ndarray   # #S: the vertex of the surface that each was
    normals: np.ndarray  # #S x 3


@dataclass
class FittedSurface:
    """The fitted normals of a surface, with the native fit; None where the mesh is too broken for one."""
    V: np.ndarray
    F: np.ndarray
    shaded: ShadedSurface
    native_fit: "native.NormalFit | None"


@dataclass
class FitJob:
    """A surface to fit for the object with this full name, and the fit to start from."""
    name: str
    V: np.ndarray
    F: np.ndarray
    old: FittedSurface | None


class FittedNormals:
    """The fits by object name. One job runs at a time; while the surface moves, the kept fit follows it."""

    def __init__(self) -> None:
        self.done: dict[str, FittedSurface] = {}
        self.wanted: dict[str, tuple[np.ndarray, np.ndarray]] = {}  # surfaces waiting for a fit
        self.started: dict[str, float] = {}
        self.job: FitJob | None = None
        self.obsolete = False  # whether the running job's result is to be ignored
        self.work: BackgroundWork[FitJob, FittedSurface] | None = None

    def update_shaded(self, name: str, V: np.ndarray, F: np.ndarray) -> ShadedSurface:
        """Returns the surface with the best normals known now, and starts a fit where they are out of date;
        `take_finished` tells of better ones.
        """
        old = self.find_alike(name, V, F)
        if old is not None and np.array_equal(old.V, V):  # a fit begun on a way there and back is obsolete
            self.wanted.pop(name, None)
            self.obsolete |= self.is_fitting(name)
            return old.shaded
        if not native.STATE.usable:
            return estimate_normals(V, F)
        if len(V) <= FIT_AT_ONCE and not self.is_fitting(name):
            self.done[name] = run_now(fit_normals(V, F, old))
            return self.done[name].shaded
        if self.is_fitting(name) and np.array_equal(self.job.V, V):
            self.obsolete = False
        else:
            self.wanted[name] = V, F
            self.advance()
        if old is None or old.native_fit is None:
            return estimate_normals(V, F)
        return replace(old.shaded, normals=old.native_fit.kept_normals(V[old.shaded.vertex]))

    def find_alike(self, name: str, V: np.ndarray, F: np.ndarray) -> FittedSurface | None:
        """Returns the fit of the object where its surface had the same triangles."""
        old = self.done.get(name)
        return old if old is not None and len(old.V) == len(V) and np.array_equal(old.F, F) else None

    def is_fitting(self, name: str) -> bool:
        """Returns whether the running job is of this object."""
        return self.job is not None and self.job.name == name

    def advance(self) -> None:
        """Starts the next job, but not too often: a fit that ends in the middle of a drag costs a redraw."""
        for name, (V, F) in self.wanted.items():
            old = self.find_alike(name, V, F)
            if self.job is None and (old is None or time.monotonic() - self.started.get(name, 0.0) > REFIT_INTERVAL):
                self.start_job(FitJob(name, V, F, old))
                return

    def start_job(self, job: FitJob) -> None:
        self.started[job.name], self.job, self.obsolete = time.monotonic(), job, False
        del self.wanted[job.name]
        self.work = self.work or BackgroundWork(lambda job: fit_normals(job.V, job.F, job.old))
        self.work.submit(job)

    def take_finished(self) -> str | None:
        """Stores the fit of a job that has ended and returns its name once, else None."""
        if self.job is None:
            return None
        job, fit = self.job, self.work.take()
        if not self.work.is_alive():
            fit, self.work = skip_fit(job.V, job.F), None
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
        self.obsolete |= self.is_fitting(name)
        for kept in (self.done, self.wanted, self.started):
            kept.pop(name, None)

    def clear(self) -> None:
        """Drops all fits; the result of a running job is ignored."""
        if self.work is not None:
            self.work.stop()
        self.job = self.work = None
        for kept in (self.done, self.wanted, self.started):
            kept.clear()


async def fit_normals(V: np.ndarray, F: np.ndarray, old: FittedSurface | None) -> FittedSurface:
    """Fits normals, without Blender; a mesh too broken for a fit gets estimated ones."""
    try:
        split, vertex = await call(native.reflines.split_at_creases, V, F)
        points = V[vertex]
        if old is not None and old.native_fit is not None and np.array_equal(old.shaded.F, split):
            native_fit = await call(old.native_fit.copy)  # the kept fit goes on following the surface meanwhile
        else:
            native_fit = await call(native.reflines.NormalFit.create, points, split, refit_angle=REFIT_ANGLE)
        normals = await call(native_fit.normals, points)
        return FittedSurface(V, F, ShadedSurface(split, vertex, normals), native_fit)
    except (native.InvalidInput, native.SolverFailure):
        return skip_fit(V, F)


def skip_fit(V: np.ndarray, F: np.ndarray) -> FittedSurface:
    """Returns estimated normals in the place of a fit."""
    return FittedSurface(V, F, estimate_normals(V, F), None)


def estimate_normals(V: np.ndarray, F: np.ndarray) -> ShadedSurface:
    """Returns area-weighted vertex normals without creases, as Blender's own: fast and rough."""
    return ShadedSurface(F, np.arange(len(V)), compute_area_normals(V, F))
