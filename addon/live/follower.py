"""Follows the lattice of a scene's live warp: asks a thread for what it wants now, and shows what comes back.

While the lattice moves the panel follows by warm-started solves, as in a drag; when it rests the panel gets the shape
solved from where it began. So what is seen at rest is what Apply keeps, whichever way the lattice went.
"""
import time

import bpy
import numpy as np

from ..bridge import apply, start
from ..bridge.refusal import Refusal
from ..drag.pursuit import Outcome, Pursuit, Request
from ..solving import Solution
from ..targets.warp import Warp
from ..worker import Worker
from . import scene as about
from .scene import Ground

SAYS_BUSY = 0.3  # seconds of work after which the sidebar tells of it
REST = 0.3       # seconds without a new wish after which the panel is solved from where it began


class Follower:
    def __init__(self) -> None:
        self.problem = ""          # why the panel does not follow now, as a sentence
        self.ground: Ground | None = None
        self.wish: Warp | None = None
        self.asked: Request | None = None
        self.solution: Solution | None = None  # of the wish, solved from where the panel began
        self.stale = True          # something else than the lattice may have changed
        self.again = False         # look again as soon as the thread is idle
        self.followed = False      # shown is what was asked for, but not yet solved from where the panel began
        self.told = ""             # by the sidebars
        self.asked_at = self.busy_since = 0.0
        self.pursuit: Pursuit | None = None
        self.worker: Worker | None = None

    def look(self, scene: bpy.types.Scene) -> None:
        """Asks for what is wanted now, where that is new. Cheap, as it is called at every move of the mouse."""
        self.again = False
        try:
            ob, wish = about.subject(scene), about.wanted(scene)
            if self.problem or not self.stands(scene, ob):
                about.refuse_changed(ob)
                self.begin(scene, ob)
        except Refusal as refusal:
            self.problem, self.wish, self.followed = str(refusal), None, False
            return
        if not self.again and not wish.same(self.wish):
            self.wish = wish
            self.ask(scene, final=False)

    def stands(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> bool:
        """Whether the thread works on the panel as it is now."""
        return (not self.stale and self.worker.alive()
                and self.ground.signs == about.signs(scene, ob, self.ground.panel.center))

    def begin(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        """Puts the thread to work on the panel as it is now; later where it is still busy with another."""
        if self.stands(scene, ob):
            return
        if self.is_busy():
            self.again = True
            return
        ground, self.wish = about.ground(scene, ob), None
        if self.ground is None or not self.worker.alive() or not ground.serves(self.ground):
            self.stop()
            self.pursuit = Pursuit([ground.panel], [ground.view], ground.border)
            self.worker = Worker(self.pursuit.run, self.pursuit.end)
        self.ground, self.stale = ground, False

    def ask(self, scene: bpy.types.Scene, *, final: bool) -> None:
        self.asked_at = time.monotonic()
        if not self.is_busy():
            self.busy_since = self.asked_at
        elif self.asked.final:
            self.pursuit.progress.cancel()  # it takes long, and nobody wants it any more
        self.solution, self.followed = None, False
        self.asked = Request((about.build(self.wish),), about.solve_settings(scene), final)
        self.worker.submit(self.asked)

    def tick(self, scene: bpy.types.Scene) -> bool:
        """Takes what the thread has; whether there is more to come."""
        if self.worker is None:
            return False
        outcome = self.worker.take()
        if outcome is not None and not self.again:
            self.take(scene, outcome)
        elif outcome is None and not self.worker.alive():
            self.problem = "The solver stopped: apply or discard what is there"
        if self.again and not self.is_busy():
            self.look(scene)
        if self.followed and time.monotonic() - self.asked_at > REST:
            self.ask(scene, final=True)
        return self.has_more()

    def has_more(self) -> bool:
        """Whether something is still to be asked, solved or shown."""
        return self.again or self.followed or self.is_busy() or self.worker is not None and self.worker.has_outcome()

    def is_busy(self) -> bool:
        return self.worker is not None and self.worker.alive() and not self.worker.idle()

    def take(self, scene: bpy.types.Scene, outcome: Outcome) -> None:
        latest = outcome.request is self.asked
        if self.wish is None or not latest and (outcome.refusal or outcome.request.final):
            return
        try:
            if outcome.refusal:
                raise Refusal(outcome.refusal)
            self.write(about.subject(scene), outcome.positions[0])
        except Refusal as refusal:
            self.problem = str(refusal)
            return
        self.problem = ""
        self.solution = outcome.solutions[0] if outcome.solutions else None
        self.followed = latest and not self.asked.final

    def write(self, ob: bpy.types.Object, positions: np.ndarray) -> None:
        about.refuse_changed(ob)
        panel = self.ground.panel
        apply.show(ob, panel, apply.local(panel, positions), apply.now(ob, panel))
        start.leave(ob)

    def is_settled(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> bool:
        """Whether the mesh has the shape that is to be kept."""
        return self.solution is not None and self.stands(scene, ob) and about.wanted(scene).same(self.wish)

    def says(self) -> str:
        """Why the panel does not follow, or what takes long."""
        working = self.is_busy() and time.monotonic() - self.busy_since > SAYS_BUSY
        return self.problem or (self.pursuit.doing() if working else "")

    def stop(self) -> None:
        """The thread ends after what it is doing now."""
        if self.worker is None:
            return
        if self.worker.idle():
            self.pursuit.give_back()
        self.worker.stop()
        self.worker = self.pursuit = self.ground = self.asked = None
        self.followed = False
