"""Solves that move no vertex beyond a limit."""
import numpy as np

from .. import native
from ..model.cage import CagePatch
from ..model.patch import Patch
from ..model.solution import SolveReport
from .live_optimizer import LiveOptimizer

# Relative to the patch's diagonal: the same share of the length of what changes as in the automatic press of Smooth.
# Tools change the lines of the whole region, and a panel that has moved by more is another panel.
AUTOMATIC_LIMIT = 1.0 / 20.0
MOST_BOUNDED = 20_000  # unknowns; larger solves with bounds take minutes, see tests/bench


def choose_limit(patch: Patch, limit: float) -> float:
    """Returns the largest move: the given one, or for 0 a fraction of the diagonal."""
    return limit or AUTOMATIC_LIMIT * patch.diagonal


def solve_within_limit(live: LiveOptimizer, targets: "list[native.Target]", limit: float,
                       progress: "native.Progress | None") -> "native.Report | SolveReport":
    """Minimizes from the optimizer's present heights, and again with bounds where a vertex moved beyond the limit.

    A cage, whose vertices are no heights of its surface, and a region of many vertices have all moves scaled instead.
    """
    report = live.optimizer.solve(targets, progress=progress)
    if report.largest_move <= limit or report.termination == "cancelled":
        return report
    if not isinstance(live.patch, CagePatch) and report.unknowns <= MOST_BOUNDED:
        return live.optimizer.solve(targets, limit=limit, progress=progress)
    beyond = scale_to_limit(live.optimizer, report.largest_move, limit)
    return SolveReport(report.termination, report.message, report.iterations, report.seconds, report.unknowns, limit,
                       beyond)


def scale_to_limit(optimizer: "native.ShapeOptimizer", largest_move: float, limit: float) -> int:
    """Scales all moves by the share that the limit is of the largest; returns how many vertices were beyond it."""
    share, moved = limit / largest_move, optimizer.heights
    optimizer.scale_move(share)
    return int(np.count_nonzero(np.abs(moved - optimizer.heights) > (1.0 - share) * limit))
