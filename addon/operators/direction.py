"""Set Line Direction and Density."""
from functools import partial

import bpy
import numpy as np

from ..bridge import place
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..targets import direction
from ..session import BuildTarget
from ..tool import Tool, placed_falloff
from ..tool_settings import DirectionSettings


class REFLINES_OT_direction(Tool, DirectionSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines run in one direction,
evenly spaced"""
    bl_idname = "reflines.direction"
    bl_label = "Set Line Direction and Density"

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.direction

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        scene = context.scene
        settings = direction.Direction(
            self.line_direction(scene), self.density, self.density_end, self.axis,
            count=scene.reflection_lines.stripes.count if self.unit == 'LINES' else 0, strength=self.strength,
            falloff=placed_falloff(self, scene, ob, panel), emphasis=self.emphasis)
        return partial(direction.target, settings=settings)

    def line_direction(self, scene: bpy.types.Scene) -> np.ndarray:
        """In world space; zero for that of the region's mean."""
        if self.direction == 'ANGLE':
            return place.in_picture(scene.reflection_lines.camera, self.angle)
        if self.direction == 'MEAN':
            return np.zeros(3)
        between = np.array(self.end) - np.array(self.start)
        if not between.any():
            raise Refusal("The two points of the line direction are the same: pick two points")
        return between


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_direction])
