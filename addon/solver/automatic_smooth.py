"""The automatic press of Smooth: the native rules find the flaws of a patch and leave its design alone."""
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..model.gain import Healed, Worse
from ..model.light_set import LightSet
from ..model.patch import Patch
from ..model.same import are_same
from ..model.solution import SolveReport, Solution
from ..model.view import View
from ..native_call import call
from . import live_optimizer, remarks
from .build_native import build_smoother
from .native_notes import word_note, word_notes
from .panel_problem import PanelProblem, pose_problem
from .read_solved import read_on_triangles, read_own

MOST_NOTES = 2
WIDER = 1.05  # than what the native press takes in: its diagonal is that of the faces that it can use


@dataclass(frozen=True)
class AutomaticSmooth:
    """The settings of the press, as the arguments of reflines.smooth_panel have them."""
    lights: str           # "crossed" or "single"
    strength: float
    symmetric: bool
    limit: float | None = None  # largest move along the view, world units; None: automatic
    flaw_size: float = 1.0      # of the automatic length
    fair_border: bool = False   # the border moves, too; see native/include/reflines/smooth_panel.h
    even_flush: bool = False    # of shut lines between panels that move, likewise
    light_set: LightSet | None = None  # takes the place of `lights`
    judges: LightSet | None = None     # lights that take no part, but tell what became worse in them

    def choose_flaws(self, patch: Patch) -> dict[str, "str | bool | float | native.LightSet | None"]:
        """Returns what tells flaws from design, as arguments of the native smoother of a patch."""
        light_set = None if self.light_set is None else self.light_set.build_argument(patch)
        judges = self.find_judges(patch)
        return {"lights": self.lights, "light_set": light_set, "symmetric": self.symmetric,
                "judges": None if judges is None else judges.build_argument(patch), "flaw_size": self.flaw_size}

    def choose_joining(self, patch: Patch) -> dict[str, "str | bool | float | native.LightSet | None"]:
        """Returns likewise the arguments of what may be joined with others or have parts."""
        return {**self.choose_flaws(patch), "even_flush": self.even_flush}

    def find_judges(self, patch: Patch) -> LightSet | None:
        """Returns the lights that judge a patch: those that show lines."""
        return None if self.judges is None else self.judges.leave_parallel(patch.center)

    def find_same(self, other: "AutomaticSmooth") -> bool:
        """Returns whether a press finds the same with other settings: all but strength and limit are the same."""
        return are_same(self, replace(other, strength=self.strength, limit=self.limit))

    def choose_margin(self) -> float:
        """Returns how far beside the region faces are needed, in diagonals of the region."""
        within = native.reflines.FAIR_MARGIN * native.reflines.AUTOMATIC_LENGTH * self.flaw_size
        return WIDER * within if self.fair_border else 0.0


@dataclass(frozen=True)
class KeptPress:
    """A native smoother of a patch, or of several as one problem, with what it was built from: another strength or
    limit costs it a tenth of the first press.
    """
    problems: tuple[PanelProblem, ...]
    border: str
    settings: AutomaticSmooth  # of the first press
    smoother: "native.PanelSmoother | native.JointSmoother"

    def suits(self, patches: Sequence[Patch], views: Sequence[View], border: str, settings: AutomaticSmooth) -> bool:
        """Returns whether the smoother serves these patches, views, border and settings."""
        return (self.border == border and self.settings.find_same(settings) and len(self.problems) == len(patches)
                and all(own.patch.same(patch) and own.patch.name == patch.name and own.view.has_same_light(view)
                        for own, patch, view in zip(self.problems, patches, views, strict=True)))

    def go_back_to(self, patches: Sequence[Patch]) -> "KeptPress":
        """Returns the same for patches whose way back to the mesh may differ, such as the shape key."""
        return replace(self, problems=tuple(pose_problem(patch, own.view)
                                            for patch, own in zip(patches, self.problems, strict=True)))


async def build_press(patch: Patch, seen: View, border: str, settings: AutomaticSmooth) -> KeptPress:
    """Builds the native smoother of a patch, which does its work in the first press; raises the native module's errors.
    """
    problem = pose_problem(patch, seen)
    flaws = settings.choose_flaws(patch) if problem.is_cage else settings.choose_joining(patch)
    smoother = await build_smoother(problem, border, flaws, fair=settings.fair_border)
    return KeptPress((problem,), border, settings, smoother)


async def preview_press(kept: KeptPress, settings: AutomaticSmooth,
                        progress: "native.Progress | None" = None) -> tuple[np.ndarray, str]:
    """Presses without measuring the result, as a drag shows it: returns the positions (#V x 3, world space), and why
    nothing was moved. Raises the native module's errors.
    """
    problem, patch = kept.problems[0], kept.problems[0].patch
    positions, report = await call(kept.smoother.press, strength=settings.strength, limit=settings.limit,
                                   limit_range=problem.limit_range, progress=progress, judged=False)
    live_optimizer.refuse_closed(patch.name, int(patch.faces.sum()), report.region.closed)
    return read_own(problem, positions), "" if report.applied else word_note(report.notes[0])


async def press_panel(kept: KeptPress, settings: AutomaticSmooth,
                      progress: "native.Progress | None" = None) -> Solution:
    """Presses once; raises the native module's errors. `progress` lets the caller watch and cancel.

    All numbers are its own: scores are means over the lights, and the residual is how far the field of the light given
    differs from its smoothed self. After a refusal both are those of the start.
    """
    begin, problem = time.perf_counter(), kept.problems[0]
    positions, report = await call(kept.smoother.press, strength=settings.strength, limit=settings.limit,
                                   limit_range=problem.limit_range, progress=progress)
    return build_solution(problem, positions, report, settings, time.perf_counter() - begin)


def build_solution(problem: PanelProblem, positions: np.ndarray, report: "native.SmoothPanelReport",
                   settings: AutomaticSmooth, seconds: float) -> Solution:
    """Builds the solution from what the native press returns for a problem."""
    patch = problem.patch
    live_optimizer.refuse_closed(patch.name, int(patch.faces.sum()), report.region.closed)
    summary = summarize(report, seconds)
    unevenness = report.unevenness_before, report.unevenness_after if report.applied else report.unevenness_before
    lacks = (np.radians(each[0]) / report.length for each in unevenness)
    scores = report.score_before, report.score_after if report.applied else report.score_before
    shifts, turns = np.mean([[(score.shift, score.turn) for score in each] for each in scores], axis=1).T.tolist()
    notes = (note for note in report.region.notes if note.kind != "unseen")  # lights are reported by their names
    return Solution(patch, read_own(problem, positions), summary, None,
                    read_on_triangles(problem, report.line_deviation), *lacks, report.length, *shifts,
                    choose_notes(problem, report, settings.light_set), report.length,
                    automatic_limit=0.0 if settings.limit else report.limit,
                    cage_move=report.largest_control_move if problem.is_cage else 0.0,
                    turn_before=turns[0], turn_after=turns[1],
                    kept=(*remarks.describe_marked_creases(patch), *word_notes(notes)),
                    healed=Healed(report.healed.area, report.healed.worst_before, report.healed.worst_after),
                    worse=find_worse(problem, settings, report), longer_waves=report.longer_waves,
                    flush=(report.flush_before, report.flush_after),
                    verdict=read_on_triangles(problem, report.verdict))


def find_worse(problem: PanelProblem, settings: AutomaticSmooth,
               report: "native.SmoothPanelReport") -> Worse | None:
    """Finds the place that a press made worse by most, in its own lights or those that judge it; None where there is
    none.
    """
    worse, length, judges = report.healed.worse, report.length, settings.find_judges(problem.patch)
    center = problem.patch.center
    if settings.light_set is not None:
        return settings.light_set.tell_worse(worse, center, length)
    own = (None if worse.light < 0 else
           Worse("the crossed light" if worse.light else "the light",
                 tuple(problem.view.both_directions[worse.light].tolist()), tuple(worse.place.tolist()), length,
                 worse.before, worse.after))
    elsewhere = None if judges is None else judges.tell_worse(report.healed.worse_for_judges, center, length)
    return max(filter(None, (own, elsewhere)), key=lambda each: each.after - each.before, default=None)


def summarize(report: "native.SmoothPanelReport", seconds: float) -> SolveReport:
    termination = report.solve.termination if report.applied else "not_applied"
    message = report.solve.message if report.applied else word_note(report.notes[0])
    move, limited = (report.largest_move, report.limited) if report.applied else (0.0, 0)
    return SolveReport(termination, message, report.solve.iterations, seconds, report.solve.unknowns, move, limited)


def choose_notes(problem: PanelProblem, report: "native.SmoothPanelReport",
                 light_set: LightSet | None) -> tuple[str, ...]:
    """Returns the most important sentences. That the limit holds vertices back stands in the headline of the result."""
    notes = [note for note in report.notes if note.kind != "limited"]
    lopsided = () if report.mirrored else remarks.describe_mirror(problem)
    lights = () if light_set is None else light_set.describe(
        report.seen, report.unevenness_before, report.unevenness_after, applied=report.applied)
    return (*word_notes(notes), *lights, *lopsided)[:MOST_NOTES]
