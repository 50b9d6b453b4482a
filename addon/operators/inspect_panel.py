"""The operator Inspect."""
import bpy
from bpy.props import EnumProperty

from ..interactive import read_picture
from ..interactive.beside_blender import PanelWork
from ..interactive.inspection_job import InspectionJob
from ..model.inspection import Inspection
from ..model.refusal import Refusal
from ..native_call import run_now
from ..solver import live_optimizer, panel_inspection
from ..solver.panel_inspection import Inspected
from ..view import read_light_set, view_and_light

LIGHTS = (
    ('WALK', "Walk Around", "The light in eight turns, from five views around the panel"),
    ('SET', "The Set", "The lights of the scene's set, each with its own view"),
)


class REFLINES_OT_inspect(PanelWork[Inspection], bpy.types.Operator):
    """Find the panel's worst spots: how even its lines are in eight lights from five views around it, or in the lights
of the set. Nothing is changed; Esc cancels"""
    bl_idname = "reflines.inspect"
    bl_label = "Inspect"
    bl_options = {'REGISTER', 'UNDO'}
    verb = "inspect"

    lights: EnumProperty(name="Lights", items=LIGHTS, default='WALK', options={'HIDDEN', 'SKIP_SAVE'},
                         description="In which lights and from where the panel is looked at")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return view_and_light.has_seen_panel(cls, context)

    def look_at(self, context: bpy.types.Context, ob: bpy.types.Object) -> Inspection:
        wanted = self.read(context, ob)
        with live_optimizer.convert_native_errors(wanted.patch):
            return run_now(panel_inspection.inspect_surface(wanted))

    def read(self, context: bpy.types.Context, ob: bpy.types.Object) -> Inspected:
        """Reads the region, all around it, and the view; refuses what cannot be inspected."""
        settings = context.scene.reflection_lines
        patch, surface, seen = read_picture.read_panel(context, ob)
        up = view_and_light.read_camera_axes(settings.camera)[1]
        light_set = read_light_set.read_light_set(settings, [ob]) if self.lights == 'SET' else None
        if self.lights == 'SET' and light_set is None:
            raise Refusal("The set has no light that can be used: add one, or walk around")
        return Inspected(surface, seen, up, patch, light_set)

    def build_job(self, context: bpy.types.Context, ob: bpy.types.Object) -> InspectionJob:
        return InspectionJob(self.read(context, ob))

    def describe_end(self) -> str:
        return "Inspect was cancelled"

    def store(self, ob: bpy.types.Object, outcome: Inspection) -> None:
        stored = ob.reflection_lines.inspection
        stored.fill(outcome, panel_inspection.NOISE_FLOOR)
        self.report({'INFO'}, f"{ob.name}: {stored.summary}")
