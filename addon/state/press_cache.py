"""The cache of the last operation's presses of Smooth, for the redo panel: another strength or limit begins with what
the first press found. It can be rebuilt at any time from the mesh and the properties.
"""
from collections.abc import Awaitable, Callable, Collection, Sequence
from typing import TypeVar

from .. import native
from ..blender.app_handlers import forget_at_load
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import Solution
from ..model.view import View
from ..solver import automatic_smooth, joint_smooth, live_optimizer
from ..solver.automatic_smooth import AutomaticSmooth, KeptPress

Pressed = TypeVar("Pressed")
PressOnce = Callable[[KeptPress, AutomaticSmooth, "native.Progress | None"], Awaitable[Pressed]]

_presses: dict[str, KeptPress] = {}  # by the name of the object
_joint: list[KeptPress] = []  # the last press of several objects, or none


async def press_with_cache(press: PressOnce[Pressed], patch: Patch, seen: View, border: str, settings: AutomaticSmooth,
                           progress: "native.Progress | None") -> Pressed:
    """Presses Smooth once, with the kept smoother where nothing but strength and limit has changed; `press` measures
    the result, or does not.
    """
    with live_optimizer.convert_native_errors(patch):
        kept = _presses.pop(patch.name, None)  # nobody else takes it meanwhile
        if kept is not None and kept.suits([patch], [seen], border, settings):
            kept = kept.go_back_to([patch])
        else:
            kept = await automatic_smooth.build_press(patch, seen, border, settings)
        pressed = await press(kept, settings, progress)
        _presses[patch.name] = kept  # one that failed or was cancelled has nothing to keep
        return pressed


async def smooth_all(patches: Sequence[Patch], views: Sequence[View], border: str, settings: AutomaticSmooth,
                     progress: "native.Progress | None" = None) -> list[Solution | Refusal]:
    """Presses Smooth once on each patch, and on those that follow their neighbours as one problem. Returns for each its
    solution, or why there is none.
    """
    patches = joint_smooth.show_to_others(patches, settings)
    together = [k for k, patch in enumerate(patches) if joint_smooth.can_join(patch, settings)]
    solved = await smooth_jointly(patches, views, together, border, settings, progress)
    alone = [k for k in range(len(patches)) if k not in solved]
    outcomes = solved | {k: await smooth_or_refuse(patches[k], views[k], border, settings, progress) for k in alone}
    left = [k for k in together if not isinstance(outcomes[k], Refusal)]
    if not solved and len(left) < len(together):  # one that cannot be solved has kept the others from it
        outcomes |= await smooth_jointly(patches, views, left, border, settings, progress)
    return [outcomes[k] for k in range(len(patches))]


async def smooth_or_refuse(patch: Patch, seen: View, border: str, settings: AutomaticSmooth,
                           progress: "native.Progress | None") -> Solution | Refusal:
    try:
        return await press_with_cache(automatic_smooth.press_panel, patch, seen, border, settings, progress)
    except Refusal as refusal:
        return refusal


async def smooth_jointly(all_patches: Sequence[Patch], all_views: Sequence[View], chosen: Sequence[int], border: str,
                         settings: AutomaticSmooth, progress: "native.Progress | None") -> dict[int, Solution]:
    """Presses the chosen ones of the patches as one problem, with the kept smoother where nothing but strength and
    limit has changed; empty where they are not several, or one of them cannot be solved.
    """
    if len(chosen) < 2:
        return {}
    patches, views = [all_patches[k] for k in chosen], [all_views[k] for k in chosen]
    kept = _joint.pop() if _joint else None
    try:
        if kept is None or not kept.suits(patches, views, border, settings):
            kept = await joint_smooth.build_joint(patches, views, border, settings)
        kept = kept.go_back_to(patches)
        solutions = await joint_smooth.press_joint(kept, settings, progress)
    except (native.InvalidInput, native.SolverFailure, Refusal):
        return {}
    _joint[:] = [kept]
    return dict(zip(chosen, solutions, strict=True))


def keep_only(names: Collection[str]) -> None:
    """Drops the presses of all other objects at the end of an operation: each holds the factor of a matrix."""
    for gone in [name for name in _presses if name not in names]:
        del _presses[gone]
    if _joint and {problem.patch.name for problem in _joint[0].problems} != set(names):
        _joint.clear()


register, unregister = forget_at_load(_presses.clear, _joint.clear)
