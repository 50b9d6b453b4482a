"""Start, Apply and Discard Live Warp."""
import bpy

from .. import session, solving
from ..bridge import apply, gather, keys, lattice, modifiers, panels, start
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..live import handlers
from ..live import scene as about
from ..targets import warp
from ..tool import Tool


class LiveEnd:
    """What Apply and Discard share. Both end in Object Mode, so that one undo takes them back."""
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("There is no live warp in this scene: press Start Live Warp")
        return context.scene.reflection_lines.live.panel is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        leave_edit_mode(context)
        context.view_layer.update()
        scene = context.scene
        try:
            self.finish(scene, about.subject(scene))
        except about.Changed as changed:
            self.report({'WARNING'}, str(changed))
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        start.drop(scene.reflection_lines.live.panel)
        scene.reflection_lines.live.panel = None
        handlers.end(scene)
        return {'FINISHED'}

    def finish(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        """Gives the panel its last shape."""
        raise NotImplementedError


def leave_edit_mode(context: bpy.types.Context) -> None:
    if context.mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')


def refuse_keys(ob: bpy.types.Object, result: str) -> None:
    """Other tools take them in Edit Mode, but a live warp runs in Object Mode."""
    if result == 'MESH' and ob.data.shape_keys is not None:
        raise Refusal(f"{ob.name} has shape keys, and a live warp can change none but its own: "
                      "choose the result Shape Key")


class REFLINES_OT_start_live_warp(bpy.types.Operator):
    """Let the panel follow its warp lattice while you edit that: in Edit Mode, by proportional editing.

Ends in Object Mode with the lattice chosen. Apply keeps the panel's shape, Discard takes it back; both can wait until
the file is opened again"""
    bl_idname = "reflines.start_live_warp"
    bl_label = "Start Live Warp"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        live, active = context.scene.reflection_lines.live, context.view_layer.objects.active
        if live.panel is not None:
            cls.poll_message_set(f"{live.panel.name} already follows its lattice: apply or discard that first")
            return False
        return context.mode == 'EDIT_LATTICE' and active.reflection_lines.panel is not None \
            or Tool.poll.__func__(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.view_layer.update()
        active = context.view_layer.objects.active
        mode = active.mode
        try:
            panel = self.prepared(context, active)
        except Refusal as refusal:
            context.view_layer.objects.active = active
            bpy.ops.object.mode_set(mode=mode)
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        self.begin(context, bpy.data.objects[panel.name], panel)
        return {'FINISHED'}

    def prepared(self, context: bpy.types.Context, active: bpy.types.Object) -> Panel:
        """In Object Mode."""
        settings = context.scene.reflection_lines
        lattice.chosen(context.scene)
        ob = None
        if active.type == 'MESH' and active.mode == 'EDIT':
            ob = gather.subjects(context)[0]
            refuse_keys(ob, settings.result)
            apply.keep_region(ob, panels.gathered(ob, settings.solve_for, settings.result))
        leave_edit_mode(context)
        ob = ob or gather.subjects(context)[0]
        refuse_keys(ob, settings.result)
        return panels.gathered(ob, settings.solve_for, settings.result)

    def begin(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> None:
        settings = context.scene.reflection_lines
        start.keep(ob, panel)
        settings.live.panel, settings.live.solve_for, settings.live.result = ob, settings.solve_for, settings.result
        for other in context.selected_objects:
            other.select_set(False)
        settings.warp.lattice.select_set(True)
        context.view_layer.objects.active = settings.warp.lattice
        handlers.changed(context.scene)


class REFLINES_OT_apply_live_warp(LiveEnd, bpy.types.Operator):
    """Keep the shape that the lattice gives the panel, and end the live warp"""
    bl_idname = "reflines.apply_live_warp"
    bl_label = "Apply"

    def finish(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        about.refuse_changed(ob)
        solution = self.solution(scene, ob)
        panel = solution.panel
        apply.show(ob, panel, apply.local(panel, solution.positions), apply.now(ob, panel))
        session.remember(solution.last())
        stored = ob.reflection_lines
        stored.center = panel.local_center
        shown = (*keys.remarks(ob, panel.key), *modifiers.remarks(ob, scene.reflection_lines.live.solve_for))
        stored.report.fill(solution, (*solution.notes, *warp.remarks(solution.target), *shown))
        stored.run.note("REFLINES_OT_warp", about.operator_settings(scene), ob.data, panel.key)
        for note in stored.report.notes.splitlines():
            self.report({'WARNING'}, f"{ob.name}: {note}")
        self.report({'INFO'}, f"{ob.name}: {stored.report.summary()}")  # the status bar shows the last one

    def solution(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> solving.Solution:
        follower = session.live_warps.get(scene.name)
        if follower is not None and follower.is_settled(scene, ob):
            return follower.solution
        wish, ground = about.wanted(scene), about.ground(scene, ob)
        handlers.end(scene)
        solution = session.solve(ground.panel, ground.view, about.solve_settings(scene), about.build(wish))
        session.keep_few({ob.name})
        return solution


class REFLINES_OT_discard_live_warp(LiveEnd, bpy.types.Operator):
    """Take the panel back to the shape it had when the live warp began, to the last bit, and end the live warp"""
    bl_idname = "reflines.discard_live_warp"
    bl_label = "Discard"

    def finish(self, _scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        about.refuse_another(ob)
        start.restore(ob)


register, unregister = bpy.utils.register_classes_factory([
    REFLINES_OT_start_live_warp, REFLINES_OT_apply_live_warp, REFLINES_OT_discard_live_warp])
