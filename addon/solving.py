"""One solve of one panel: the optimizer that is built for it, and what is told of the outcome.

Panels come in as arrays, solutions go out as arrays; nothing here is kept, and nothing here knows Blender.
"""
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from . import native
from .bridge import mirror
from .bridge.cage import CagePanel
from .bridge.gather import Panel
from .bridge.refusal import Refusal
from .bridge.view import View
from .targets import mirrored

CODES = {"free": 0, "fixed": 1, "clamped": 2}  # of borders, vertex by vertex
AUTOMATIC_LENGTH = 1.0 / 6.0  # of the panel's diagonal
FAR = 0.05  # of the panel's diagonal: who moves a panel further than this wants to be told
TURNED = np.radians(45.0)  # of a face; who turns one further wants to be told
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

    def last(self) -> "Last":
        return Last(self.panel, self.positions, self.residual)


@dataclass(frozen=True)
class Last:
    """What is remembered of an object's last solve; saved with the file, see saved.py."""
    panel: Panel
    positions: np.ndarray  # #V x 3, world space
    residual: np.ndarray   # #F; empty where it is not known


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


def built(panel: Panel, seen: View, border: str, progress: object = None, *, to_follow: bool = False) -> Live:
    """Takes long; `progress`, a native one, goes on watching what is made. Refuses what is no panel; raises what the
    native module raises. One `to_follow` a drag counts few samples of a subdivided surface: the same shape but for a
    hundredth of the move, several times as often."""
    optimizer = made(panel, seen, border, progress, sparse=to_follow)
    refuse_closed(panel.name, int(panel.faces.sum()), optimizer.region.closed)
    return Live(panel, seen, border, optimizer)


def made(panel: Panel, seen: View, border: str, progress: object, *, sparse: bool) -> object:
    light = {"view_direction": seen.view_direction, "line_direction": seen.line_direction, "progress": progress}
    if isinstance(panel, CagePanel):
        symmetric = panel.is_symmetric_for(seen.view_direction)
        cage = panel.cage.arguments(symmetric)
        return native.reflines.CageOptimizer(**cage, **light, border=border, sparse=sparse)
    if panel.mirror is None or not panel.mirror.image:
        return native.reflines.ShapeOptimizer(panel.V, panel.F, **light, border=border)
    if is_alike(panel, seen):
        local, F, _ = mirror.both(panel.mirror, panel.local, panel.F)
        return native.reflines.ShapeOptimizer(panel.placed(local), F, **light, border=border)
    codes = np.where(panel.mirror.seam, CODES["clamped"], CODES[border])
    return native.reflines.ShapeOptimizer(panel.V, panel.F, **light, border=codes)


def is_alike(panel: Panel, seen: View) -> bool:
    """Whether the panel and its mirror image are seen and lit alike."""
    return (panel.mirror is not None and panel.mirror.is_whole
            and mirror.is_alike(panel.mirror, panel.matrix, seen.view_direction, seen.line_direction))


def positions_of(panel: Panel, seen: View, optimizer: object) -> np.ndarray:
    """#V x 3 of the panel: what the artist edits."""
    if isinstance(panel, CagePanel):
        return panel.V + (optimizer.cage_positions - panel.cage.V)[panel.index]
    positions = optimizer.positions
    if not is_alike(panel, seen):
        return positions
    own = len(panel.V)
    start, partner = panel.V, panel.mirror.partner
    if panel.mirror.image:
        local, _, partner = mirror.both(panel.mirror, panel.local, panel.F)
        start = panel.placed(local)
    move = positions - start
    return panel.V + 0.5 * (move[:own] + move[partner[:own]])


def target_of(live: Live, build: BuildTarget) -> object:
    """About the heights that the optimizer has. The image below a Mirror modifier wants the rest mirrored."""
    panel, seen, wanted = live.panel, live.view, build(live.optimizer)
    if isinstance(panel, CagePanel) or not is_alike(panel, seen) or not panel.mirror.image:
        return wanted
    return mirrored.target(wanted, mirror.theta_sign(panel.mirror, panel.matrix, seen.line_direction))


def length_of(panel: Panel, length: float) -> float:
    return length or AUTOMATIC_LENGTH * panel.diagonal


@contextmanager
def refusing(panel: Panel) -> Generator[None, None, None]:
    """Says with the object's name what the native module cannot use, or that it broke down."""
    try:
        yield
    except (native.InvalidInput, native.SolverFailure) as error:
        raise Refusal(f"{panel.name}: {error}") from error


def vertex_values(solution: Last) -> dict[str, np.ndarray]:
    """#V each: how far the vertices moved along the view, and the mean residual of the triangles around each, where
    that is known."""
    panel, corners = solution.panel, solution.panel.F.ravel()
    moved = np.linalg.norm(solution.positions - panel.V, axis=1)
    if len(solution.residual) != len(panel.F):
        return {"deviation": moved}
    count = np.maximum(np.bincount(corners, minlength=len(panel.V)), 1)
    return {"deviation": moved,
            "residual": np.bincount(corners, np.repeat(solution.residual, 3), minlength=len(panel.V)) / count}


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
    score = optimizer.score(length)
    target = target_of(live, build_target)  # a fit moves the optimizer, to begin nearby
    lacking = root_mean_square(optimizer, target)
    report = optimizer.solve(target, progress=progress)
    positions = positions_of(live.panel, live.view, optimizer)
    return Solution(live.panel, positions, report, target, residual_of(live.panel, optimizer, target), lacking,
                    root_mean_square(optimizer, target), length, score, optimizer.score(length),
                    (*optimizer.region.messages, *mirror_remarks(live.panel, live.view),
                     *far_move(live.panel, report.largest_move, live.border),
                     *turned_over(live.panel, positions)))


def residual_of(panel: Panel, optimizer: object, target: object) -> np.ndarray:
    """#F, without the image below a Mirror modifier; all over a face of a cage the root mean square of its surface."""
    residual = optimizer.residual(target)
    if not isinstance(panel, CagePanel):
        return residual[:len(panel.F)]
    faces = len(panel.cage.sizes)
    squared, area = (np.bincount(optimizer.parent, values, faces)
                     for values in (optimizer.area * residual**2, optimizer.area))
    mean, own = np.sqrt(squared / np.maximum(area, 1e-300)), np.flatnonzero(panel.faces)
    return np.repeat(mean[own], panel.cage.sizes[own] - 2)


def mirror_remarks(panel: Panel, seen: View) -> tuple[str, ...]:
    if panel.mirror is None:
        return ()
    cage = isinstance(panel, CagePanel)
    return mirror.remarks(panel.mirror, panel.is_symmetric_for(seen.view_direction) if cage else is_alike(panel, seen))


def far_move(panel: Panel, move: float, border: str) -> tuple[str, ...]:
    if move <= FAR * panel.diagonal:
        return ()
    remedy = "less strength" if border == "clamped" else "less strength, or the border Clamped,"
    return (f"Vertices move by up to {move / panel.diagonal:.0%} of the panel's size: the lines asked for are far from "
            f"those of its shape; {remedy} keeps it nearer",)


def turned_over(panel: Panel, positions: np.ndarray) -> tuple[str, ...]:
    """Nobody asks for that: it is where a move along the view slides a steep face over its neighbour."""
    before, after = unit_normals(panel.V, panel.F), unit_normals(positions, panel.F)
    count = int(np.count_nonzero((before * after).sum(axis=1) < np.cos(TURNED)))
    if count == 0:
        return ()
    return (f"{count} triangle{'s turn' if count > 1 else ' turns'} by more than {np.degrees(TURNED):.0f} degrees: "
            "deselect the faces that the view sees at a slant, or turn the view camera towards them",)


def unit_normals(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    """#F x 3; zero where a triangle has no area."""
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    normals = np.cross(b - a, c - a)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def root_mean_square(optimizer: object, target: object) -> float:
    """Of the residual over the triangles that can change, weighted as the target says: none given is 1."""
    weight = optimizer.area * optimizer.changeable
    if len(target.weight):
        weight = weight * target.weight
    return float(np.sqrt(weight @ optimizer.residual(target)**2 / max(weight.sum(), 1e-300)))
