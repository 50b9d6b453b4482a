"""Bend Reflection Lines after a Picture."""
from functools import partial
from math import pi, radians

import bpy
import numpy as np

from ..bridge import picture, place
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..drag.modal import DraggedTool
from ..drag.motion import Handle
from ..solving import BuildTarget
from ..targets import pattern
from ..tool_settings import PatternSettings


class REFLINES_OT_pattern(DraggedTool, PatternSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines show the grey values of an
image.

What no surface can show is left over: see the colour map of the residual"""
    bl_idname = "reflines.pattern"
    bl_label = "Bend Lines after Image"

    image: bpy.props.StringProperty(name="Image", options={'SKIP_SAVE'}, description="Name; empty takes the scene's")

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.pattern

    def handles(self) -> tuple[Handle, ...]:
        return (Handle("strength", "Strength", per_pixel=1e-3, low=-pi, high=pi, unit='ANGLE'),
                Handle("angle", "Rotation", per_pixel=radians(0.25), low=-2.0 * pi, high=2.0 * pi, unit='ANGLE'))

    def build_target(self, context: bpy.types.Context, _ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        right, up = place.camera_axes(context.scene.reflection_lines.camera)
        centre = panel.center + self.offset[0] * right + self.offset[1] * up
        settings = pattern.Pattern(
            picture.grey(self.chosen(context.scene)), centre, right, self.width or np.ptp(panel.V @ right),
            self.angle, self.strength, self.blur, self.keep_lines, self.fit == 'VALUE')
        return partial(pattern.target, settings=settings)

    def chosen(self, scene: bpy.types.Scene) -> bpy.types.Image:
        image = bpy.data.images.get(self.image) if self.image else scene.reflection_lines.pattern.image
        if image is None:
            raise Refusal(f"There is no image {self.image}".rstrip() + ": choose one in the sidebar's Reflection tab")
        return image


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_pattern])
