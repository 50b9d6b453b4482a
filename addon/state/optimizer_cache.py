"""The cache of built optimizers, which can be rebuilt at any time from the mesh and the properties."""
from collections.abc import Collection
from dataclasses import replace

import bpy

from .. import native
from ..blender.app_handlers import forget_at_load
from ..model.patch import Patch
from ..model.solution import Solution, SolveSettings
from ..model.view import View
from ..native_call import run_now
from ..solver import live_optimizer, solve
from ..solver.live_optimizer import BuildTarget, LiveOptimizer
from ..solver.panel_problem import pose_problem

KEPT_OPTIMIZERS = 2  # between operations: that of the patch at work and another; each holds the factors of a matrix

_optimizers: dict[str, LiveOptimizer] = {}  # by the name of the object, the one used last at the end


def take_optimizer(patch: Patch, seen: View, border: str) -> LiveOptimizer | None:
    """Takes the cached optimizer out for exclusive use, reset to the heights of `patch`; None where none suits."""
    live = _optimizers.pop(patch.name, None)
    if live is None or not live.suits(patch, seen, border):
        return None
    live.optimizer.watch(None)
    live.optimizer.reset()
    # The way back to the mesh may differ, such as the shape key.
    return replace(live, problem=pose_problem(patch, live.problem.view))


def return_optimizer(live: LiveOptimizer) -> None:
    """Puts an optimizer into the cache, as the one used last."""
    _optimizers.pop(live.patch.name, None)
    _optimizers[live.patch.name] = live


def drop_surplus(names: Collection[str]) -> None:
    """Drops optimizers beyond KEPT_OPTIMIZERS at the end of an operation.

    Those named stay, however many: the redo panel may repeat the operation on all of them.
    """
    owners = {name: {panel.name for panel in live.patch.panels} for name, live in _optimizers.items()}
    for gone in [name for name, own in owners.items() if any(bpy.data.objects.get(each) is None for each in own)]:
        del _optimizers[gone], owners[gone]
    others = [name for name, own in owners.items() if not own & set(names)]
    for name in others[:max(len(_optimizers) - max(KEPT_OPTIMIZERS, len(names)), 0)]:
        del _optimizers[name]


def solve_with_cache(patch: Patch, seen: View, settings: SolveSettings, build_target: BuildTarget) -> Solution:
    """Solves with the cached optimizer; builds one only where patch, view, light or border changed."""
    return run_now(await_solve_with_cache(patch, seen, settings, build_target))


async def await_solve_with_cache(patch: Patch, seen: View, settings: SolveSettings, build_target: BuildTarget,
                                 progress: "native.Progress | None" = None) -> Solution:
    """Solves likewise, as a coroutine that the caller may watch and cancel."""
    with live_optimizer.convert_native_errors(patch):
        live = (take_optimizer(patch, seen, settings.border)
                or await live_optimizer.build_optimizer(patch, seen, settings.border, progress))
        try:
            return await solve.solve_patch(live, build_target, settings, progress)
        finally:
            return_optimizer(live)


register, unregister = forget_at_load(_optimizers.clear)
