"""The panels of one drag in the hands of the solver. Called from a thread: numpy and the native module only.

Every panel has two optimizers. The first stays where the mesh was when the drag began: what a tool wants is said about
those lines. The second follows the mouse, each solve from where the last one ended, which takes a few back
substitutions instead of a factorization. The result that is kept is the first one's, solved from the start as without a
mouse: the way that the mouse took leaves no trace in it.
"""
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import native, session, solving
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..bridge.view import View
from ..solving import BuildTarget, Live, Settings, Solution

FOLLOWED = 1e-4  # of the gradient that a move of the mouse makes; 1e-2 leaves 4e-5 of the size after a closed path


@dataclass(frozen=True)
class Request:
    """What is wanted of each panel now."""
    builds: tuple[BuildTarget, ...]
    settings: Settings
    final: bool = False  # the result that is to be kept


@dataclass(frozen=True)
class Outcome:
    request: Request
    positions: tuple[np.ndarray, ...] = ()  # #V x 3 of each panel, world space
    solutions: tuple[Solution, ...] = ()    # of a final request
    refusal: str = ""                       # why there are none, as a sentence


class Pursuit:
    def __init__(self, panels: Sequence[Panel], views: Sequence[View], border: str) -> None:
        self.panels, self.views, self.border = tuple(panels), tuple(views), border
        self.starts: list[Live | None] = [session.lend(*about, border) for about in zip(panels, views, strict=True)]
        self.followers: list[object] = []
        self.progress = native.reflines.Progress()
        self.stage = "Preparing"
        self.over = False

    @property
    def ready(self) -> bool:
        """All that takes long has been done once."""
        return len(self.followers) == len(self.panels)

    def doing(self) -> str:
        """For the status bar."""
        inner = self.progress.stage
        return f"{self.stage} {self.progress.fraction:.0%}" + (f" ({inner})" if inner else "")

    def end(self) -> None:
        """Nothing is begun any more, and what runs ends at its next look. To end only that, cancel the progress."""
        self.over = True
        self.progress.cancel()

    def run(self, request: Request) -> Outcome:
        self.progress = native.reflines.Progress()
        if self.over:
            self.progress.cancel()
        try:
            self.prepare()
            return self.finished(request) if request.final else self.followed(request)
        except Refusal as refusal:
            return Outcome(request, refusal=str(refusal))
        except native.Cancelled as cancelled:
            return Outcome(request, refusal=str(cancelled))

    def prepare(self) -> None:
        for start in self.starts:
            if start is not None:
                start.optimizer.watch(self.progress)
        while not self.ready:
            which = len(self.followers)
            panel, seen = self.panels[which], self.views[which]
            with solving.refusing(panel):
                if self.starts[which] is None:
                    self.starts[which] = solving.built(panel, seen, self.border, self.progress)
                follower = solving.built(panel, seen, self.border, self.progress, to_follow=True)
                self.followers.append(follower.optimizer)

    def followed(self, request: Request) -> Outcome:
        self.stage = "Following"
        positions = []
        every = zip(self.panels, self.starts, self.followers, request.builds, strict=True)
        for panel, start, follower, build in every:
            with solving.refusing(panel):
                follower.solve(solving.target_of(start, build), gradient_tolerance=FOLLOWED, progress=self.progress)
                positions.append(solving.positions_of(panel, start.view, follower))
        return Outcome(request, tuple(positions))

    def finished(self, request: Request) -> Outcome:
        self.stage = "Solving from the start"
        solutions = []
        for start, build in zip(self.starts, request.builds, strict=True):
            start.optimizer.reset()
            with solving.refusing(start.panel):
                solutions.append(solving.solved(start, build, request.settings, self.progress))
            start.optimizer.reset()  # the next target is about the lines at the start too
        return Outcome(request, tuple(solution.positions for solution in solutions), tuple(solutions))

    def give_back(self) -> None:
        """For the redo panel and the next drag; only while no thread is at work."""
        for start in self.starts:
            if start is not None:
                session.take_back(start)
        session.keep_few({panel.name for panel in self.panels})
