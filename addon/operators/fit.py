"""Fit Cage to Mesh."""
import bpy
import numpy as np

from .. import session, solving
from ..bridge import dense, gather, modifiers, panels, units
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..targets.fit import Fit, Misfit
from ..tool import Tool


class REFLINES_OT_fit(Tool, bpy.types.Operator):
    """Move the cage below a Subdivision Surface along the view so that the subdivided surface lies on another mesh and
has its reflection lines: a scan, or an optimised dense panel.

Select that mesh, then the cage, so that the cage is the active object. In Object Mode all of a cage is fitted that has
no region from a run before"""
    bl_idname = "reflines.fit"
    bl_label = "Fit Cage to Mesh"

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines

    def take_settings(self, scene: bpy.types.Scene) -> None:
        """Unless told otherwise the border lies on the other mesh, too."""
        self.solve_for = 'CAGE'
        if not self.properties.is_property_set("border"):
            self.border = 'free'
        if not self.properties.is_property_set("result"):
            self.result = scene.reflection_lines.result

    def subjects(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """The other mesh may be in Edit Mode, too."""
        return [gather.active(context)]

    def panel_of(self, ob: bpy.types.Object) -> Panel:
        return panels.gathered(ob, self.solve_for, self.result, self.begins_with(ob), or_all=True)

    def solved(self, context: bpy.types.Context, ob: bpy.types.Object) -> solving.Solution:
        if not modifiers.is_cage(ob):
            raise Refusal(f"{ob.name} is no cage: the last modifier that is shown has to be a Subdivision Surface "
                          "with levels")
        panel = self.panel_of(ob)
        seen = session.view_of(context.scene, panel.center)
        fit = Fit(dense.read(context, ob), seen.view_direction, seen.line_direction)
        solution = session.solve(panel, seen, solving.Settings(self.border, self.detail(context.scene)), fit)
        before, after = fit.before, fit.misfit()
        self.said = (f"Distance from {fit.dense.name} {distance(before)} before, {distance(after)} after; lines off by "
                     f"{np.degrees(before.angle):.3g} degrees before, {np.degrees(after.angle):.3g} after")
        return solution

    def keep(self, ob: bpy.types.Object, solution: solving.Solution) -> None:
        super().keep(ob, solution)
        ob.reflection_lines.report.fit = self.said
        self.report({'INFO'}, self.said)


def distance(misfit: Misfit) -> str:
    mean, largest = (units.length_text(value, bpy.context.scene) for value in (misfit.mean, misfit.largest))
    return f"{mean} (at most {largest})"


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_fit])
