"""The targets of handles on lines."""
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from .. import native
from ..model import line_curve
from ..model.line_handle import Handles, LineHandle
from ..model.solution import JointTargets
from ..native_call import call

# Radius relative to the way of a pull below which the radius grows with the way: nearer to its edge lines would bunch.
ROOM = 1.5
# The tolerance of a drag's solves: the values at a handle weigh so much that 1e-4 would leave 1e-5 of the size after a
# closed path.
FOLLOW_TOLERANCE = 1e-7
MISSED = 0.02  # fraction of the lines' spacing beside a handle from which that is reported


SpreadFalloff = Callable[["native.ShapeOptimizer"], Awaitable[np.ndarray]]


class HandleTargets:
    """Builds the targets of handles for one region again and again, from its lines at the start."""

    def __init__(self, line_step: float) -> None:
        """Takes the step of theta from one line to the next, radians."""
        self.line_step = line_step
        self.spread_falloff: SpreadFalloff | None = None  # returns the fall-off map of an optimizer's vertices (#V)
        self.optimizer: native.ShapeOptimizer | None = None
        self.lines: native.LineHandles | None = None
        self.follower: native.HandleFollower | None = None
        self.conflicts: tuple[str, ...] = ()  # sentences about the last handles that were built
        self.reached: list[native.HandleResidual] = []  # of those that were last measured
        self.missed: tuple[str, ...] = ()     # sentences about those that were not reached when last measured

    async def build(self, optimizer: "native.ShapeOptimizer", handles: Handles,
                    matrix: np.ndarray) -> "native.Target | JointTargets":
        """Builds the targets for an optimizer, which has the heights of the start whenever this is called. `matrix` (4
        x 4) takes the handles to world space.
        """
        wanted = await self.begin(optimizer, handles, matrix)
        if not wanted:
            return native.reflines.Target(optimizer.field())
        targets = await call(self.lines.build, wanted)
        return JointTargets(targets, partial(self.measure, handles=wanted), FOLLOW_TOLERANCE)

    async def follow(self, optimizer: "native.ShapeOptimizer", other: "native.ShapeOptimizer", *, handles: Handles,
                     matrix: np.ndarray, keep_crossed: bool) -> bool:
        """Moves the other optimizer of the region to where the lines meet the handles, and measures them. Returns False
        where that takes a solve.
        """
        wanted = await self.begin(optimizer, handles, matrix)
        if not wanted or not await call(self.follower.follow, wanted, other, keep_others=keep_crossed):
            return False
        await self.measure(other, wanted)
        return True

    async def begin(self, optimizer: "native.ShapeOptimizer", handles: Handles,
                    matrix: np.ndarray) -> "list[native.Handle]":
        """Returns the handles that count, as the native module's; none where no line is pulled."""
        if self.optimizer is not optimizer:
            falloff = None if self.spread_falloff is None else await self.spread_falloff(optimizer)
            self.lines = await call(native.reflines.LineHandles.create, optimizer, falloff=falloff)
            self.optimizer = optimizer
            self.follower = native.reflines.HandleFollower(optimizer, self.lines)
        used = [each for each in handles if not each.muted]
        self.conflicts, self.missed, self.reached = (), (), []
        if all(each.is_pin for each in used):
            return []
        wanted = [self.convert(each, str(number + 1), matrix) for number, each in enumerate(used)]
        self.conflicts = tuple(await call(self.lines.find_conflicts, wanted))
        return wanted

    async def measure(self, optimizer: "native.ShapeOptimizer", handles: "list[native.Handle]") -> float:
        """Returns the root mean square of the distances between handles and their lines, radians of theta."""
        self.reached = reached = await call(self.lines.measure, handles, optimizer, line_step=self.line_step)
        self.missed = tuple(f"The line of handle {number + 1} passes {each.fraction:.0%} of the lines' spacing beside "
                            "it: pull less far, or give it a larger radius" for number, each in enumerate(reached)
                            if each.fraction > MISSED)
        return float(np.sqrt(np.mean([each.theta**2 for each in reached])))

    def convert(self, handle: LineHandle, name: str, matrix: np.ndarray) -> "native.Handle":
        """Converts a handle to the native module's, in the image plane."""
        plane = self.optimizer.frame[:2] @ matrix[:3]  # 2 x 4
        if handle.is_pin:
            return native.reflines.Handle(project(plane, np.array(handle.pinned)), name=name)
        start, end = project(plane, np.array([handle.start])), project(plane, np.array([handle.end]))
        if handle.curve:
            return native.reflines.Handle(line_curve.sample_curve(project(plane, np.array(handle.curve))),
                                          value=float(self.lines.read_theta(start)[0]), radius=handle.radius, name=name)
        radius = max(handle.radius, ROOM * float(np.linalg.norm(end - start)))
        return native.reflines.Handle(end, value=float(self.lines.read_theta(start)[0]), radius=radius, centre=start,
                                      name=name)


@dataclass(frozen=True)
class HandleBuild:
    """The build of one set of handles, and the way to follow them without one."""
    builder: HandleTargets
    handles: Handles
    images: Handles  # with their mirror images, where the region is followed with its own
    matrix: np.ndarray

    async def __call__(self, optimizer: "native.ShapeOptimizer") -> "native.Target | JointTargets":
        return await self.builder.build(optimizer, self.handles, self.matrix)

    async def follow(self, optimizer: "native.ShapeOptimizer", other: "native.ShapeOptimizer", *,
                     keep_crossed: bool) -> bool:
        """Follows the handles; False where that takes a solve."""
        return await self.builder.follow(optimizer, other, handles=self.images, matrix=self.matrix,
                                         keep_crossed=keep_crossed)


def project(plane: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Returns image-plane coordinates of points: #P x 2."""
    return points @ plane[:, :3].T + plane[:, 3]
