"""The native optimizer of one patch, with what it was built from."""
from collections.abc import Awaitable, Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from .. import native
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.same import are_same
from ..model.solution import JointTargets, SolveSettings
from ..model.view import View
from ..native_call import call
from . import build_native
from .panel_problem import PanelProblem, pose_problem
from .read_solved import complete_target

BuildTarget = Callable[["native.ShapeOptimizer"], "Awaitable[native.Target | JointTargets]"]


@dataclass(frozen=True)
class LiveOptimizer:
    """A native optimizer with what it was built from; it serves as long as nothing of that changes."""
    problem: PanelProblem
    border: str
    optimizer: "native.ShapeOptimizer"

    @property
    def patch(self) -> Patch:
        return self.problem.patch

    def suits(self, patch: Patch, view: View, border: str) -> bool:
        """Returns whether the optimizer serves this patch, view and border."""
        return self.border == border and are_same(self.problem.view, view) and self.patch.same(patch)


async def build_optimizer(patch: Patch, seen: View, border: str, progress: "native.Progress | None" = None, *,
                          to_follow: bool = False) -> LiveOptimizer:
    """Builds the optimizer of a patch, which takes long. Refuses closed surfaces; raises the native module's errors.

    `progress` goes on watching the optimizer. `to_follow` a drag, a cage is sampled more coarsely: several times faster
    steps, and a shape that differs by a hundredth of the move.
    """
    problem = pose_problem(patch, seen)
    optimizer = await build_native.build_optimizer(problem, border, progress, sparse=to_follow)
    refuse_closed(patch.name, int(patch.faces.sum()), optimizer.region.closed)
    return LiveOptimizer(problem, border, optimizer)


async def build_targets(live: LiveOptimizer, build: BuildTarget, settings: SolveSettings) -> JointTargets:
    """Builds the targets at the optimizer's present heights, last that of the lines that cross the wanted ones. One
    wanted target alone is measured by its residual.
    """
    built, complete = await build(live.optimizer), partial(complete_target, live.problem)
    crossed = [] if settings.build_crossed is None else [await settings.build_crossed(live.optimizer)]
    if isinstance(built, JointTargets):
        return replace(built, targets=[*(complete(each) for each in built.targets), *crossed])
    target = complete(built)
    return JointTargets([target, *crossed], partial(measure_residual, target=target), is_plain=True)


async def measure_residual(optimizer: "native.ShapeOptimizer", target: "native.Target") -> float:
    """Returns the root mean square of the residual over the triangles that can change, by area and the target's weight.
    """
    return await call(native.reflines.measure_residual, optimizer, target)


@contextmanager
def convert_native_errors(patch: Patch) -> Generator[None, None, None]:
    """Converts errors of the native module into refusals that name the object."""
    try:
        yield
    except (native.InvalidInput, native.SolverFailure) as error:
        raise Refusal(f"{patch.name}: {error}") from error


def compute_image_frame(patch: Patch, seen: View) -> np.ndarray:
    """Returns the axes of the image plane and the direction to the viewer: 3 x 3, rows, world space."""
    try:
        return native.reflines.image_plane(seen.view_direction, seen.line_direction)
    except native.InvalidInput as error:
        raise Refusal(f"{patch.name}: {error}") from error


def refuse_closed(name: str, faces: int, closed: bool) -> None:
    """Refuses a region that is all of a closed body. The solver could cut it at its silhouettes, but nobody means that.
    """
    if closed:
        raise Refusal(f"{name}: the {faces} selected faces are all of a closed body, which has no border: "
                      "select only the faces of the panel")
