"""The operator Turn Lines."""
from functools import partial
from math import pi, radians

import bpy

from ..interactive.drag_handles import Handle
from ..model.patch import Patch
from ..read.read_falloff import read_falloff
from ..solver.live_optimizer import BuildTarget
from ..targets import untwist
from ..targets.falloff import Falloff
from ..targets.untwist import Untwist
from ..ui.tool_properties import UntwistSettings
from .dragged_tool import DraggedTool, build_radius_handle


class REFLINES_OT_untwist(DraggedTool, UntwistSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines turn by an angle,
less with the distance from a centre"""
    bl_idname = "reflines.untwist"
    bl_label = "Turn Lines"

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.untwist

    def build_handles(self) -> tuple[Handle, ...]:
        return (Handle("angle", "Angle", per_pixel=radians(0.25), low=-pi, high=pi, unit='ANGLE'),
                *build_radius_handle(self.centre))

    def read_falloff(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> Falloff | None:
        return read_falloff(self, context.scene, ob, patch)

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> BuildTarget:
        settings = Untwist(self.angle, self.read_falloff(context, ob, patch))
        return partial(untwist.build_untwist_target, settings=settings)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_untwist])
