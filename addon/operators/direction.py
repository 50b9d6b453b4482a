"""The operator Direction and Density."""
from collections.abc import Awaitable, Callable
from functools import partial
from math import pi, radians

import bpy
import numpy as np

from ..interactive.drag_handles import Handle
from ..model.patch import Patch
from ..read import scene_objects
from ..read.read_falloff import read_falloff
from ..solver.common_lines import give_gradient
from ..solver.live_optimizer import BuildTarget
from ..targets import direction
from ..targets.direction import Direction
from ..targets.falloff import Falloff
from ..ui.tool_properties import DirectionSettings, FalloffSettings
from ..view import view_and_light
from .dragged_tool import DraggedTool, build_radius_handle


class REFLINES_OT_direction(DraggedTool, FalloffSettings, DirectionSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines turn, run straight in one
direction, or lie closer together"""
    bl_idname = "reflines.direction"
    bl_label = "Direction and Density"
    common_of: object = None  # the panels that the common lines were asked for

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.direction

    def has_use(self, name: str) -> bool:
        unused = {"angle": self.direction not in {'PRESENT', 'ANGLE'}, "density_end": self.axis == 'NONE',
                  "strength": self.direction == 'PRESENT', "radius": self.centre == 'EVERYWHERE',
                  "shape": self.centre == 'EVERYWHERE'}
        return not unused.get(name, False)

    def build_handles(self) -> tuple[Handle, ...]:
        angle = Handle("angle", "Angle", per_pixel=radians(0.25), low=-2.0 * pi, high=2.0 * pi, unit='ANGLE')
        return (*([angle] if self.direction in {'PRESENT', 'ANGLE'} else []),
                Handle("density", "Density", per_pixel=1.0 / 150.0, low=1e-3, high=1e6, doubles=True),
                Handle("strength", "Strength", per_pixel=1.0 / 300.0, low=0.0, high=1.0),
                *build_radius_handle(self.centre))

    def read_falloff(self, context: bpy.types.Context, _ob: bpy.types.Object, patch: Patch) -> Falloff | None:
        return read_falloff(self, context.scene, scene_objects.find_active_object(context), self.find_meeting(patch))

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> BuildTarget:
        scene = context.scene
        settings = Direction(
            self.find_line_direction(scene), self.angle, self.density, self.density_end, self.axis,
            strength=self.strength, falloff=self.read_falloff(context, ob, patch),
            find_mean=self.choose_mean(context, patch))
        return partial(direction.build_direction_target, settings=settings)

    def choose_mean(self, context: bpy.types.Context, patch: Patch) -> Callable[[], Awaitable[np.ndarray]] | None:
        """Returns what finds the mean gradient of panels that meet, whose course straight lines take; None of one panel
        alone.
        """
        meeting = self.find_meeting(patch)
        names = frozenset(each.name for each in meeting)
        if len(meeting) == 1 or self.direction == 'PRESENT':
            return None
        if self.common_of is not self.panels:
            self.common_of, self.common = self.panels, {}
        if names not in self.common:
            seen = [self.read_view(context, self.joint.get(each.name, each)) for each in meeting]
            self.common[names] = give_gradient(tuple(zip(meeting, seen, strict=True)), self.settle_border())
        return self.common[names]

    def find_line_direction(self, scene: bpy.types.Scene) -> np.ndarray | None:
        """Returns the direction of straight lines in world space, where zero stands for the region's mean; None where
        lines keep their course.
        """
        if self.direction == 'PRESENT':
            return None
        if self.direction == 'ANGLE':
            return view_and_light.find_picture_direction(scene.reflection_lines.camera, self.angle)
        return np.zeros(3)
