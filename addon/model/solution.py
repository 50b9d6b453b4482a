"""Requests and results of a solve."""
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

import numpy as np

from .. import native
from .gain import Healed, Worse
from .light_set import LightSet
from .patch import Patch


BuildCrossed = Callable[["native.ShapeOptimizer"], "Awaitable[native.Target]"]


@dataclass(frozen=True)
class SolveSettings:
    """The parameters that every solve needs beside its target."""
    border: str
    length: float  # detail finer than this counts as a deviation, world units; 0: a fraction of the patch's diagonal
    limit: float = 0.0  # largest move along the view, world units; 0: a fraction of the patch's diagonal
    limit_length: float = 0.0  # the length that an automatic limit is a fraction of; 0: the patch's diagonal
    explains_shortfall: bool = True  # whether a small fraction of the target that was reached is worth a word
    build_crossed: BuildCrossed | None = None  # of the lines that cross the wanted ones; None leaves them to themselves
    judges: LightSet | None = None  # lights that take no part, but tell what became worse in them


@dataclass(frozen=True)
class JointTargets:
    """Targets that are solved for together, and the measure of what is not reached of them at an optimizer's heights.
    """
    targets: "list[native.Target]"
    measure: Callable[["native.ShapeOptimizer"], Awaitable[float]]
    # The tolerance of a drag's solves, relative to the gradient after a move of the mouse; 1e-2 would leave 4e-5 of the
    # size after a closed path.
    follow_tolerance: float = 1e-4
    is_plain: bool = False  # one tool's target, whose residual is the measure


@dataclass(frozen=True)
class SolveReport:
    """The outcome of an automatic press of Smooth, or of a solve that the limit held back, by the names that
    native.Report has; lengths in world units.
    """
    termination: str     # of the last solve; "not_applied" where nothing was moved
    message: str
    iterations: int      # of the last solve
    seconds: float       # of the whole press or solve
    unknowns: int
    largest_move: float  # along the view, of the whole press or solve
    limited: int = 0     # vertices that the limit holds back


@dataclass(frozen=True)
class Solution:
    """The result of one solve of one patch. Scores are degrees, the shifts and turns of native.LineScore."""
    patch: Patch
    positions: np.ndarray  # #V x 3, world space
    report: "native.Report | SolveReport"
    target: "native.Target | None"  # None after an automatic press of Smooth
    residual: np.ndarray   # #F, |grad theta - target|, radians / length
    residual_before: float  # root mean square by area and the target's weight, radians / length
    residual_after: float
    length: float
    score_before: float
    score_after: float
    notes: tuple[str, ...]
    automatic_length: float = 0.0  # what the length 0 stands for in this patch, world units
    remedy: str = ""  # a border that would serve better; empty where there is none
    cage_move: float = 0.0  # largest move of a cage's vertices; its surface, which report tells, moves less
    turn_before: float = 0.0
    turn_after: float = 0.0
    automatic_limit: float = 0.0  # what the limit 0 stood for, world units; 0 where it is not known
    kept: tuple[str, ...] = ()  # what of the region was left as it is, and why
    healed: Healed | None = None  # by an automatic press of Smooth
    worse: Worse | None = None    # what became worse, in the lights of the press or of the scene's set
    fit: str = ""  # how far a cage that was fitted is from the other mesh
    longer_waves: bool = False  # that may be flaws, too, were left by it
    flush: tuple[float, float] = (0.0, 0.0)  # by how much it was and is uneven towards panels of the press, world units
    verdict: np.ndarray | None = None  # #F, by it: 1 where flaws were healed, -1 where the surface was kept as design

    def to_last_solve(self) -> "LastSolve":
        return LastSolve(self.patch, self.positions, self.residual, self.verdict)


@dataclass(frozen=True)
class LastSolve:
    """The record of the last solve of an object, saved with the file (state/persistence.py)."""
    patch: Patch
    positions: np.ndarray  # #V x 3, world space
    residual: np.ndarray   # #F; empty where it is not known
    verdict: np.ndarray | None = None  # #F, see Solution; None after another tool, and after the file was loaded
