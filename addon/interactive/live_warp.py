"""The live warp: the mesh follows its lattice while that is edited with Blender's own tools.

While the lattice moves, the mesh follows by warm-started solves, as in a drag; when it rests, the shape is solved from
the start. So the shape at rest is what Apply keeps, whatever path the lattice took.
"""
import time
from functools import partial

import bpy
import numpy as np

from ..background_work import BackgroundWork
from ..model.refusal import Refusal
from ..model.same import are_same
from ..model.solution import Solution
from ..read import read_mesh
from ..targets.warp import Warp, build_warp_target
from ..write import live_warp_start, write_mesh
from . import live_baseline
from .live_baseline import Baseline
from .solve_job import SolveJob, SolveOutcome, SolveRequest

SAYS_BUSY = 0.3  # seconds of work after which the sidebar shows the stage
REST_TIME = 0.3  # seconds without a new warp after which it is solved from the start


class LiveWarp:
    """The state of one scene's live warp: its requests to the background work, and the results."""

    def __init__(self) -> None:
        self.problem = ""  # why the mesh does not follow now, as a sentence
        self.baseline: Baseline | None = None
        self.warp: Warp | None = None
        self.request: SolveRequest | None = None
        self.solution: Solution | None = None  # of `warp`, solved from the start
        self.stale = True  # something else than the lattice may have changed
        self.recheck = False  # whether to check the lattice again once the work is idle
        self.needs_final = False  # whether the shape shown is warm-started, not yet solved from the start
        self.shown_text = ""  # the state that the sidebars show
        self.requested_at = self.busy_since = 0.0
        self.job: SolveJob | None = None
        self.work: BackgroundWork | None = None

    def check_lattice(self, scene: bpy.types.Scene) -> None:
        """Submits a request where the lattice or the baseline has changed. Cheap, since every move of the mouse calls
        it.
        """
        self.recheck = False
        try:
            ob, warp = live_baseline.find_subject(scene), live_baseline.read_warp(scene)
            if self.problem or not self.is_current(scene, ob):
                live_baseline.refuse_changed(ob)
                self.begin(scene, ob)
        except Refusal as refusal:
            self.problem, self.warp, self.needs_final = str(refusal), None, False
            return
        if not self.recheck and not are_same(warp, self.warp):
            self.warp = warp
            self.submit_request(scene, final=False)

    def is_current(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> bool:
        """Returns whether the work's optimizers are built for the mesh as it is now."""
        return (not self.stale and self.work.is_alive()
                and self.baseline.signs == live_baseline.read_signs(scene, ob, self.baseline.patch.center))

    def begin(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        """Builds a job for the mesh as it is now; postpones that while the work is busy."""
        if self.is_current(scene, ob):
            return
        if self.is_busy():
            self.recheck = True
            return
        baseline, old, self.warp = live_baseline.read_baseline(scene, ob), self.baseline, None
        serves = old is not None and baseline.signs == old.signs and baseline.patch.same(old.patch)
        if not serves or not self.work.is_alive():
            self.stop()
            self.job = SolveJob([baseline.patch], [baseline.view], baseline.border)
            self.work = BackgroundWork(self.job.run, self.job.cancel)
        self.baseline, self.stale = baseline, False

    def submit_request(self, scene: bpy.types.Scene, *, final: bool) -> None:
        """Submits the present warp, cancelling a final solve that is out of date."""
        self.requested_at = time.monotonic()
        if not self.is_busy():
            self.busy_since = self.requested_at
        elif self.request.final:
            self.job.progress.cancel()  # a long solve whose result is out of date
        self.solution, self.needs_final = None, False
        settings = live_baseline.read_solve_settings(scene, final=final)
        self.request = SolveRequest((partial(build_warp_target, settings=self.warp),), (settings,), final)
        self.work.submit(self.request)

    def advance(self, scene: bpy.types.Scene) -> bool:
        """Takes what the work has finished, and requests the final solve after a rest; returns whether work is left.
        """
        if self.work is None:
            return False
        outcome = self.work.take()
        if outcome is not None and not self.recheck:
            self.take_outcome(scene, outcome)
        elif outcome is None and not self.work.is_alive():
            self.problem = "The solver stopped: apply or discard what is there"
        if self.recheck and not self.is_busy():
            self.check_lattice(scene)
        if self.needs_final and time.monotonic() - self.requested_at > REST_TIME:
            self.submit_request(scene, final=True)
        return self.has_work()

    def has_work(self) -> bool:
        """Returns whether something is left to submit, to solve or to show."""
        return (self.recheck or self.needs_final or self.is_busy()
                or self.work is not None and self.work.has_outcome())

    def is_busy(self) -> bool:
        return self.work is not None and self.work.is_alive() and not self.work.is_idle()

    def take_outcome(self, scene: bpy.types.Scene, outcome: SolveOutcome) -> None:
        latest = outcome.request is self.request
        if self.warp is None or not latest and (outcome.refusal or outcome.request.final):
            return
        try:
            if outcome.refusal:
                raise Refusal(outcome.refusal)
            self.write_positions(live_baseline.find_subject(scene), outcome.positions[0])
        except Refusal as refusal:
            self.problem = str(refusal)
            return
        self.problem = ""
        self.solution = outcome.solutions[0] if outcome.solutions else None
        self.needs_final = latest and not self.request.final

    def write_positions(self, ob: bpy.types.Object, positions: np.ndarray) -> None:
        """Writes positions into the mesh, and marks them as the live warp's own."""
        live_baseline.refuse_changed(ob)
        patch = self.baseline.patch
        old = read_mesh.read_patch_positions(ob, patch)
        write_mesh.write_positions(ob, patch, patch.to_object_space(positions), old)
        live_warp_start.store_mark(ob)

    def is_settled(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> bool:
        """Returns whether the mesh has the shape that Apply keeps."""
        return (self.solution is not None and self.is_current(scene, ob)
                and are_same(live_baseline.read_warp(scene), self.warp))

    def describe_state(self) -> str:
        """Describes why the mesh does not follow, or which long stage runs; else empty."""
        working = self.is_busy() and time.monotonic() - self.busy_since > SAYS_BUSY
        return self.problem or (self.job.describe_stage() if working else "")

    def stop(self) -> None:
        """Ends the work after its native call, and returns idle optimizers to the cache."""
        if self.work is None:
            return
        if self.work.is_idle():
            self.job.return_optimizers()
        self.work.stop()
        self.work = self.job = self.baseline = self.request = None
        self.needs_final = False
