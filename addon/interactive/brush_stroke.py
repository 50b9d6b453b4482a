"""A stroke of Fair Brush: dabs along the way of the mouse, and the meshes that follow.

A dab takes some hundredths of a second and runs at once, as the dabs of Blender's own brushes do.
"""
import time
from collections.abc import Sequence
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


class BrushedObject:
    """An object below a stroke, from the press of the button to its release."""

    def __init__(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch, border: str) -> None:
        self.patch, self.name = patch, ob.name
        self.brushed = take_under_brush(patch, facing.read_patch_view(context.scene, patch), border)
        V, F = self.brushed.surface
        surface = LineSurface(LineState(V, np.zeros(len(V))), F, self.brushed.frame)
        self.screen = screen_surface.ScreenSurface(surface, context.area)
        self.start = self.shown = patch.round_start_positions()
        self.counts = read_mesh.count_elements(ob)
        self.vertices = EditVertices(patch.index)
        self.dabs = 0
        self.brush: Brush | None = None  # of the last dab, with its radius in world units
        self.began = time.perf_counter()

    def is_near(self, point: np.ndarray, radius: float) -> bool:
        """Returns whether a circle around a point of another object's surface reaches this one, not only its image."""
        return bool(np.linalg.norm(self.patch.V - point, axis=1).min() <= radius)

    def dab(self, point: np.ndarray, brush: Brush) -> bool:
        """Dabs at a point (3, world space); returns False where too few vertices around it can move."""
        if not self.brushed.dab(point, brush):
            return False
        self.brush = brush
        self.dabs += 1
        return True

    def is_changed(self) -> bool:
        """Returns whether somebody else has changed the mesh since the last dab."""
        ob = bpy.data.objects.get(self.name)
        return (ob is None or ob.type != 'MESH' or read_mesh.count_elements(ob) != self.counts
                or not read_mesh.has_positions(ob, self.patch, self.shown))

    def write(self, new: np.ndarray) -> None:
        write_mesh.write_positions(bpy.data.objects[self.name], self.patch, new, self.shown, self.vertices)
        self.shown = new

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


class BrushStroke:
    """One stroke over one object or several, from the press of the button to its release."""

    def __init__(self, area: bpy.types.Area, objects: Sequence[BrushedObject]) -> None:
        self.area, self.objects = area, objects
        self.last: np.ndarray | None = None  # where the last dab was, pixels

    def move_to(self, x: float, y: float, size: float, brush: Brush) -> None:
        """Dabs along the way to a place, pixels of the window. `size` is the radius there; `brush` has all else.
        """
        to = np.array([x, y], dtype=float)
        way = np.zeros(2) if self.last is None else to - self.last
        steps = int(np.linalg.norm(way) / (SPACING * size))
        places = [to] if self.last is None else [self.last + way * (k + 1) / steps for k in range(steps)]
        touched = {id(each): each for place in places for each in self.dab(place, size, brush)}
        if places:
            self.last = places[-1]
        for each in touched.values():
            each.write(each.patch.to_object_space(each.brushed.positions))

    def dab(self, place: np.ndarray, size: float, brush: Brush) -> list[BrushedObject]:
        """Dabs at a place, across a gap on both sides of it; returns the objects that have moved."""
        found = screen_surface.find_foremost([each.screen for each in self.objects], *place,
                                             stay=self.last is not None)
        if found is None:
            return []
        which, point = found
        radius = size * self.objects[which].screen.measure_pixel(point)
        near = [each for number, each in enumerate(self.objects) if number == which or each.is_near(point, radius)]
        return [each for each in near if each.dab(point, replace(brush, radius=radius))]

    def find_changed(self) -> BrushedObject | None:
        """Returns an object that somebody else has changed since the last dab."""
        return next((each for each in self.objects if each.is_changed()), None)

    def restore(self) -> None:
        """Takes the stroke back where nobody else has changed the mesh."""
        for each in self.objects:
            if not each.is_changed():
                each.write(each.start)  # to the last bit

    def list_moved(self) -> list[BrushedObject]:
        """Returns the objects that the stroke has smoothed."""
        return [each for each in self.objects if each.dabs]

    @property
    def largest_move(self) -> float:
        return max(each.largest_move for each in self.objects)
