"""The limit of a solve: the given or the automatic one, and the range of each vertex's move within it."""
import numpy as np

from .. import native
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import SolveSettings
from ..model.view import View
from .live_optimizer import LiveOptimizer
from .read_solved import spread_ranges


def choose_limit(patch: Patch, settings: SolveSettings) -> float:
    """Returns the largest move: the given one, or for 0 a fraction of the length of what changes, as in the automatic
    press of Smooth. Tools change the lines of the whole region, and a panel that has moved by more is another panel.
    """
    if not settings.limit >= 0.0:  # a changed file may hold any number
        raise Refusal(f"{patch.name}: the limit {settings.limit} is no length: set it to 0, automatic, or to a length")
    return settings.limit or native.reflines.AUTOMATIC_LIMIT * (settings.limit_length or patch.diagonal)


async def choose_ranges(live: LiveOptimizer) -> np.ndarray | None:
    """Returns the range of each vertex's move (#V x 2) as the native solve takes it. Refuses where nothing may move,
    and where too many vertices have ranges of their own.
    """
    ranges = await spread_ranges(live.problem, live.optimizer)
    if ranges is None:
        return None
    name, is_cage = live.patch.name, live.problem.is_cage
    if not ranges.any():
        raise Refusal(f"{name}: no vertex may move: the vertex group of its limit has no weight here")
    most = native.reflines.MOST_BOUNDED_CAGE if is_cage else native.reflines.MOST_BOUNDED
    if np.count_nonzero(live.optimizer.cage_free if is_cage else live.optimizer.free) > most:
        raise Refusal(f"{name}: moves one way, and limits by a vertex group, are only for regions of up to {most} "
                      f"vertices{' of a cage' if is_cage else ''}, and for Smooth with the automatic length: choose "
                      "Both Ways and no group")
    return ranges


def clip_to_ranges(patch: Patch, view: View, positions: np.ndarray, limit: float) -> np.ndarray:
    """Returns positions (#V x 3) with each vertex's move along the view cut to its range, to show a drag:
    its last solve finds the shape within them. A cage whose own vertices are within them has its surface there, too.
    """
    if patch.limit_range is None:
        return positions
    axis = np.asarray(view.view_direction) / np.linalg.norm(view.view_direction)
    move = (positions - patch.V) @ axis
    return positions + (np.clip(move, *(limit * patch.limit_range.T)) - move)[:, None] * axis
