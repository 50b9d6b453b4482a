"""The live optimizers: what is expensive to build and can be rebuilt at any time from the mesh and the properties.

Nothing here is saved, and nothing here knows Blender's mesh data.
"""
from collections.abc import Collection
from dataclasses import replace

import bpy
import numpy as np
from bpy.props import PointerProperty, StringProperty

from . import native, solving
from .bridge import view
from .bridge.gather import Panel
from .bridge.refusal import Refusal
from .bridge.view import View

FEW = 2  # optimizers kept between operations, that of the panel at work and another; each holds a matrix's factors

_live: dict[str, solving.Live] = {}  # of each object, the one used last at the end
_solutions: dict[str, solving.Last] = {}  # of each object
undone: dict[str, float] = {}         # of each object whose last solve undo took back: its seconds, to know it by
live_warps: dict[str, object] = {}    # the live/follower of each scene with a live warp
drags: list[object] = []              # the drag/modal.Drag that runs, if one does


def obstacle(scene: bpy.types.Scene) -> str:
    """Why no tool can run now, as a sentence; empty where they can."""
    return native.STATE.problem or scene.reflection_lines.missing()


def lend(panel: Panel, seen: View, border: str) -> solving.Live | None:
    """The kept optimizer, at the heights of `panel`, for a thread: nobody else has it until `take_back`."""
    live = _live.pop(panel.name, None)
    if live is None or not live.suits(panel, seen, border):
        return None
    live.optimizer.watch(None)
    live.optimizer.reset()
    return replace(live, panel=panel)  # the way back to the mesh may be another one


def take_back(live: solving.Live) -> None:
    _live.pop(live.panel.name, None)
    _live[live.panel.name] = live


def keep_few(names: Collection[str]) -> None:
    """At the end of an operation, with the names of its panels: the redo panel may repeat it over all of them."""
    for gone in [name for name in _live if bpy.data.objects.get(name) is None]:
        del _live[gone]
    others = [name for name in _live if name not in names]
    for name in others[:max(len(_live) - max(FEW, len(names)), 0)]:
        del _live[name]


def kept() -> tuple[str, ...]:
    """Names of the panels whose optimizers are kept."""
    return tuple(_live)


def remember(last: solving.Last) -> None:
    """One that was applied."""
    _solutions[last.panel.name] = last


def last_solution(name: str) -> solving.Last | None:
    """Of the object with this name."""
    return _solutions.get(name)


def solve(panel: Panel, seen: View, settings: solving.Settings, build_target: solving.BuildTarget) -> solving.Solution:
    """Built anew only if the panel, the view, the light or the border changed since the last time."""
    with solving.refusing(panel):
        live = lend(panel, seen, settings.border) or solving.built(panel, seen, settings.border)
        take_back(live)
        return solving.solved(live, build_target, settings)


def view_of(scene: bpy.types.Scene, center: np.ndarray) -> View:
    """As the solver uses it for a panel whose centre (world space) is given."""
    settings = scene.reflection_lines
    return view.view_of(settings.camera, settings.light, center)


def shown_directions(scene: bpy.types.Scene, ob: bpy.types.Object) -> tuple[np.ndarray | None, np.ndarray | None]:
    """View and line direction for the stripes on an object, the solver's where it has run; None for what is missing."""
    settings, stored = scene.reflection_lines, ob.reflection_lines
    center = ob.matrix_world @ stored.center if stored.report.termination else view.extent(ob)[0]
    try:
        seen = view.direction_to(settings.camera, np.array(center)) if settings.present(settings.camera) else None
        return seen, view.axis_z(settings.light) if settings.present(settings.light) else None
    except Refusal:
        return None, None


@bpy.app.handlers.persistent
def forget(*_: object) -> None:
    for follower in live_warps.values():
        follower.stop()
    live_warps.clear()
    for cache in (_live, _solutions, undone):
        cache.clear()


def live_says() -> str:
    """Of the present scene's live warp: why the panel does not follow, or what takes long; else empty."""
    follower = live_warps.get(bpy.context.scene.name)
    return "" if follower is None else follower.says()


class ReflinesSession(bpy.types.PropertyGroup):
    """What panels show of the session; on the window manager, so never saved."""
    problem: StringProperty(get=lambda _: native.STATE.problem)
    remedy: StringProperty(get=lambda _: native.STATE.remedy)
    live: StringProperty(get=lambda _: live_says())

    def is_undone(self, ob: bpy.types.Object) -> bool:
        """Whether undo took back what the object's report tells of."""
        return undone.get(ob.name) == ob.reflection_lines.report.seconds


def register() -> None:
    bpy.utils.register_class(ReflinesSession)
    bpy.types.WindowManager.reflection_lines = PointerProperty(type=ReflinesSession)
    bpy.app.handlers.load_pre.append(forget)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(forget)
    for drag in list(drags):  # Blender drops the operator without a word
        drag.give_up(bpy.context)
    forget()
    del bpy.types.WindowManager.reflection_lines
    bpy.utils.unregister_class(ReflinesSession)
