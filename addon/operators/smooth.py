"""Smooth Reflection Lines."""
from functools import partial

import bpy

from .. import solving
from ..bridge.gather import Panel
from ..drag.modal import DraggedTool
from ..drag.motion import Handle
from ..solving import BuildTarget
from ..targets import smooth
from ..tool_settings import SmoothSettings


class REFLINES_OT_smooth(DraggedTool, SmoothSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines run smoothly.

In Object Mode the faces of the last run are taken; they are kept with the mesh as the face attribute "reflines_region".
Quads and n-gons stay as they are"""
    bl_idname = "reflines.smooth"
    bl_label = "Smooth Reflection Lines"

    def handles(self) -> tuple[Handle, ...]:
        return (Handle("strength", "Strength", per_pixel=1.0 / 300.0, low=0.0, high=1.0),
                Handle("length", "Length", per_pixel=1.0 / 150.0, low=1e-9, high=1e9, doubles=True, unit='LENGTH',
                       wheel=True))

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines

    def detail(self, _: bpy.types.Scene) -> float:
        return self.length

    def build_target(self, _context: bpy.types.Context, _ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        length = solving.length_of(panel, self.length)
        return partial(smooth.target, settings=smooth.Smooth(length, self.strength, self.directional))


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_smooth])
