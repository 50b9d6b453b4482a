"""Dabs of Fair Brush on a mesh: smoother lines within a circle of the image plane, with the rest of the region held.
"""
from dataclasses import dataclass

import numpy as np

from .. import native
from ..model.border import CODES
from ..model.patch import Patch
from ..model.view import View
from . import live_optimizer
from .panel_problem import choose_border, pose_alone, pose_problem

CONTEXT, FEWEST_EDGES = 0.25, 4.0  # of the radius, and mean edges: what the filter sees beyond the circle
FEWEST_FREE = 8  # vertices within a circle that can be smoothed
LONGEST = 2.0    # length of the filter, relative to the radius: what is longer than the circle is no flaw in it
# That where none is given, relative to the panel's diagonal: longer than a press's, for the artist shows the flaws, and
# the circle how wide they are. With a press's 1/14 a stroke over waves as wide as its circle took 2 % of them.
WIDEST = 1.0 / 6.0
TOLERANCE = 1e-3


@dataclass(frozen=True)
class Brush:
    """The settings of a dab, world units."""
    radius: float
    strength: float  # fraction of the way to smooth lines in the middle, 0 to 1
    length: float    # detail finer than this goes
    limit: float     # largest move along the view since the stroke began
    families: int    # 2: the crossed lines are smoothed as well


@dataclass(frozen=True)
class Window:
    """A part of a patch around a circle."""
    vertices: np.ndarray  # #W: of the patch
    F: np.ndarray         # #F x 3: triangles of them
    held: np.ndarray      # #W, bool: those beyond the circle


class BrushedRegion:
    """A region under a brush: the moves of its vertices along the view since the stroke began, which dabs add to."""

    def __init__(self, V: np.ndarray, frame: np.ndarray, limit_range: np.ndarray | None,
                 partner: np.ndarray | None) -> None:
        """Takes the vertices that can move (#V x 3), the image plane's axes and the direction to the viewer (3 x 3),
        the ranges of their moves (#V x 2) where there are any, and the vertices' mirror images where they are kept.
        """
        self.start, self.frame, self.partner = V, frame, partner
        self.xy = V @ frame[:2].T
        self.move = np.zeros(len(V))
        self.limit_range = np.tile([-1.0, 1.0], (len(V), 1)) if limit_range is None else limit_range

    @property
    def moved(self) -> np.ndarray:
        """The present places of all that can move: #V x 3, world space."""
        return self.start + self.move[:, None] * self.frame[2]

    def dab(self, point: np.ndarray, brush: Brush) -> bool:
        """Smooths the lines around a point (3, world space), on both sides where the region stays symmetric. Returns
        False where the circle has too few vertices that can move.
        """
        try:
            found = self.solve(self.frame[:2] @ point, brush)
        except (native.InvalidInput, native.SolverFailure):  # no vertex of the circle is free, or lines are undefined
            return False
        if found is None:
            return False
        added = np.zeros(len(self.move))
        added[found[0]] = found[1]
        if self.partner is not None:
            image = added[self.partner]
            added = np.where((added != 0.0) & (image != 0.0), 0.5, 1.0) * (added + image)
        self.move = np.clip(self.move + added, *(brush.limit * self.limit_range.T))
        return True

    def solve(self, place: np.ndarray, brush: Brush) -> tuple[np.ndarray, np.ndarray] | None:
        """Solves around a place of the image plane; returns the vertices and their further moves. Raises the native
        module's errors.
        """
        raise NotImplementedError

    def build_around(self, place: np.ndarray, radius: float, move: np.ndarray) -> "native.ShapeOptimizer | None":
        """Builds the optimizer of a circle and what the filter sees around it, with the vertices moved by `move` (#V);
        None where the circle has too few that can move.
        """
        raise NotImplementedError

    def measure_lines(self, brush: Brush) -> tuple[float, float] | None:
        """Measures how far lines were and are off their course in the circle where the stroke moved most, degrees: the
        mean over the circle and the lights. A larger part of the region would take longer than a stroke may.
        """
        place = self.xy[np.abs(self.move).argmax()]
        try:
            windows = [self.build_around(place, brush.radius, move) for move in (np.zeros(len(self.move)), self.move)]
            if None in windows:
                return None
            length = min(brush.length, LONGEST * brush.radius)
            return tuple(float(np.mean([window.score(length, family).shift for family in range(brush.families)]))
                         for window in windows)
        except (native.InvalidInput, native.SolverFailure):  # as in a dab
            return None


class BrushedPatch(BrushedRegion):
    """A patch of a mesh under a brush."""

    def __init__(self, patch: Patch, view: View, border: str) -> None:
        """Takes the border of the region, which holds below the brush, too. A seam of a Mirror modifier is clamped."""
        self.patch, self.view = patch, view
        self.border = choose_border(pose_alone(patch, view), border)
        problem = pose_problem(patch, view)
        super().__init__(patch.V, live_optimizer.compute_image_frame(patch, view), patch.limit_range,
                         None if problem.is_joined else problem.partner)
        corners = self.xy[patch.F]
        self.edge = float(np.sqrt(np.mean(np.sum((corners - np.roll(corners, 1, axis=1))**2, axis=2))))

    @property
    def positions(self) -> np.ndarray:
        """The present positions of the patch: #V x 3, world space."""
        return self.moved

    @property
    def surface(self) -> tuple[np.ndarray, np.ndarray]:
        """The surface at the start of the stroke, on which the mouse is found: vertices and triangles."""
        return self.patch.V, self.patch.F

    def solve(self, place: np.ndarray, brush: Brush) -> tuple[np.ndarray, np.ndarray] | None:
        window = self.choose_window(place, brush.radius)
        return None if window is None else (window.vertices, self.solve_window(window, place, brush))

    def choose_window(self, place: np.ndarray, radius: float) -> Window | None:
        """Returns the window around a circle; None where too few vertices of the circle can move."""
        apart = np.linalg.norm(self.xy - place, axis=1)
        near = apart < radius + max(CONTEXT * radius, FEWEST_EDGES * self.edge)
        corners = self.patch.F[near[self.patch.F].all(axis=1)]
        vertices = np.flatnonzero(np.bincount(corners.ravel(), minlength=len(near)))
        held = apart[vertices] >= radius
        if np.count_nonzero(~held) < FEWEST_FREE:
            return None
        number = np.zeros(len(near), dtype=np.int64)
        number[vertices] = np.arange(len(vertices))
        return Window(vertices, number[corners], held)

    def build_around(self, place: np.ndarray, radius: float, move: np.ndarray) -> "native.ShapeOptimizer | None":
        window = self.choose_window(place, radius)
        return None if window is None else self.build_window(window, move)

    def build_window(self, window: Window, move: np.ndarray) -> "native.ShapeOptimizer":
        vertices, held = window.vertices, window.held
        return native.reflines.ShapeOptimizer(
            self.patch.V[vertices] + move[vertices, None] * self.frame[2], window.F,
            view_direction=self.view.view_direction, line_direction=self.view.both_directions, fixed=held,
            border=np.where(held, CODES["fixed"], self.border[vertices]), **self.choose_creases(vertices))

    def solve_window(self, window: Window, place: np.ndarray, brush: Brush) -> np.ndarray:
        """Solves for smooth lines in a window of the patch; returns the further moves of its vertices."""
        vertices, before = window.vertices, self.move[window.vertices]
        optimizer = self.build_window(window, self.move)
        targets = [build_dab_target(optimizer, place, brush, family) for family in range(brush.families)]
        start = optimizer.heights
        optimizer.solve(targets, gradient_tolerance=TOLERANCE)
        move = optimizer.heights - start
        lowest, highest = brush.limit * self.limit_range[vertices].T
        if (before + move < lowest).any() or (before + move > highest).any():
            optimizer.reset()
            ends = np.minimum(lowest - before, 0.0), np.maximum(highest - before, 0.0)
            optimizer.solve(targets, gradient_tolerance=TOLERANCE, limit=np.column_stack(ends))
            move = optimizer.heights - start
        return move

    def choose_creases(self, vertices: np.ndarray) -> dict[str, str | np.ndarray]:
        """Returns the arguments of creases for a window of the patch."""
        number = np.full(len(self.move), -1)
        number[vertices] = np.arange(len(vertices))
        marked = number[self.patch.creases.marked]
        return {"crease_rule": self.patch.creases.rule, "marked_creases": marked[(marked >= 0).all(axis=1)]}


def build_dab_target(optimizer: "native.ShapeOptimizer", place: np.ndarray, brush: Brush,
                     family: int) -> "native.Target":
    """Builds the target of lines that are smoothed most in the middle of the circle, and not at its rim."""
    own = optimizer.field(family)
    smooth = native.reflines.smooth(optimizer, length=min(brush.length, LONGEST * brush.radius), family=family)
    squared = np.minimum(np.sum((optimizer.centers - place)**2, axis=1) / brush.radius**2, 1.0)
    weight = brush.strength * (1.0 - squared)**2
    return native.reflines.Target(own + weight[:, None] * (smooth.gradient - own), family=family)
