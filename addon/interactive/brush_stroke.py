"""A stroke of Fair Brush: dabs along the way of the mouse, and the mesh that follows.

A dab takes some hundredths of a second and runs at once, as the dabs of Blender's own brushes do.
"""
import time
from dataclasses import replace

import bpy
import numpy as np

from ..model.line_surface import LineState, LineSurface
from ..model.patch import Patch
from ..model.solution import SolveReport, Solution
from ..read import read_mesh
from ..solver.brush import Brush
from ..solver.brushed_cage import take_under_brush
from ..view import facing, screen_surface
from ..write import write_mesh
from ..write.write_mesh import EditVertices

SPACING = 0.25  # of the brush's radius, from dab to dab


class BrushStroke:
    """One stroke, from the press of the button to its release."""

    def __init__(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch, border: str) -> None:
        self.patch, self.area = patch, context.area
        self.brushed = take_under_brush(patch, facing.read_patch_view(context.scene, patch), border)
        V, F = self.brushed.surface
        surface = LineSurface(LineState(V, np.zeros(len(V))), F, self.brushed.frame)
        self.surface, self.screen = surface, screen_surface.ScreenSurface(surface, context.area)
        self.start = self.shown = patch.round_start_positions()
        self.counts = read_mesh.count_elements(ob)
        self.vertices = EditVertices(patch.index)
        self.last: np.ndarray | None = None  # where the last dab was, pixels
        self.dabs = 0
        self.brush: Brush | None = None  # of the last dab, with its radius in world units
        self.began = time.perf_counter()

    def move_to(self, ob: bpy.types.Object, x: float, y: float, size: float, brush: Brush) -> None:
        """Dabs along the way to a place, pixels of the window. `size` is the radius there; `brush` has all else.
        """
        to = np.array([x, y], dtype=float)
        way = np.zeros(2) if self.last is None else to - self.last
        steps = int(np.linalg.norm(way) / (SPACING * size))
        places = [to] if self.last is None else [self.last + way * (k + 1) / steps for k in range(steps)]
        done = [self.dab(place, size, brush) for place in places]
        if places:
            self.last = places[-1]
        if any(done):
            self.write(ob, self.patch.to_object_space(self.brushed.positions))

    def dab(self, place: np.ndarray, size: float, brush: Brush) -> bool:
        """Dabs at a place; returns False beside the panel."""
        found = self.screen.find_place(*place, stay=self.last is not None)
        if found is None:
            return False
        point = self.surface.read_point(found, self.surface.start)
        self.brush = replace(brush, radius=size * self.screen.measure_pixel(point))
        done = self.brushed.dab(point, self.brush)
        self.dabs += done
        return done

    def is_changed(self, ob: bpy.types.Object | None) -> bool:
        """Returns whether somebody else has changed the mesh since the last dab."""
        return (ob is None or ob.type != 'MESH' or read_mesh.count_elements(ob) != self.counts
                or not read_mesh.has_positions(ob, self.patch, self.shown))

    def write(self, ob: bpy.types.Object, new: np.ndarray) -> None:
        write_mesh.write_positions(ob, self.patch, new, self.shown, self.vertices)
        self.shown = new

    def restore(self, ob: bpy.types.Object) -> None:
        """Takes the stroke back, to the last bit."""
        self.write(ob, self.start)

    def summarize(self) -> Solution:
        """Returns the stroke as a result, with the lines measured where it moved most."""
        lines = self.brushed.measure_lines(self.brush) or (0.0, 0.0)
        limit = self.brush.limit * np.abs(self.brushed.limit_range).max(axis=1)
        limited = int(np.count_nonzero((np.abs(self.brushed.move) >= limit) & (limit > 0.0)))
        report = SolveReport("converged", "", self.dabs, time.perf_counter() - self.began,
                             int(np.count_nonzero(self.brushed.move)), self.largest_move, limited)
        return Solution(self.patch, self.brushed.positions, report, None, np.zeros(0), 0.0, 0.0, self.brush.length,
                        *lines, ())

    @property
    def largest_move(self) -> float:
        return float(np.abs(self.brushed.move).max())
