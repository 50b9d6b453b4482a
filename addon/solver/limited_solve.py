"""Solves that move no vertex beyond a limit."""
import numpy as np

from .. import native
from ..model.cage import CagePatch
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import SolveReport, SolveSettings
from ..model.view import View
from ..native_call import call
from .formulation import choose_formulation
from .live_optimizer import LiveOptimizer

MOST_BOUNDED_CAGE = 8_000  # a limit that 3,266 of 7,469 unknowns of a cage touch takes 30 s


def choose_limit(patch: Patch, settings: SolveSettings) -> float:
    """Returns the largest move: the given one, or for 0 a share of the length of what changes, as in the automatic
    press of Smooth. Tools change the lines of the whole region, and a panel that has moved by more is another panel.
    """
    if not settings.limit >= 0.0:  # a changed file may hold any number
        raise Refusal(f"{patch.name}: the limit {settings.limit} is no length: set it to 0, automatic, or to a length")
    return settings.limit or native.reflines.AUTOMATIC_LIMIT * (settings.limit_length or patch.diagonal)


async def solve_within_limit(live: LiveOptimizer, targets: "list[native.Target]", limit: float,
                             progress: "native.Progress | None") -> "native.Report | SolveReport":
    """Minimizes from the optimizer's present heights, and again with bounds where a vertex moved beyond the limit.

    Of a cage these are the vertices of its surface. A region of many vertices has all moves scaled instead.
    """
    share = await choose_formulation(live.patch, live.view).choose_ranges(live.optimizer)
    if share is not None:
        return await solve_within_shares(live, targets, np.where(share == 0.0, 0.0, limit * share), progress)
    report = await call(live.optimizer.solve, targets, progress=progress)
    largest = report.largest_move
    if largest <= limit or report.termination == "cancelled":
        return report
    beyond = scale_to_limit(live.optimizer, largest, limit)
    if report.unknowns <= choose_most_bounded(live.patch):
        return await call(live.optimizer.solve, targets, limit=limit, progress=progress)
    return SolveReport(report.termination, report.message, report.iterations, report.seconds, report.unknowns, limit,
                       beyond)


def choose_most_bounded(patch: Patch) -> int:
    """Returns the largest number of unknowns that are solved with bounds."""
    return MOST_BOUNDED_CAGE if isinstance(patch, CagePatch) else native.reflines.MOST_BOUNDED


async def solve_within_shares(live: LiveOptimizer, targets: "list[native.Target]", ranges: np.ndarray,
                              progress: "native.Progress | None") -> "native.Report":
    """Minimizes with a lowest and a highest move for each vertex (#V x 2)."""
    name = live.patch.name
    if not ranges.any():
        raise Refusal(f"{name}: no vertex may move: the vertex group of its limit has no weight here")
    is_cage, most = isinstance(live.patch, CagePatch), choose_most_bounded(live.patch)
    if np.count_nonzero(live.optimizer.cage_free if is_cage else live.optimizer.free) > most:
        raise Refusal(f"{name}: moves one way, and limits by a vertex group, are only for regions of up to {most} "
                      f"vertices{' of a cage' if is_cage else ''}, and for Smooth with the automatic length: choose "
                      "Both Ways and no group")
    return await call(live.optimizer.solve, targets, limit=ranges, progress=progress)


def clip_to_shares(patch: Patch, view: View, positions: np.ndarray, limit: float) -> np.ndarray:
    """Returns positions (#V x 3) with each vertex's move along the view cut to its share of the limit, to show a drag:
    its last solve finds the shape within them. A cage whose own vertices are within them has its surface there, too.
    """
    if patch.share is None:
        return positions
    axis = np.asarray(view.view_direction) / np.linalg.norm(view.view_direction)
    move = (positions - patch.V) @ axis
    return positions + (np.clip(move, *(limit * patch.share.T)) - move)[:, None] * axis


def scale_to_limit(optimizer: "native.ShapeOptimizer", largest_move: float, limit: float) -> int:
    """Scales all moves by the share that the limit is of the largest; returns how many vertices of the surface were
    beyond it, at least one: the numbers are rounded.
    """
    share, moved = limit / largest_move, optimizer.heights
    optimizer.scale_move(share)
    return max(int(np.count_nonzero(np.abs(moved - optimizer.heights) > (1.0 - share) * limit)), 1)
