"""Re-solve."""
import json

import bpy

from .. import session
from ..bridge import gather, versions


class REFLINES_OT_resolve(bpy.types.Operator):
    """Run the last tool again with the same settings on the same faces, for the view and light as they are now.

It begins with the shape before that run: of a result in a shape key the shape that the key is relative to, else the
mesh as it was; where the mesh has been changed since, with the mesh as it is"""
    bl_idname = "reflines.resolve"
    bl_label = "Re-solve"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = gather.active(context)
        if ob is None or ob.type != 'MESH' or not ob.reflection_lines.run.operator:
            cls.poll_message_set("Make a panel active on which a tool has run")
            return False
        obstacle = session.obstacle(context.scene) or context.scene.reflection_lines.live.obstacle(ob)
        cls.poll_message_set(obstacle)
        return not obstacle

    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = gather.active(context)
        mode, run = ob.mode, ob.reflection_lines.run
        if mode != 'OBJECT':  # where the faces of the last run are kept
            bpy.ops.object.mode_set(mode='OBJECT')
        difference = run.difference(ob.data)
        try:
            self.run(ob, run)
        except RuntimeError as error:  # how Blender hands on what an operator reports
            if mode != 'OBJECT':
                bpy.ops.object.mode_set(mode=mode)
            self.report({'ERROR'}, versions.reported_error(error))
            return {'CANCELLED'}
        if mode != 'OBJECT' and not run.key:  # to go on there; a result in a key ends in Object Mode
            bpy.ops.object.mode_set(mode=mode)
        for note in filter(None, (difference, *ob.reflection_lines.report.notes.splitlines())):
            self.report({'WARNING'}, f"{ob.name}: {note}")  # what the tool reports stays in the console
        self.report({'INFO'}, f"{ob.name}: {ob.reflection_lines.report.summary()}")
        return {'FINISHED'}

    def run(self, ob: bpy.types.Object, run: bpy.types.PropertyGroup) -> None:
        tool = getattr(bpy.ops.reflines, run.operator.split("_OT_")[1])
        tool('EXEC_DEFAULT', anew=True, **json.loads(run.settings))


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_resolve])
