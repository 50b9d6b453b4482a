"""Bend Reflection Lines after a Picture."""
from functools import partial

import bpy
import numpy as np

from ..bridge import picture, place
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..targets import pattern
from ..session import BuildTarget
from ..tool import Tool
from ..tool_settings import PatternSettings


class REFLINES_OT_pattern(Tool, PatternSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines show the grey values of an
image.

What no surface can show is left over: see the colour map of the residual"""
    bl_idname = "reflines.pattern"
    bl_label = "Bend Lines after Image"

    image: bpy.props.StringProperty(name="Image", options={'SKIP_SAVE'}, description="Name; empty takes the scene's")

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.pattern

    def build_target(self, context: bpy.types.Context, _ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        right, up = place.camera_axes(context.scene.reflection_lines.camera)
        centre = panel.center + self.offset[0] * right + self.offset[1] * up
        settings = pattern.Pattern(
            picture.grey(self.chosen(context.scene)), centre, right, self.width or np.ptp(panel.V @ right),
            self.angle, self.strength, self.blur, self.keep_lines)
        return partial(pattern.target, settings=settings)

    def chosen(self, scene: bpy.types.Scene) -> bpy.types.Image:
        image = bpy.data.images.get(self.image) if self.image else scene.reflection_lines.pattern.image
        if image is None:
            raise Refusal(f"There is no image {self.image}".rstrip() + ": choose one in the sidebar's Reflection tab")
        return image


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_pattern])
