"""Fair Brush."""
import bpy

from ..blender import units
from ..interactive import running_operators
from ..interactive.brush_stroke import BrushStroke
from ..model.refusal import Refusal
from ..model.solution import SolveSettings
from ..read import scene_objects
from ..solver import limited_solve
from ..solver.brush import WIDEST, Brush
from ..ui.tool_properties import BrushSettings, limit_property, lights_property
from .solve_tool import SolveTool

TOOL = "reflection_lines.fair_brush"  # in the toolbar
LOWER = 0.25  # factor of the strength while Shift is held
CANCEL_KEYS = {'ESC', 'RIGHTMOUSE'}


class REFLINES_OT_fair_brush(SolveTool, BrushSettings, bpy.types.Operator):
    """Paint over flaws with the mouse: the lines under the brush become smoother in both lights, the rest stays"""
    bl_idname = "reflines.fair_brush"
    bl_label = "Fair Brush"
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING'}
    needs_faces = False  # a press in the view says what is missing

    lights: lights_property()
    limit: limit_property()

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.brush

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.label(text="A stroke cannot be adjusted: undo it, and paint again")

    def execute(self, _context: bpy.types.Context) -> set[str]:
        self.report({'ERROR'}, "Fair Brush paints with the mouse: press in a 3D view and drag over the panel")
        return {'CANCELLED'}

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begins a stroke by a press in the view; from a button or a menu the tool becomes the active one."""
        if context.area is None or context.area.type != 'VIEW_3D':
            return self.execute(context)
        if event.type != 'LEFTMOUSE' or event.value != 'PRESS' or context.region.type != 'WINDOW':
            bpy.ops.wm.tool_set_by_id(name=TOOL)
            return {'CANCELLED'}
        context.view_layer.update()
        self.copy_settings(context.scene)
        try:
            self.begin_stroke(context)
            self.paint(context, event)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        return running_operators.begin(self, context)

    def begin_stroke(self, context: bpy.types.Context) -> None:
        self.find_subjects(context)  # refuses where no face is selected
        ob = scene_objects.find_active_object(context)
        self.result = 'MESH'
        patch = self.gather_patch(ob)
        self.subject, self.stroke = ob.name, BrushStroke(context, ob, patch, self.border)
        length = context.scene.reflection_lines.length or WIDEST * patch.diagonal
        limit = limited_solve.choose_limit(patch, SolveSettings(self.border, length, self.limit, limit_length=length))
        self.brush = Brush(0.0, self.strength, length, limit, 1 if self.lights == 'SINGLE' else 2)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        ob = bpy.data.objects.get(self.subject)
        if self.stroke.is_changed(ob):
            return self.end(context, f"{self.subject} was changed during the stroke: it is left as it is now")
        if event.type in CANCEL_KEYS and event.value == 'PRESS':
            self.stroke.restore(ob)
            return self.end(context, "")
        if event.type in {'MOUSEMOVE', 'INBETWEEN_MOUSEMOVE'}:
            try:
                self.paint(context, event)
            except Refusal as refusal:
                self.stroke.restore(ob)
                return self.end(context, str(refusal))
        elif event.type == 'LEFTMOUSE' and event.value == 'RELEASE':
            return self.finish(context, ob)
        return {'RUNNING_MODAL'}

    def paint(self, context: bpy.types.Context, event: bpy.types.Event) -> None:
        """Dabs up to where the mouse is, with less strength while Shift is held, and by a tablet's pressure."""
        strength = self.strength * (LOWER if event.shift else 1.0) * (event.pressure if event.is_tablet else 1.0)
        brush = Brush(0.0, strength, self.brush.length, self.brush.limit, self.brush.families)
        self.stroke.move_to(bpy.data.objects[self.subject], event.mouse_x, event.mouse_y, self.size, brush)
        context.area.header_text_set(f"{self.describe(context)}   ({self.bl_label})")

    def describe(self, context: bpy.types.Context) -> str:
        moved = units.format_length(self.stroke.largest_move, context.scene, precision=2)
        return f"Moved at most {moved}" if self.stroke.dabs else "No vertices under the brush that can move"

    def finish(self, context: bpy.types.Context, ob: bpy.types.Object) -> set[str]:
        if not self.stroke.dabs:
            return self.end(context, f"{ob.name}: the brush met no vertices that can move: make it larger (F), or "
                            "paint on the selected faces")
        solution = self.stroke.summarize()
        self.end(context, "")
        self.record_solution(ob, solution)
        context.area.tag_redraw()  # the last drawing was of the mesh alone
        return {'FINISHED'}

    def end(self, context: bpy.types.Context, why: str) -> set[str]:
        """Ends the stroke and drops it: Blender keeps the operator."""
        running_operators.end(self, context)
        self.stroke.area.header_text_set(None)
        self.stroke = None
        if why:
            self.report({'WARNING'}, why)
        return {'CANCELLED'}

    def cancel(self, context: bpy.types.Context) -> None:
        """Restores the mesh when Blender exits or opens another file."""
        self.take_back(context)

    def take_back(self, context: bpy.types.Context) -> None:
        """Restores the mesh, where nobody else has changed it, and ends the stroke."""
        ob = bpy.data.objects.get(self.subject)
        if not self.stroke.is_changed(ob):
            self.stroke.restore(ob)
        self.end(context, "")


register, unregister = running_operators.make_registration(REFLINES_OT_fair_brush)
