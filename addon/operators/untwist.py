"""Untwist Reflection Lines."""
from functools import partial
from math import pi, radians

import bpy

from ..bridge.gather import Panel
from ..drag.modal import DraggedTool, radius_handle
from ..drag.motion import Handle
from ..solving import BuildTarget
from ..targets import untwist
from ..targets.falloff import Falloff
from ..tool import placed_falloff
from ..tool_settings import UntwistSettings


class REFLINES_OT_untwist(DraggedTool, UntwistSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines turn by an angle,
less with the distance from a centre"""
    bl_idname = "reflines.untwist"
    bl_label = "Untwist Reflection Lines"

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.untwist

    def handles(self) -> tuple[Handle, ...]:
        return (Handle("angle", "Angle", per_pixel=radians(0.25), low=-pi, high=pi, unit='ANGLE'),
                *radius_handle(self.centre))

    def falloff(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> Falloff | None:
        return placed_falloff(self, context.scene, ob, panel)

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        settings = untwist.Untwist(self.angle, self.falloff(context, ob, panel), self.emphasis)
        return partial(untwist.target, settings=settings)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_untwist])
