"""One solve of one patch, from arrays to arrays, without state and without Blender."""
import numpy as np

from .. import native
from ..model.gain import Worse
from ..model.light_set import LightSet
from ..model.patch import Patch
from ..model.solution import Solution, SolveReport, SolveSettings
from ..native_call import call
from . import live_optimizer, remarks
from .limited_solve import choose_limit, choose_ranges
from .live_optimizer import BuildTarget, LiveOptimizer
from .native_notes import word_notes
from .panel_problem import join_surroundings
from .read_solved import measure_cage_move, read_positions, read_residual

BENT = np.radians(0.5)  # radians; an edge of a calm panel that bends by as much more is seen as a crease in its stripes


def choose_length(patch: Patch, length: float) -> float:
    """Returns the length below which detail counts as a deviation: the given one, or for 0 that of the automatic press.
    """
    return length or native.reflines.AUTOMATIC_LENGTH * patch.diagonal


async def solve_patch(live: LiveOptimizer, build_target: BuildTarget, settings: SolveSettings,
                      progress: "native.Progress | None" = None) -> Solution:
    """Builds the targets, minimizes from the optimizer's present heights, and measures the result: the rules are those
    of native/include/reflines/solve_panel.h.

    `progress` lets the caller watch and cancel.
    """
    optimizer, length = live.optimizer, choose_length(live.patch, settings.length)
    wanted = await live_optimizer.build_targets(live, build_target, settings)  # that of a fit moves the optimizer first
    lacking = None if wanted.is_plain else await wanted.measure(optimizer)
    limit, problem = choose_limit(live.patch, settings), live.problem
    report = await call(native.reflines.solve_panel, optimizer, wanted.targets, length=length, limit=limit,
                        limit_range=await choose_ranges(live), around=choose_rim(live), progress=progress)
    worse = await judge(live, settings.judges, progress)
    left = report.residual_after if wanted.is_plain else await wanted.measure(optimizer)
    lacking = report.residual_before if wanted.is_plain else lacking
    summary = summarize(report)
    short = settings.explains_shortfall and wanted.is_plain and report.falls_short and not report.limited
    bend = report.rim_bend if report.rim_bend > BENT else 0.0
    return Solution(live.patch, read_positions(problem, optimizer), summary, wanted.targets[0],
                    read_residual(problem, optimizer, report.residual), lacking, left,
                    length, report.score_before.shift, report.score_after.shift,
                    (*(remarks.describe_shortfall(1.0 - left / lacking, live.border) if short else ()),
                     *remarks.describe_unfinished(summary), *remarks.describe_bent_rim(bend),
                     *remarks.describe_limit(summary.limited, limit, automatic=not settings.limit),
                     *remarks.describe_mirror(problem),
                     *remarks.describe_far_move(live.patch, summary.largest_move, live.border),
                     *remarks.describe_turned_faces(report.turned_faces)),
                    choose_length(live.patch, 0.0), choose_remedy(live.border, short=short, bent=bend > 0.0),
                    measure_cage_move(problem, optimizer), automatic_limit=0.0 if settings.limit else limit,
                    turn_before=report.score_before.turn, turn_after=report.score_after.turn, worse=worse,
                    kept=(*word_notes(optimizer.region.notes), *remarks.describe_held_faces(report.held_faces)))


async def judge(live: LiveOptimizer, judges: LightSet | None, progress: "native.Progress | None") -> Worse | None:
    """Finds what the last solve made worse in lights that took no part; None where there is nothing, or no such light.
    """
    shown = None if judges is None else judges.leave_parallel(live.patch.center)
    if shown is None:
        return None
    length = choose_length(live.patch, 0.0)
    found = await call(native.reflines.judge_solve, live.optimizer, lights=shown.build_argument(live.patch),
                       length=length, progress=progress)
    return shown.tell_worse(found, live.patch.center, length)


def summarize(report: "native.SolvePanelReport") -> SolveReport:
    solve = report.solve
    return SolveReport(solve.termination, solve.message, solve.iterations, solve.seconds, solve.unknowns,
                       solve.largest_move, report.limited)


def choose_rim(live: LiveOptimizer) -> tuple[np.ndarray, np.ndarray] | None:
    """Returns the positions and triangles that the rim of a mesh's region may bend against; the surface of a cage has
    no rim: its faces beside the region follow.
    """
    if live.problem.is_cage:
        return None
    around = join_surroundings(live.problem)
    return (around.V, around.F) if len(around.F) else None


def choose_remedy(border: str, *, short: bool, bent: bool) -> str:
    """Returns the border that would serve better: Free where too little of a target is reached, Tangent where the rim
    bends; empty where this one is good.
    """
    if short and border != "free":
        return "free"
    return "clamped" if bent and border in {"free", "fixed"} else ""

