"""The operator Live Warp, which starts, applies and discards it."""
from functools import partial

import bpy
from bpy.props import EnumProperty

from ..blender.tooltips import tell_by
from ..interactive import live_baseline, live_warp_handlers
from ..interactive.live_baseline import BaselineChanged
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import Solution
from ..read import gather, modifiers, read_mesh, scene_objects, shape_keys
from ..state import optimizer_cache, solve_history
from ..targets import warp
from ..write import keep_region, live_warp_start, warp_lattice, write_mesh
from .solve_tool import is_ready


class LiveWarpEnd:
    """The part of the operator that ends a live warp, in Object Mode, so that one undo takes it back."""

    def end(self, context: bpy.types.Context) -> set[str]:
        """Keeps the panel's shape, or takes it back."""
        enter_object_mode(context)
        context.view_layer.update()
        scene = context.scene
        try:
            (self.apply if self.action == 'APPLY' else self.discard)(scene, live_baseline.find_subject(scene))
        except BaselineChanged as changed:
            self.report({'WARNING'}, str(changed))
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        live_warp_start.remove_start(scene.reflection_lines.live.panel)
        scene.reflection_lines.live.panel = None
        live_warp_handlers.end_live_warp(scene)
        return {'FINISHED'}

    def apply(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        """Writes the shape that the lattice gives the panel."""
        live_baseline.refuse_changed(ob)
        solution = self.find_solution(scene, ob)
        patch = solution.patch
        write_mesh.write_positions(ob, patch, patch.to_object_space(solution.positions),
                                   read_mesh.read_patch_positions(ob, patch))
        solve_history.remember_solve(solution.to_last_solve())
        stored = ob.reflection_lines
        stored.center = patch.local_center
        shown = (*shape_keys.describe_hidden_key(ob, patch.key),
                 *modifiers.describe_unsolved_modifiers(ob))
        stored.report.fill(solution, (*solution.notes, *warp.describe_outside(solution.target), *shown))
        stored.run.note("REFLINES_OT_warp", live_baseline.read_operator_settings(scene), ob.data, patch.key)
        for note in stored.report.notes.splitlines():
            self.report({'WARNING'}, f"{ob.name}: {note}")
        self.report({'INFO'}, f"{ob.name}: {stored.report.headline()}")  # the status bar shows the last report

    def find_solution(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> Solution:
        """Returns the live warp's own solution where it is final, else solves from the start."""
        live = live_warp_handlers.find_live_warp(scene)
        if live is not None and live.is_settled(scene, ob):
            return live.solution
        wanted, baseline = live_baseline.read_warp(scene), live_baseline.read_baseline(scene, ob)
        live_warp_handlers.end_live_warp(scene)
        settings = live_baseline.read_solve_settings(scene, final=True)
        solution = optimizer_cache.solve_with_cache(baseline.patch, baseline.view, settings,
                                                    partial(warp.build_warp_target, settings=wanted))
        optimizer_cache.drop_surplus({ob.name})
        return solution

    def discard(self, _scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        """Writes the shape of the start, to the last bit."""
        live_baseline.refuse_other_mesh(ob)
        live_warp_start.restore_start(ob)


def enter_object_mode(context: bpy.types.Context) -> None:
    if context.mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')


def refuse_keys(ob: bpy.types.Object, result: str) -> None:
    """Refuses other shape keys, which other tools take in Edit Mode: a live warp runs in Object Mode."""
    if result == 'MESH' and ob.data.shape_keys is not None:
        raise Refusal(f"{ob.name} has shape keys, and a live warp can change none but its own: "
                      "choose the result Shape Key")


ACTIONS = (
    ('START', "Start", "Let the panel follow its warp lattice while you edit that with Blender's own tools"),
    ('APPLY', "Apply", "Keep the shape that the lattice gives the panel, and end the live warp"),
    ('DISCARD', "Discard", "Take the panel back to the shape it had when the live warp began, to the last bit"),
)


class REFLINES_OT_live_warp(LiveWarpEnd, bpy.types.Operator):
    """Let the panel follow its warp lattice while you edit that with Blender's own tools. Apply keeps the panel's
shape, Discard takes it back; both can wait until the file is opened again"""
    bl_idname = "reflines.live_warp"
    bl_label = "Live Warp"
    bl_options = {'REGISTER', 'UNDO'}

    action: EnumProperty(name="Action", items=ACTIONS, default='START', options={'HIDDEN', 'SKIP_SAVE'})

    description = tell_by("action", {action: about for action, _, about in ACTIONS[1:]})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.view_layer.objects.active
        return (context.scene.reflection_lines.live.panel is not None
                or context.mode == 'EDIT_LATTICE' and active.reflection_lines.panel is not None
                or is_ready(cls, context))

    def execute(self, context: bpy.types.Context) -> set[str]:
        panel = context.scene.reflection_lines.live.panel
        if (panel is None) == (self.action == 'START'):
            return self.start(context) if self.action == 'START' else self.end(context)
        self.report({'ERROR'}, "There is no live warp in this scene: press Live Warp" if panel is None else
                    f"{panel.name} already follows its lattice: apply or discard that first")
        return {'CANCELLED'}

    def start(self, context: bpy.types.Context) -> set[str]:
        """Begins a live warp; after a refusal all is as it was."""
        context.view_layer.update()
        active = context.view_layer.objects.active
        mode = active.mode
        try:
            patch = self.prepare(context, active)
        except Refusal as refusal:
            context.view_layer.objects.active = active
            if active.mode != mode:  # of a hidden or linked object no mode can be set, not even the one it is in
                bpy.ops.object.mode_set(mode=mode)
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        self.begin(context, bpy.data.objects[patch.name], patch)
        return {'FINISHED'}

    def prepare(self, context: bpy.types.Context, active: bpy.types.Object) -> Patch:
        """Gathers the patch in Object Mode, storing the selected faces as the region before."""
        settings = context.scene.reflection_lines
        warp_lattice.find_lattice(context.scene)
        ob = None
        if active.type == 'MESH' and active.mode == 'EDIT':
            ob = scene_objects.find_subjects(context)[0]
            refuse_keys(ob, settings.result)
            keep_region.keep_region(ob, gather.gather_patch(ob, settings.result))
        enter_object_mode(context)
        ob = ob or scene_objects.find_subjects(context)[0]
        refuse_keys(ob, settings.result)
        return gather.gather_patch(ob, settings.result)

    def begin(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> None:
        settings = context.scene.reflection_lines
        live_warp_start.store_start(ob, patch)
        settings.live.panel, settings.live.result = ob, settings.result
        for other in context.selected_objects:
            other.select_set(False)
        settings.warp.lattice.select_set(True)
        context.view_layer.objects.active = settings.warp.lattice
        live_warp_handlers.note_change(context.scene)
