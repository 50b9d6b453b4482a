"""The solves of a drag or a live warp in the background: numpy and the native module only.

The automatic press of Smooth is dragged by its kept smoother, which needs neither of the optimizers below.

Every patch has two optimizers. The first keeps the heights of the start: targets are built from its lines. The second
follows the mouse, warm-started from its last solution, which takes a few back substitutions instead of a factorization.
The final result is solved by the first from the start, so it does not depend on the path of the mouse.
"""
import time
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from .. import native
from ..model.gain import Gain, Healed, join_healed
from ..model.joined_patch import split_positions, split_solution
from ..model.line_surface import LineState
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import Solution, SolveSettings
from ..model.view import View
from ..native_call import call
from ..solver import live_optimizer, solve
from ..solver.automatic_smooth import AutomaticSmooth, preview_press
from ..solver.limited_solve import choose_limit, clip_to_ranges
from ..solver.live_optimizer import BuildTarget, LiveOptimizer
from ..solver.read_solved import read_lines, read_positions
from ..state import optimizer_cache, press_cache

# Seconds. A gain that takes longer to measure is measured when the mouse rests, so that the panel follows at once.
MEASURE_BUDGET = 0.03


# Moves the second optimizer as the targets of the first want it, without a solve; returns False where it cannot.
Follow = Callable[..., Awaitable[bool]]


@dataclass(frozen=True)
class SolveRequest:
    """The wanted target and the settings of each patch."""
    builds: tuple[BuildTarget, ...]
    settings: tuple[SolveSettings, ...]
    final: bool = False    # whether the result is kept, so solved from the start
    measure: bool = False  # only the gain of the last solution is wanted
    press: AutomaticSmooth | None = None  # the automatic press of Smooth instead of the builds, also in a drag
    lines: bool = False    # whether the outcome has the lines, instead of the gain
    follows: tuple[Follow, ...] = ()  # ways to follow each patch's target; empty: by solves alone


@dataclass(frozen=True)
class SolveOutcome:
    """The positions that solve a request, or the reason why there are none."""
    request: SolveRequest
    positions: tuple[np.ndarray, ...] = ()  # #V x 3 of each panel, world space, those of joined patches after another
    solutions: tuple[Solution, ...] = ()    # results of a final request
    refusal: str = ""                       # why there are none, as a sentence
    gain: "Gain | Healed | None" = None     # of all panels together, where it was measured
    lines: tuple[LineState, ...] = ()       # of each panel, where they are wanted
    refused: Mapping[str, Refusal] = field(default_factory=dict)  # by name: why some of several have no result


class SolveJob:
    """The optimizers of the patches, and the progress of what they do."""

    def __init__(self, patches: Sequence[Patch], views: Sequence[View], border: str) -> None:
        self.patches, self.views, self.border = tuple(patches), tuple(views), border
        self.starts: list[LiveOptimizer | None] = [optimizer_cache.take_optimizer(patch, seen, border)
                                                   for patch, seen in zip(patches, views, strict=True)]
        self.followers: list[native.ShapeOptimizer] = []
        self.progress = native.reflines.Progress()
        self.stage = "Preparing"
        self.cancelled = False
        self.pressed = False  # whether a press has found the flaws
        self.measure_seconds = 0.0  # of the last measurement
        self.start_lines: tuple[LineState, ...] = ()  # once a request has wanted lines

    @property
    def ready(self) -> bool:
        """True once all is built that the values can be changed with."""
        return self.pressed or len(self.followers) == len(self.patches)

    def describe_stage(self) -> str:
        """Describes the present stage and its progress for the status bar."""
        inner = self.progress.stage
        return f"{self.stage} {self.progress.fraction:.0%}" + (f" ({inner})" if inner else "")

    def cancel(self) -> None:
        """Cancels the running request and every later one. To cancel the running one only, cancel `progress`."""
        self.cancelled = True
        self.progress.cancel()

    async def run(self, request: SolveRequest) -> SolveOutcome:
        """Serves a request in the background; refusals and cancellation become the outcome's text."""
        self.progress = native.reflines.Progress()
        if self.cancelled:
            self.progress.cancel()
        try:
            if request.press is not None:
                return await self.press(request)
            await self.prepare(following=not request.final)
            if request.measure:
                return SolveOutcome(request, gain=await self.measure(request))
            return await (self.solve_from_start(request) if request.final else self.follow(request))
        except Refusal as refusal:
            return SolveOutcome(request, refusal=str(refusal))
        except native.Cancelled as cancelled:
            return SolveOutcome(request, refusal=str(cancelled))

    async def prepare(self, *, following: bool) -> None:
        """Builds the optimizers that are missing: those that follow the mouse only for a drag."""
        for which, (patch, seen) in enumerate(zip(self.patches, self.views, strict=True)):
            with live_optimizer.convert_native_errors(patch):
                if self.starts[which] is None:
                    self.starts[which] = await live_optimizer.build_optimizer(patch, seen, self.border, self.progress)
                self.starts[which].optimizer.watch(self.progress)
                if following and len(self.followers) == which:
                    follower = await live_optimizer.build_optimizer(patch, seen, self.border, self.progress,
                                                                    to_follow=True)
                    self.followers.append(follower.optimizer)

    async def press(self, request: SolveRequest) -> SolveOutcome:
        """Presses Smooth on every patch. A drag shows the positions before they are measured."""
        self.stage = "Smoothing"
        if request.final or len(self.patches) > 1:  # several may be one problem, which has no preview
            return await self.press_and_measure(request)
        previews = [await press_cache.press_with_cache(preview_press, patch, seen, self.border, request.press,
                                                        self.progress)
                    for patch, seen in zip(self.patches, self.views, strict=True)]
        self.pressed = True
        shown = SolveOutcome(request, tuple(positions for positions, _ in previews),
                             refusal=" ".join(filter(None, (refusal for _, refusal in previews))))
        if shown.refusal or self.measure_seconds >= MEASURE_BUDGET and not request.measure:
            return shown
        begin = time.perf_counter()
        measured = await self.press_and_measure(request)
        self.measure_seconds = time.perf_counter() - begin
        return measured

    async def press_and_measure(self, request: SolveRequest) -> SolveOutcome:
        """Presses Smooth on every patch, on those that face each other as one problem."""
        outcomes = await press_cache.smooth_all(self.patches, self.views, self.border, request.press, self.progress)
        refused = {patch.name: each for patch, each in zip(self.patches, outcomes, strict=True)
                   if isinstance(each, Refusal)}
        solutions = tuple(each for each in outcomes if not isinstance(each, Refusal))
        if not solutions:
            raise next(iter(refused.values()))
        positions = tuple(solution.positions for solution in solutions)
        if request.final:
            return SolveOutcome(request, positions, solutions, refused=refused)
        if refused:  # a drag moves all of its panels
            raise next(iter(refused.values()))
        self.pressed = True
        left = [solution.report.message for solution in solutions if solution.report.termination == "not_applied"]
        return SolveOutcome(request, positions, refusal=" ".join(left),
                            gain=join_healed([solution.healed for solution in solutions],
                                             [solution.patch.measure_area() for solution in solutions]))

    async def follow(self, request: SolveRequest) -> SolveOutcome:
        """Solves warm-started from the last solution, to the targets' tolerance."""
        self.stage = "Following"
        positions = []
        for which, (patch, start, follower) in enumerate(zip(self.patches, self.starts, self.followers, strict=True)):
            with live_optimizer.convert_native_errors(patch):
                if not await self.follow_without_solve(request, which):
                    wanted = await live_optimizer.build_targets(start, request.builds[which],
                                                                request.settings[which])
                    await call(follower.solve, wanted.targets, gradient_tolerance=wanted.follow_tolerance,
                               progress=self.progress)
                    # Beyond the limit all moves are scaled at once; the final solve takes its time.
                    follower.keep_within(choose_limit(patch, request.settings[which]))
                    if request.lines:
                        await wanted.measure(follower)  # for the numbers of each handle
                shown = read_positions(start.problem, follower)
                limit = choose_limit(patch, request.settings[which])
                shown = clip_to_ranges(patch, start.problem.view, shown, limit)
                positions += split_positions(patch, shown, limit)
        if request.lines:
            return SolveOutcome(request, tuple(positions), lines=await self.read_lines())
        gain = await self.measure(request) if self.measure_seconds < MEASURE_BUDGET else None
        return SolveOutcome(request, tuple(positions), gain=gain)

    async def follow_without_solve(self, request: SolveRequest, which: int) -> bool:
        """Follows a patch's target in the request's own way; returns False where there is none, or it cannot."""
        if not request.follows:
            return False
        start, follower, settings = self.starts[which], self.followers[which], request.settings[which]
        follow = request.follows[which]
        if not await follow(start.optimizer, follower, keep_crossed=settings.build_crossed is not None):
            return False
        follower.keep_within(choose_limit(start.patch, settings))
        return True

    async def read_lines(self) -> tuple[LineState, ...]:
        """Reads the lines that are followed, and once those of the start."""
        if not self.start_lines:
            self.start_lines = tuple([await read_lines(start.optimizer) for start in self.starts])
        return tuple([await read_lines(follower) for follower in self.followers])

    async def measure(self, request: SolveRequest) -> Gain:
        """Measures the present heights against those of the start, by the numbers that the result is reported by."""
        begin = time.perf_counter()
        numbers = []
        every = zip(self.patches, self.starts, self.followers, request.builds, request.settings, strict=True)
        for patch, start, follower, build, settings in every:
            with live_optimizer.convert_native_errors(patch):
                wanted = await live_optimizer.build_targets(start, build, settings)
                length = solve.choose_length(patch, settings.length)
                scores = [await call(each.score, length) for each in (start.optimizer, follower)]
                numbers.append((*(score.shift for score in scores),
                                await wanted.measure(start.optimizer), await wanted.measure(follower), length))
        self.measure_seconds = time.perf_counter() - begin
        return Gain(*np.sqrt(np.mean(np.square(numbers), axis=0)).tolist())

    async def solve_from_start(self, request: SolveRequest) -> SolveOutcome:
        """Solves from the heights of the start, and measures the result."""
        self.stage = "Solving from the start"
        solutions = []
        for start, build, settings in zip(self.starts, request.builds, request.settings, strict=True):
            start.optimizer.reset()
            try:
                with live_optimizer.convert_native_errors(start.patch):
                    solution = await solve.solve_patch(start, build, settings, self.progress)
                    solutions += split_solution(solution, settings.limit)
            finally:
                start.optimizer.reset()  # the next target is built from the start's lines too, even after a failure
        return SolveOutcome(request, tuple(solution.positions for solution in solutions), tuple(solutions))

    def return_optimizers(self) -> None:
        """Returns the optimizers to the cache, for the redo panel and the next drag; only while no work runs."""
        for start in self.starts:
            if start is not None:
                optimizer_cache.return_optimizer(start)
        names = {panel.name for patch in self.patches for panel in patch.panels}
        optimizer_cache.drop_surplus(names)
        press_cache.keep_only(names)
