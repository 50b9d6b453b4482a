"""The cache of the last operation's presses of Smooth, for the redo panel: another strength or limit begins with what
the first press found. It can be rebuilt at any time from the mesh and the properties.
"""
from collections.abc import Awaitable, Callable, Collection
from dataclasses import replace
from typing import TypeVar

import bpy

from .. import native
from ..model.patch import Patch
from ..model.solution import Solution
from ..model.view import View
from ..solver import automatic_smooth, live_optimizer
from ..solver.automatic_smooth import AutomaticSmooth, KeptPress, Preview

Pressed = TypeVar("Pressed")
PressOnce = Callable[[KeptPress, AutomaticSmooth, "native.Progress | None"], Awaitable[Pressed]]

_presses: dict[str, KeptPress] = {}  # by the name of the object


async def smooth_with_cache(patch: Patch, seen: View, border: str, settings: AutomaticSmooth,
                            progress: "native.Progress | None" = None) -> Solution:
    """Presses Smooth once, with the kept smoother where nothing but strength and limit has changed."""
    return await press_with_cache(automatic_smooth.press_panel, patch, seen, border, settings, progress)


async def preview_with_cache(patch: Patch, seen: View, border: str, settings: AutomaticSmooth,
                             progress: "native.Progress | None" = None) -> Preview:
    """Does likewise without measuring the result, as a drag shows it."""
    return await press_with_cache(automatic_smooth.preview_press, patch, seen, border, settings, progress)


async def press_with_cache(press: PressOnce[Pressed], patch: Patch, seen: View, border: str, settings: AutomaticSmooth,
                           progress: "native.Progress | None") -> Pressed:
    with live_optimizer.convert_native_errors(patch):
        kept = _presses.pop(patch.name, None)  # nobody else takes it meanwhile
        if kept is not None and kept.suits(patch, seen, border, settings):
            kept = replace(kept, patch=patch)  # the way back to the mesh may differ, such as the shape key
        else:
            kept = await automatic_smooth.build_press(patch, seen, border, settings)
        pressed = await press(kept, settings, progress)
        _presses[patch.name] = kept  # one that failed or was cancelled has nothing to keep
        return pressed


def keep_only(names: Collection[str]) -> None:
    """Drops the presses of all other objects at the end of an operation: each holds the factor of a matrix."""
    for gone in [name for name in _presses if name not in names]:
        del _presses[gone]


def list_kept() -> tuple[KeptPress, ...]:
    """Returns the presses that are kept."""
    return tuple(_presses.values())


@bpy.app.handlers.persistent
def clear_cache(*_: object) -> None:
    _presses.clear()


def register() -> None:
    bpy.app.handlers.load_pre.append(clear_cache)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(clear_cache)
    clear_cache()
