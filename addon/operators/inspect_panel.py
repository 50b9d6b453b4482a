"""The operator Inspect."""
import bpy
import numpy as np
from bpy.props import EnumProperty

from ..interactive import running_operators
from ..interactive.inspection_job import InspectionJob, InspectionOutcome, InspectionRequest
from ..model.inspection import Inspection
from ..model.refusal import Refusal, report_refusals
from ..native_call import run_now
from ..read import gather, read_checked, read_mesh, scene_objects
from ..read.mesh_checks import Purpose
from ..solver import live_optimizer, panel_inspection
from ..solver.panel_inspection import Inspected
from ..view import facing, read_light_set, view_and_light

TICK_INTERVAL = 0.05  # seconds between two looks at the work
LIGHTS = (
    ('WALK', "Walk Around", "The light in eight turns, from five views around the panel"),
    ('SET', "The Set", "The lights of the scene's set, each with its own view"),
)


class REFLINES_OT_inspect(bpy.types.Operator):
    """Find the panel's worst spots: how even its lines are in eight lights from five views around it, or in the lights
of the set. Nothing is changed; Esc cancels"""
    bl_idname = "reflines.inspect"
    bl_label = "Inspect"
    bl_options = {'REGISTER', 'UNDO'}

    lights: EnumProperty(name="Lights", items=LIGHTS, default='WALK', options={'SKIP_SAVE'},
                         description="In which lights and from where the panel is looked at")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return view_and_light.has_seen_panel(cls, context)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = scene_objects.read_active_object(context)
        request = self.build_request(context, ob)
        with live_optimizer.convert_native_errors(request.patch):
            found = run_now(panel_inspection.inspect_surface(request.wanted))
        self.store(ob, found)
        return {'FINISHED'}

    def build_request(self, context: bpy.types.Context, ob: bpy.types.Object) -> InspectionRequest:
        """Reads the region, all around it, and the view; refuses what cannot be inspected."""
        context.view_layer.update()
        settings = context.scene.reflection_lines
        patch = gather.gather_patch(ob, settings.solve_for, 'MESH', or_all=True, purpose=Purpose.READ)
        with live_optimizer.convert_native_errors(patch):
            surface = read_checked.read_checked_surface(ob, patch, patch.V)
        up = view_and_light.read_camera_axes(settings.camera)[1]
        light_set = read_light_set.read_light_set(settings, [ob]) if self.lights == 'SET' else None
        if self.lights == 'SET' and light_set is None:
            raise Refusal("The set has no light that can be used: add one, or walk around")
        wanted = Inspected(surface, facing.read_patch_view(context.scene, patch), up, patch.center, light_set)
        return InspectionRequest(patch, wanted)

    def store(self, ob: bpy.types.Object, found: Inspection) -> None:
        stored = ob.reflection_lines.inspection
        stored.fill(found, panel_inspection.NOISE_FLOOR)
        self.report({'INFO'}, f"{ob.name}: {stored.summary}")

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Inspects beside Blender, which goes on meanwhile."""
        if context.area is None or context.area.type != 'VIEW_3D':
            return self.execute(context)
        ob = scene_objects.read_active_object(context)
        try:
            request = self.build_request(context, ob)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        self.panel, self.shape = ob.name, read_mesh.read_shown_coordinates(ob)
        self.job = InspectionJob(request)
        return running_operators.begin(self, context, TICK_INTERVAL)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == 'ESC' and event.value == 'PRESS':
            self.take_back(context)
            self.report({'INFO'}, "Inspect was cancelled")
            return {'CANCELLED'}
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        outcome = self.job.work.take()
        if outcome is None and self.job.work.is_alive():
            context.workspace.status_text_set(self.job.describe())
            return {'RUNNING_MODAL'}
        self.end(context)
        return self.take_outcome(outcome or InspectionOutcome(refusal="The inspection stopped: nothing was found"))

    def take_outcome(self, outcome: InspectionOutcome) -> set[str]:
        ob = bpy.data.objects.get(self.panel)
        refusal = outcome.refusal
        if not refusal and not self.is_same(ob):
            refusal = f"{self.panel} was changed while it was inspected: inspect it again"
        if refusal:
            self.report({'ERROR'}, refusal)
            return {'CANCELLED'}
        self.store(ob, outcome.inspection)
        for area in bpy.context.window.screen.areas:
            area.tag_redraw()
        return {'FINISHED'}

    def is_same(self, ob: bpy.types.Object | None) -> bool:
        return ob is not None and ob.type == 'MESH' and np.array_equal(read_mesh.read_shown_coordinates(ob), self.shape)

    def take_back(self, context: bpy.types.Context) -> None:
        """Ends the work without a result."""
        self.job.work.stop()
        self.end(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Ends the work when Blender exits or opens another file."""
        self.take_back(context)

    def end(self, context: bpy.types.Context) -> None:
        running_operators.end(self, context)


register, unregister = running_operators.make_registration(REFLINES_OT_inspect)
