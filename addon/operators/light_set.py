"""The operator Light Set, which fills the scene's set of lights."""
import itertools

import bpy
import numpy as np
from bpy.props import EnumProperty

from ..blender.tooltips import tell_by
from ..model.inspection import VIEWS
from ..model.light_set import find_walk
from ..model.refusal import Refusal, report_refusals
from ..read import scene_objects
from ..view import view_and_light

LIGHTS = ("light", "crossed")  # how those of a walk around are named
ACTIONS = (
    ('WALK', "Walk Around", "Fill the set with five views around the panel, each with the light and the crossed one; "
     "lights that were added by themselves stay"),
    ('ADD', "Add", "Add the present light, seen by the view camera, to the set; the entry follows both objects"),
    ('REMOVE', "Remove", "Remove the chosen light from the set"),
)


class REFLINES_OT_light_set(bpy.types.Operator):
    """Fill the set of lights with a walk around the panel, add the present light, or remove the chosen one"""
    bl_idname = "reflines.light_set"
    bl_label = "Light Set"
    bl_options = {'REGISTER', 'UNDO'}

    action: EnumProperty(name="Action", items=ACTIONS, default='WALK', options={'HIDDEN', 'SKIP_SAVE'})

    description = tell_by("action", {name: about for name, _, about in ACTIONS})

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        obstacle = view_and_light.find_obstacle(context.scene)
        if obstacle and self.action != 'REMOVE':
            raise Refusal(obstacle)
        settings = context.scene.reflection_lines
        {'WALK': self.walk_around, 'ADD': self.add_light, 'REMOVE': self.remove_light}[self.action](settings)
        return {'FINISHED'}

    def walk_around(self, settings: bpy.types.PropertyGroup) -> None:
        center = view_and_light.measure_extent(scene_objects.read_active_object(bpy.context))[0]
        seen = view_and_light.read_scene_view(bpy.context.scene, np.array(center))
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

    def add_light(self, settings: bpy.types.PropertyGroup) -> None:
        entry = settings.light_set.entries.add()
        entry.camera, entry.light = settings.camera, settings.light
        names = {each.name for each in settings.light_set.entries}
        numbered = (f"{settings.camera.name} {number}" for number in itertools.count(2))
        entry.name = next(name for name in itertools.chain((settings.camera.name,), numbered) if name not in names)
        settings.light_set.active = len(settings.light_set.entries) - 1

    def remove_light(self, settings: bpy.types.PropertyGroup) -> None:
        chosen = settings.light_set
        if not len(chosen.entries):
            raise Refusal("The set has no light")
        index = min(max(chosen.active, 0), len(chosen.entries) - 1)
        chosen.entries.remove(index)
        chosen.active = max(min(index, len(chosen.entries) - 1), 0)
