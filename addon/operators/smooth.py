"""Smooth Reflection Lines."""
import bpy

from .. import session
from ..bridge import apply, gather
from ..bridge.refusal import Refusal
from ..properties import border_property, length_property, strength_property


class REFLINES_OT_smooth(bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines run smoothly.

In Object Mode the faces of the last run are taken; they are kept with the mesh as the face attribute "reflines_region".
Quads and n-gons stay as they are"""
    bl_idname = "reflines.smooth"
    bl_label = "Smooth Reflection Lines"
    bl_options = {'REGISTER', 'UNDO'}

    # Not remembered from run to run: unset, they are the scene's, which the sidebar shows.
    length: length_property(options={'SKIP_SAVE'})
    strength: strength_property(options={'SKIP_SAVE'})
    border: border_property(options={'SKIP_SAVE'})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        if ob is None or ob.type != 'MESH' or ob.mode not in {'EDIT', 'OBJECT'}:
            cls.poll_message_set("Make the panel's mesh the active object, in Edit Mode or Object Mode")
            return False
        obstacle = session.obstacle(context.scene)
        cls.poll_message_set(obstacle)
        return not obstacle

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.view_layer.update()  # transforms set by a script a moment ago
        try:
            solutions = [self.solved(context.scene, ob) for ob in gather.subjects(context)]
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        for solution in solutions:
            self.keep(bpy.data.objects[solution.panel.name], solution)
        return {'FINISHED'}

    def settings(self, scene: bpy.types.Scene) -> session.Settings:
        for name in ("length", "strength", "border"):
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(scene.reflection_lines, name))
        return session.Settings(self.length, self.strength, self.border)

    def solved(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> session.Solution:
        panel = gather.gather(ob)
        return session.smooth(panel, session.view_of(scene, panel.center), self.settings(scene))

    def keep(self, ob: bpy.types.Object, solution: session.Solution) -> None:
        apply.keep_region(ob, solution.panel)
        apply.apply(ob, solution.panel, solution.positions)
        stored = ob.reflection_lines
        stored.center = solution.panel.local_center
        stored.report.fill(solution)
        self.report({'INFO'}, f"{ob.name}: {stored.report.summary()}")
        for note in solution.notes:
            self.report({'WARNING'}, f"{ob.name}: {note}")


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_smooth])
