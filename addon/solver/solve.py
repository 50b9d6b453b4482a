"""One solve of one patch, from arrays to arrays, without state and without Blender."""
import math
from dataclasses import replace

import numpy as np

from .. import native
from ..model.patch import Patch
from ..model.solution import LastSolve, Solution, SolveSettings
from ..native_call import call
from . import live_optimizer, remarks, rim, turned_faces
from .formulation import choose_formulation
from .limited_solve import choose_limit, solve_within_limit
from .live_optimizer import BuildTarget, LiveOptimizer

SMALL_SHARE = 0.2  # reached fraction of a target below which a solve explains why
SMALL_CHANGE = 0.01  # wanted change, relative to the lines' gradient, below which nothing is explained
MOST_HOLDS = 3  # times that faces are held and the rest is solved again


def choose_length(patch: Patch, length: float) -> float:
    """Returns the length below which detail counts as a deviation: the given one, or for 0 that of the automatic press.
    """
    return length or native.reflines.AUTOMATIC_LENGTH * patch.diagonal


def compute_vertex_values(solution: LastSolve) -> dict[str, np.ndarray]:
    """Computes per-vertex values (#V each) of a solve: "deviation", the distance moved, and "residual", the mean of the
    adjacent triangles', where it is known.
    """
    patch, corners = solution.patch, solution.patch.F.ravel()
    moved = np.linalg.norm(solution.positions - patch.V, axis=1)
    if len(solution.residual) != len(patch.F):
        return {"deviation": moved}
    count = np.maximum(np.bincount(corners, minlength=len(patch.V)), 1)
    return {"deviation": moved,
            "residual": np.bincount(corners, np.repeat(solution.residual, 3), minlength=len(patch.V)) / count}


async def solve_patch(live: LiveOptimizer, build_target: BuildTarget, settings: SolveSettings,
                      progress: "native.Progress | None" = None) -> Solution:
    """Builds the targets, minimizes from the optimizer's present heights, and measures the result. Faces that would
    turn far are held, and the rest is solved again.

    `progress` lets the caller watch and cancel.
    """
    solution = await solve_once(live, build_target, settings, progress)
    turned, held, count = turned_faces.find_turned(live.patch, solution.positions), np.zeros(len(live.patch.V), bool), 0
    for _ in range(MOST_HOLDS):
        more = turned_faces.find_vertices_to_hold(live.patch, turned)
        if more is None or math.isinf(settings.limit) or solution.report.termination == "cancelled":
            break
        held |= more
        firmer = await solve_held(live, held, build_target, settings, progress)
        if firmer is None:
            break
        left = turned_faces.find_turned(live.patch, firmer.positions)
        if left.sum() >= turned.sum():
            break
        solution, turned, count = firmer, left, count + live.patch.count_faces(turned & ~left)
    return replace(solution, kept=(*solution.kept, *remarks.describe_held_faces(count)),
                   notes=(*solution.notes, *remarks.describe_turned_faces(live.patch.count_faces(turned))))


async def solve_held(live: LiveOptimizer, held: np.ndarray, build_target: BuildTarget, settings: SolveSettings,
                     progress: "native.Progress | None") -> Solution | None:
    """Solves with more vertices held; None where nothing is left to move."""
    try:
        firmer = await live_optimizer.build_optimizer(live.patch, live.view, live.border, progress, held=held)
        return await solve_once(firmer, build_target, settings, progress)
    except (native.InvalidInput, native.SolverFailure):
        return None


async def solve_once(live: LiveOptimizer, build_target: BuildTarget, settings: SolveSettings,
                     progress: "native.Progress | None") -> Solution:
    optimizer, length = live.optimizer, choose_length(live.patch, settings.length)
    before = await call(optimizer.score, length)
    wanted = await live_optimizer.build_targets(live, build_target, settings)  # that of a fit moves the optimizer first
    target, lacking = wanted.targets[0], await wanted.measure(optimizer)
    limit = choose_limit(live.patch, settings)
    report = await solve_within_limit(live, wanted.targets, limit, progress)
    formulation = choose_formulation(live.patch, live.view)
    positions, left = formulation.read_positions(optimizer), await wanted.measure(optimizer)
    after = await call(optimizer.score, length)
    short = (settings.explains_share and not report.limited and wanted.is_plain
             and falls_short(optimizer, target, lacking, left))
    bend = measure_bend(live, positions)
    return Solution(live.patch, positions, report, target, formulation.read_residual(optimizer, target), lacking, left,
                    length, before.shift, after.shift,
                    (*(remarks.describe_small_share(1.0 - left / lacking, live.border) if short else ()),
                     *remarks.describe_unfinished(report), *remarks.describe_bent_rim(bend),
                     *remarks.describe_limit(report.limited, limit, automatic=not settings.limit),
                     *remarks.describe_mirror(formulation),
                     *remarks.describe_far_move(live.patch, report.largest_move, live.border)),
                    choose_length(live.patch, 0.0), choose_remedy(live.border, short=short, bent=bend > 0.0),
                    formulation.measure_cage_move(optimizer), automatic_limit=0.0 if settings.limit else limit,
                    turn_before=before.turn, turn_after=after.turn, kept=tuple(optimizer.region.messages))


def measure_bend(live: LiveOptimizer, positions: np.ndarray) -> float:
    """Measures how far a solve bent the rim of a region of a mesh, radians; 0 where that is not seen. The surface of a
    cage has no rim: its faces beside the region follow.
    """
    bend = rim.measure_bend(live.patch, positions) if type(live.patch) is Patch else 0.0
    return bend if bend > rim.BENT else 0.0


def choose_remedy(border: str, *, short: bool, bent: bool) -> str:
    """Returns the border that would serve better: Free where too little of a target is reached, Tangent where the rim
    bends; empty where this one is good.
    """
    if short and border != "free":
        return "free"
    return "clamped" if bent and border in {"free", "fixed"} else ""


def falls_short(optimizer: "native.ShapeOptimizer", target: "native.Target", lacking: float, left: float) -> bool:
    """Returns whether less than SMALL_SHARE of a target was reached. Wanted changes below SMALL_CHANGE do not count:
    lines that are already as wanted differ by as much.
    """
    if left <= (1.0 - SMALL_SHARE) * lacking:
        return False
    steepness = live_optimizer.compute_rms(optimizer, target, np.linalg.norm(optimizer.field(), axis=1))
    return lacking > SMALL_CHANGE * steepness
