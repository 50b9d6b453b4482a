"""The automatic press of Smooth for several patches that face each other across gaps: one problem."""
import time
from collections.abc import Sequence
from dataclasses import replace

from .. import native
from ..model.patch import Patch
from ..model.solution import Solution
from ..model.view import View
from ..native_call import call
from .automatic_smooth import AutomaticSmooth, KeptPress, build_solution
from .build_native import build_joint_panel
from .panel_problem import pose_problem


def can_join(patch: Patch, settings: AutomaticSmooth) -> bool:
    """Returns whether a patch takes part in a joint press: it follows its neighbours."""
    return patch.beside is not None and not settings.fair_border


def show_to_others(patches: Sequence[Patch], settings: AutomaticSmooth) -> list[Patch]:
    """Returns the patches; those of a joint press have what takes no part in it beside them: they were read without the
    regions of all that are solved.
    """
    others = [(patch.V, patch.F) for patch in patches if not can_join(patch, settings)]
    return [replace(patch, beside=patch.beside.add_soups(others)) if others and can_join(patch, settings) else patch
            for patch in patches]


async def build_joint(patches: Sequence[Patch], views: Sequence[View], border: str,
                      settings: AutomaticSmooth) -> KeptPress:
    """Builds the native smoother of patches; raises the native module's errors."""
    problems = tuple(map(pose_problem, patches, views))
    panels = [build_joint_panel(problem, border, settings.choose_joining(problem.patch)) for problem in problems]
    smoother = await call(native.reflines.JointSmoother.create, panels)
    return KeptPress(problems, border, settings, smoother)


async def press_joint(kept: KeptPress, settings: AutomaticSmooth,
                      progress: "native.Progress | None" = None) -> list[Solution]:
    """Presses all patches once; raises the native module's errors. The time reported is that of all."""
    begin = time.perf_counter()
    count = len(kept.problems)
    results = await call(kept.smoother.press, strengths=[settings.strength] * count, limits=[settings.limit] * count,
                         limit_ranges=[problem.limit_range for problem in kept.problems], progress=progress)
    seconds = time.perf_counter() - begin
    return [build_solution(problem, positions, report, settings, seconds)
            for problem, (positions, report) in zip(kept.problems, results, strict=True)]
