"""Untwist Reflection Lines."""
from functools import partial

import bpy

from ..bridge.gather import Panel
from ..targets import untwist
from ..session import BuildTarget
from ..tool import Tool, placed_falloff
from ..tool_settings import UntwistSettings


class REFLINES_OT_untwist(Tool, UntwistSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines turn by an angle,
less with the distance from a centre"""
    bl_idname = "reflines.untwist"
    bl_label = "Untwist Reflection Lines"

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.untwist

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        falloff = placed_falloff(self, context.scene, ob, panel)
        return partial(untwist.target, settings=untwist.Untwist(self.angle, falloff, self.emphasis))


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_untwist])
