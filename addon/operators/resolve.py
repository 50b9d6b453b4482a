"""The operator Re-solve."""
import json

import bpy

from ..blender import compat
from ..model.border import name_border
from ..model.refusal import Refusal
from ..read import region_faces, scene_objects
from ..view import view_and_light
from .solve_tool import SolveTool

BRUSH = "REFLINES_OT_fair_brush"


class REFLINES_OT_resolve(bpy.types.Operator):
    """Run the last tool again on the same faces (after an undo in Edit Mode the selected ones), as view and light are
now, from the shape before that run unless the mesh was changed since"""
    bl_idname = "reflines.resolve"
    bl_label = "Re-solve"
    bl_options = {'REGISTER', 'UNDO'}

    border: bpy.props.StringProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Another border than the last run's")
    limit: bpy.props.FloatProperty(min=0.0, unit='LENGTH', options={'HIDDEN', 'SKIP_SAVE'},
                                   description="Another limit than the last run's; 0: the same")
    flaw_size: bpy.props.FloatProperty(min=0.0, options={'HIDDEN', 'SKIP_SAVE'},
                                       description="Another size of flaws than the last run's; 0: the same")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Returns the tooltip with another border, limit or size of flaws; empty without, for the docstring."""
        if properties.flaw_size:
            return "Run the last tool again with flaws twice as long: what is as long as that counts as a flaw, too"
        if properties.limit:
            return "Run the last tool again with twice the limit of the move, which held vertices back"
        return f"Run the last tool again with the border {name_border(properties.border)}" if properties.border else ""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.find_active_object(context)
        if ob is None or ob.type != 'MESH' or not ob.reflection_lines.run.operator:
            return scene_objects.allow(cls, "Make a panel active on which a tool has run")
        if ob.reflection_lines.run.operator == BRUSH:
            return scene_objects.allow(cls, "A stroke of the brush cannot be run again: undo it, and paint again")
        return scene_objects.allow(
            cls, view_and_light.find_obstacle(context.scene) or context.scene.reflection_lines.live.obstacle(ob))

    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = scene_objects.find_active_object(context)
        mode, run = ob.mode, ob.reflection_lines.run
        if mode != 'OBJECT':  # the stored region can be read there only
            bpy.ops.object.mode_set(mode='OBJECT')
        difference = run.difference(ob.data)
        if mode == 'EDIT' and not region_faces.has_stored_region(ob.data):  # undo in Edit Mode takes it back
            bpy.ops.object.mode_set(mode=mode)
        try:
            self.run(ob, run, edited=mode == 'EDIT')
        except (RuntimeError, Refusal) as error:  # Blender raises the errors that an operator reports
            return_to_mode(ob, mode)
            self.report({'ERROR'}, compat.strip_error_prefix(error))
            return {'CANCELLED'}
        if not run.key:  # a result in a shape key ends in Object Mode
            return_to_mode(ob, mode)
        for note in filter(None, (difference, *ob.reflection_lines.report.notes.splitlines())):
            self.report({'WARNING'}, f"{ob.name}: {note}")  # the tool's own reports reach the console only
        self.report({'INFO'}, f"{ob.reflection_lines.report.headline()} ({ob.name})")
        return {'FINISHED'}

    def run(self, ob: bpy.types.Object, run: bpy.types.PropertyGroup, *, edited: bool) -> None:
        """Runs the tool of the stored run. Name and settings come from the file, so only tools that solve are run."""
        kind = getattr(bpy.types, run.operator, None)
        if not isinstance(kind, type) or not issubclass(kind, SolveTool):
            raise Refusal(f"{ob.name}: the stored run names no tool ({run.operator[:40]}): run a tool again")
        tool = getattr(bpy.ops.reflines, run.operator.split("_OT_")[1])
        changed = {name: getattr(self, name) for name in ("border", "limit", "flaw_size") if getattr(self, name)}
        try:
            settings = {**json.loads(run.settings), **changed, "anew": True, "edited": edited}
            tool('EXEC_DEFAULT', **settings)
        except (TypeError, ValueError, RecursionError) as error:
            raise Refusal(f"{ob.name}: the stored settings of {kind.bl_label} cannot be used: run it again") from error


def return_to_mode(ob: bpy.types.Object, mode: str) -> None:
    if ob.mode != mode:
        bpy.ops.object.mode_set(mode=mode)
