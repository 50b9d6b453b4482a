"""The live optimizers: what is expensive to build and can be rebuilt at any time from the mesh and the properties.

Nothing here is saved, and nothing here knows Blender's mesh data: panels come in as arrays, solutions go out as arrays.
"""
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass

import bpy
import numpy as np
from bpy.props import PointerProperty, StringProperty

from . import native
from .bridge import view
from .bridge.cage import CagePanel
from .bridge.gather import Panel
from .bridge.refusal import Refusal
from .bridge.view import View

AUTOMATIC_LENGTH = 1.0 / 6.0  # of the panel's diagonal

BuildTarget = Callable[[object], object]  # of the optimizer; what it returns is a native Target


@dataclass(frozen=True)
class Settings:
    """What every solve needs beside its target."""
    border: str
    length: float  # detail finer than this counts as wobble, world units; 0: a share of the panel's size


@dataclass(frozen=True)
class Solution:
    """A finished solve of one panel. `report` is the native Report; scores are degrees."""
    panel: Panel
    positions: np.ndarray  # #V x 3, world space
    report: object
    target: object
    residual: np.ndarray   # #F, |grad theta - target|, radians / length
    residual_before: float  # root mean square over the region, weighted as the target says
    residual_after: float
    length: float
    score_before: float
    score_after: float
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Live:
    """An optimizer with what it was built from; usable as long as nothing of that changed."""
    panel: Panel
    view: View
    border: str
    optimizer: object

    def suits(self, panel: Panel, view: View, border: str) -> bool:
        return (self.border == border
                and np.array_equal(self.view.view_direction, view.view_direction)
                and np.array_equal(self.view.line_direction, view.line_direction)
                and self.panel.same(panel))


_live: dict[str, Live] = {}
_solutions: dict[str, Solution] = {}  # the last of each object


def obstacle(scene: bpy.types.Scene) -> str:
    """Why no tool can run now, as a sentence; empty where they can."""
    return native.STATE.problem or scene.reflection_lines.missing()


def built(panel: Panel, seen: View, border: str) -> Live:
    """Takes long. Refuses what is no panel; raises what the native module raises."""
    optimizer = made(panel, seen, border)
    refuse_closed(panel.name, int(panel.faces.sum()), optimizer.region.closed)
    return Live(panel, seen, border, optimizer)


def lend(panel: Panel, seen: View, border: str) -> Live | None:
    """The kept optimizer, at the heights of `panel`, for a thread: nobody else has it until `take_back`."""
    live = _live.pop(panel.name, None)
    if live is None or not live.suits(panel, seen, border):
        return None
    live.optimizer.reset()
    return live


def take_back(live: Live) -> None:
    _live[live.panel.name] = live


def made(panel: Panel, seen: View, border: str) -> object:
    light = {"view_direction": seen.view_direction, "line_direction": seen.line_direction, "border": border}
    if isinstance(panel, CagePanel):
        symmetric = panel.is_symmetric_for(seen.view_direction)
        return native.reflines.CageOptimizer(**panel.cage.arguments(symmetric), **light)
    return native.reflines.ShapeOptimizer(panel.V, panel.F, **light)


def positions_of(panel: Panel, optimizer: object) -> np.ndarray:
    """#V x 3 of the panel: what the artist edits."""
    if isinstance(panel, CagePanel):
        return panel.V + (optimizer.cage_positions - panel.cage.V)[panel.index]
    return optimizer.positions


def length_of(panel: Panel, length: float) -> float:
    return length or AUTOMATIC_LENGTH * panel.diagonal


@contextmanager
def refusing(panel: Panel) -> Generator[None, None, None]:
    """Says with the object's name what the native module cannot use, or that it broke down."""
    try:
        yield
    except (native.InvalidInput, native.SolverFailure) as error:
        raise Refusal(f"{panel.name}: {error}") from error


def remember(solution: Solution) -> None:
    """One that was applied."""
    _solutions[solution.panel.name] = solution


def last_solution(name: str) -> Solution | None:
    """Of the object with this name; gone when Blender or the file is."""
    return _solutions.get(name)


def vertex_values(solution: Solution) -> dict[str, np.ndarray]:
    """#V each: how far the vertices moved along the view, and the mean residual of the triangles around each.

    Of a cage only the first: its residual is that of the surface below.
    """
    panel, corners = solution.panel, solution.panel.F.ravel()
    moved = np.linalg.norm(solution.positions - panel.V, axis=1)
    if len(solution.residual) != len(panel.F):
        return {"deviation": moved}
    count = np.maximum(np.bincount(corners, minlength=len(panel.V)), 1)
    return {"deviation": moved,
            "residual": np.bincount(corners, np.repeat(solution.residual, 3), minlength=len(panel.V)) / count}


def solve(panel: Panel, seen: View, settings: Settings, build_target: BuildTarget) -> Solution:
    """Built anew only if the panel, the view, the light or the border changed since the last time."""
    with refusing(panel):
        live = lend(panel, seen, settings.border) or built(panel, seen, settings.border)
        take_back(live)
        return solved(live, build_target, settings)


def frame_of(panel: Panel, seen: View) -> np.ndarray:
    """3 x 3, rows: the image plane's x and y, and the direction to the viewer, in world space."""
    try:
        return native.reflines.image_plane(seen.view_direction, seen.line_direction)
    except native.InvalidInput as error:
        raise Refusal(f"{panel.name}: {error}") from error


def refuse_closed(name: str, faces: int, closed: bool) -> None:
    """The solver takes a closed body apart at its silhouettes, but a panel is never meant to be all of one."""
    if closed:
        raise Refusal(f"{name}: the {faces} selected faces are all of a closed body, which has no border: "
                      "select only the faces of the panel")


def solved(live: Live, build_target: BuildTarget, settings: Settings, progress: object = None) -> Solution:
    """From the heights that the optimizer has. `progress`, a native one, lets another thread watch and cancel."""
    optimizer, length = live.optimizer, length_of(live.panel, settings.length)
    target = build_target(optimizer)
    score, lacking = optimizer.score(length), root_mean_square(optimizer, target)
    report = optimizer.solve(target, progress=progress)
    positions = positions_of(live.panel, optimizer)
    return Solution(live.panel, positions, report, target, optimizer.residual(target), lacking,
                    root_mean_square(optimizer, target), length, score, optimizer.score(length),
                    tuple(optimizer.region.messages))


def root_mean_square(optimizer: object, target: object) -> float:
    """Of the residual over the region in use, weighted as the target says: none given is 1."""
    weight = optimizer.area * target.weight if len(target.weight) else optimizer.area
    return float(np.sqrt(weight @ optimizer.residual(target)**2 / max(weight.sum(), 1e-300)))


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
    _live.clear()
    _solutions.clear()


class ReflinesSession(bpy.types.PropertyGroup):
    """What panels show of the session; on the window manager, so never saved."""
    problem: StringProperty(get=lambda _: native.STATE.problem)
    remedy: StringProperty(get=lambda _: native.STATE.remedy)


def register() -> None:
    bpy.utils.register_class(ReflinesSession)
    bpy.types.WindowManager.reflection_lines = PointerProperty(type=ReflinesSession)
    bpy.app.handlers.load_pre.append(forget)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(forget)
    forget()
    del bpy.types.WindowManager.reflection_lines
    bpy.utils.unregister_class(ReflinesSession)
