"""Set Line Direction and Density."""
from functools import partial
from math import pi, radians

import bpy
import numpy as np

from ..bridge import place
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..drag.modal import DraggedTool, radius_handle
from ..drag.motion import Handle
from ..solving import BuildTarget
from ..targets import direction
from ..targets.falloff import Falloff
from ..tool import placed_falloff
from ..tool_settings import DirectionSettings


class REFLINES_OT_direction(DraggedTool, DirectionSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines run in one direction,
evenly spaced"""
    bl_idname = "reflines.direction"
    bl_label = "Set Line Direction and Density"

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.direction

    def handles(self) -> tuple[Handle, ...]:
        angle = Handle("angle", "Angle", per_pixel=radians(0.25), low=-2.0 * pi, high=2.0 * pi, unit='ANGLE')
        return (*([angle] if self.direction == 'ANGLE' else []),
                Handle("density", "Density", per_pixel=1.0 / 150.0, low=1e-3, high=1e6, doubles=True),
                Handle("strength", "Strength", per_pixel=1.0 / 300.0, low=0.0, high=1.0), *radius_handle(self.centre))

    def falloff(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> Falloff | None:
        return placed_falloff(self, context.scene, ob, panel)

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        scene = context.scene
        settings = direction.Direction(
            self.line_direction(scene), self.density, self.density_end, self.axis,
            count=scene.reflection_lines.stripes.count if self.unit == 'LINES' else 0, strength=self.strength,
            falloff=self.falloff(context, ob, panel), emphasis=self.emphasis)
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
