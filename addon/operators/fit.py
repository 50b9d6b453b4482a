"""The operator Fit Cage to Mesh."""
import math
from dataclasses import replace

import bpy
import numpy as np

from ..blender import units
from ..model import gain
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import Solution, SolveSettings
from ..read import dense_mesh, gather, modifiers, scene_objects
from ..state import optimizer_cache
from ..targets.fit import Fit, Misfit
from ..view import facing
from .solve_tool import SolveTool


class REFLINES_OT_fit(SolveTool, bpy.types.Operator):
    """Move the cage below a Subdivision Surface along the view until the subdivided surface lies on another mesh and
has its lines. Select that mesh, then the cage"""
    bl_idname = "reflines.fit"
    bl_label = "Fit Cage to Mesh"
    needs_faces = False  # without a region all of the cage is fitted

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines

    def copy_settings(self, scene: bpy.types.Scene) -> None:
        """Copies the settings; the border is free where none was given, so that it comes to lie on the other mesh too.
        """
        if not self.properties.is_property_set("border"):
            self.border = 'free'
        if not self.properties.is_property_set("result"):
            self.result = scene.reflection_lines.result or 'MESH'  # a changed file may hold no choice

    def find_subjects(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Returns the active object alone, for the other mesh may be in Edit Mode too."""
        return [scene_objects.find_active_object(context)]

    def gather_patch(self, ob: bpy.types.Object) -> Patch:
        if not modifiers.is_cage(ob):
            raise Refusal(f"{ob.name} is no cage: the last modifier that is shown has to be a Subdivision Surface "
                          "with levels")
        return gather.gather_patch(ob, self.result, self.begin_run(ob), or_all=True,
                                   purpose=self.choose_purpose())

    def solve_patch(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> Solution:
        seen = facing.read_patch_view(context.scene, patch)
        fit = Fit(dense_mesh.read_dense_mesh(context, ob), seen.view_direction, seen.line_direction)
        settings = SolveSettings(self.border, self.read_detail_length(context.scene), math.inf,
                                 explains_shortfall=False, judges=self.read_judges(context))
        solution = optimizer_cache.solve_with_cache(patch, seen, settings, fit)
        before, after = fit.before, fit.misfit()
        off = gain.format_change(np.degrees(before.angle), np.degrees(after.angle))
        said = (f"Distance from {fit.dense.name} {format_distance(before)} \u2192 {format_distance(after)} at most, "
                f"lines off by {off}")
        return replace(solution, fit=said)


def format_distance(misfit: Misfit) -> str:
    return units.format_length(misfit.largest, bpy.context.scene, 2)
