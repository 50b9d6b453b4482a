"""The operator Image Pattern."""
from functools import partial
from math import pi, radians

import bpy
import numpy as np

from ..interactive.drag_handles import Handle
from ..model import meeting
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..read import image_pixels
from ..solver.live_optimizer import BuildTarget
from ..targets import pattern
from ..targets.pattern import Pattern
from ..ui.tool_properties import PatternSettings
from ..view import view_and_light
from .dragged_tool import DraggedTool


class REFLINES_OT_pattern(DraggedTool, PatternSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines show the grey values of an
image.

What no surface can show is left over: see the colour map of the residual"""
    bl_idname = "reflines.pattern"
    bl_label = "Image Pattern"

    image: bpy.props.StringProperty(name="Image", options={'HIDDEN', 'SKIP_SAVE'},
                                    description="Name; empty takes the scene's")

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.pattern

    def build_handles(self) -> tuple[Handle, ...]:
        return (Handle("strength", "Strength", per_pixel=1e-3, low=-pi, high=pi, unit='ANGLE'),
                Handle("angle", "Rotation", per_pixel=radians(0.25), low=-2.0 * pi, high=2.0 * pi, unit='ANGLE'))

    def read_judges(self, _context: bpy.types.Context) -> None:
        """Returns none: an image wants lines that are not even."""

    def keeps_crossed(self) -> bool:
        """Returns false: one light draws an image, and much less of it is reached where crossed lines are kept."""
        return False

    def has_use(self, name: str) -> bool:
        return name != "lights"

    def build_target(self, context: bpy.types.Context, _ob: bpy.types.Object, patch: Patch) -> BuildTarget:
        right, up = view_and_light.read_camera_axes(context.scene.reflection_lines.camera)
        panels = self.find_meeting(patch)  # which have one picture
        centre = meeting.find_middle(panels) + self.offset[0] * right + self.offset[1] * up
        width = self.width or np.ptp(np.concatenate([each.V for each in panels]) @ right)
        settings = Pattern(image_pixels.read_grey(self.chosen(context.scene)), centre, right, width, self.angle,
                           self.strength, self.blur, self.fit == 'VALUE')
        return partial(pattern.build_pattern_target, settings=settings)

    def chosen(self, scene: bpy.types.Scene) -> bpy.types.Image:
        image = bpy.data.images.get(self.image) if self.image else scene.reflection_lines.pattern.image
        if image is None:
            raise Refusal(f"There is no image {self.image}".rstrip() + ": choose one in the sidebar's Reflection tab")
        return image
