"""Add Light to Set, Remove Light from Set and Walk Around: what fills the scene's set of lights."""
import itertools

import bpy
import numpy as np

from ..model.inspection import VIEWS
from ..model.light_set import find_walk
from ..model.refusal import report_refusals
from ..read import scene_objects
from ..view import view_and_light

LIGHTS = ("light", "crossed")  # how those of a walk around are named


def has_light(operator: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    obstacle = view_and_light.find_obstacle(context.scene)
    operator.poll_message_set(obstacle)
    return not obstacle


class REFLINES_OT_add_set_light(bpy.types.Operator):
    """Add the present light, seen by the view camera, to the set; the entry follows both objects"""
    bl_idname = "reflines.add_set_light"
    bl_label = "Add Light to Set"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_light(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        entry = settings.light_set.entries.add()
        entry.camera, entry.light = settings.camera, settings.light
        names = {each.name for each in settings.light_set.entries}
        numbered = (f"{settings.camera.name} {number}" for number in itertools.count(2))
        entry.name = next(name for name in itertools.chain((settings.camera.name,), numbered) if name not in names)
        settings.light_set.active = len(settings.light_set.entries) - 1
        return {'FINISHED'}


class REFLINES_OT_remove_set_light(bpy.types.Operator):
    """Remove the chosen light from the set"""
    bl_idname = "reflines.remove_set_light"
    bl_label = "Remove Light from Set"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("The set has no light")
        return len(context.scene.reflection_lines.light_set.entries) > 0

    def execute(self, context: bpy.types.Context) -> set[str]:
        chosen = context.scene.reflection_lines.light_set
        index = min(max(chosen.active, 0), len(chosen.entries) - 1)
        chosen.entries.remove(index)
        chosen.active = max(min(index, len(chosen.entries) - 1), 0)
        return {'FINISHED'}


class REFLINES_OT_walk_around(bpy.types.Operator):
    """Fill the set with five views around the panel, each with the light and the crossed one; lights that were added
by themselves stay"""
    bl_idname = "reflines.walk_around"
    bl_label = "Walk Around"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_light(cls, context)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        center = view_and_light.measure_extent(scene_objects.read_active_object(context))[0]
        seen = view_and_light.read_scene_view(context.scene, np.array(center))
        eyes, lines = find_walk(seen, view_and_light.read_camera_axes(settings.camera)[1])
        entries = settings.light_set.entries
        for index in reversed([k for k, entry in enumerate(entries) if entry.keeps_directions]):
            entries.remove(index)
        for view, eye in zip(VIEWS, eyes, strict=True):
            for line, name in zip(lines, LIGHTS, strict=True):
                entry = entries.add()
                entry.name, entry.keeps_directions = f"{view}, {name}".capitalize(), True
                entry.eye, entry.line = eye, line
        settings.light_set.active = 0
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_add_set_light, REFLINES_OT_remove_set_light,
                                                           REFLINES_OT_walk_around])
