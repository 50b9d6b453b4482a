"""The automatic press of Smooth: the native rules find the flaws of a mesh patch and leave its design alone."""
import time
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..model.creases import Creases
from ..model.patch import Patch
from ..model.solution import PressReport, Solution
from ..model.view import View
from . import remarks, solve
from .formulation import choose_formulation
from .live_optimizer import LiveOptimizer

MOST_NOTES = 2


@dataclass(frozen=True)
class AutomaticSmooth:
    """The settings of the press, as the arguments of reflines.smooth_panel have them."""
    lights: str  # "crossed" or "single"
    strength: float
    symmetric: bool


def suits(patch: Patch, seen: View) -> bool:
    """Returns whether the native rules know the patch: no cage, and no half joined with its image."""
    return choose_formulation(patch, seen).is_alone


def hold_marked_creases(patch: Patch) -> Patch:
    """Returns the patch with its marked creases only: noise makes creases of the automatic rule, and the native rules
    keep by themselves what bends.
    """
    rule = "none" if patch.creases.rule == "none" else "marked"
    return replace(patch, creases=Creases(rule, patch.creases.marked))


def smooth_panel(live: LiveOptimizer, settings: AutomaticSmooth) -> Solution:
    """Calls reflines.smooth_panel once, for the shape that `live` was built with, and measures the result.

    The score is the native unevenness, root mean square over the lights, by the creases of the start before and after.
    The residual is that of the lines against their smooth course at the same length, before and after alike.
    """
    begin = time.perf_counter()
    positions, told = call_native(live, settings)
    report = build_report(told, time.perf_counter() - begin)
    after = build_optimizer_of_result(live, positions) if told.applied else live.optimizer
    lacking, _ = measure_residual(live.optimizer, told.length)
    left, target = measure_residual(after, told.length)
    scores = [float(np.sqrt(np.mean(np.square(each)))) for each in (told.unevenness_before, told.unevenness_after)]
    if not told.applied:
        scores[1] = scores[0]  # the unevenness after is that of the shape that was refused
    return Solution(live.patch, positions, report, target, after.residual(target), lacking, left, told.length, *scores,
                    choose_notes(live, told), automatic_length=told.length)


def call_native(live: LiveOptimizer, settings: AutomaticSmooth) -> tuple[np.ndarray, "native.SmoothPanelReport"]:
    patch, formulation = live.patch, choose_formulation(live.patch, live.view)
    held = np.zeros(len(patch.V), dtype=bool)
    if patch.creases.rule != "none":
        held[patch.creases.marked.ravel()] = True
    return native.reflines.smooth_panel(patch.V, patch.F, **formulation.choose_directions(), fixed=held,
                                        border=formulation.choose_border(live.border), **vars(settings))


def build_report(told: "native.SmoothPanelReport", seconds: float) -> PressReport:
    termination = told.solve.termination if told.applied else "not_applied"
    message = told.solve.message if told.applied else told.messages[0]
    move = told.largest_move if told.applied else 0.0
    return PressReport(termination, message, told.solve.iterations, seconds, told.solve.unknowns, move)


def build_optimizer_of_result(live: LiveOptimizer, positions: np.ndarray) -> "native.ShapeOptimizer":
    moved = replace(live.patch, V=positions)
    return choose_formulation(moved, live.view).build(live.border, None, sparse=False)


def measure_residual(optimizer: "native.ShapeOptimizer", length: float) -> tuple[float, "native.Target"]:
    """Returns the root mean square of what the lines lack of their smooth course, and that course."""
    course = native.reflines.smooth(optimizer, length=length)
    return solve.compute_rms_residual(optimizer, course), course


def choose_notes(live: LiveOptimizer, told: "native.SmoothPanelReport") -> tuple[str, ...]:
    """Returns the most important sentences: those of the press first, then what of the region was held."""
    lopsided = () if told.mirrored else remarks.describe_mirror(choose_formulation(live.patch, live.view))
    every = (*told.messages, *lopsided, *live.optimizer.region.messages)
    return tuple(dict.fromkeys(every))[:MOST_NOTES]
