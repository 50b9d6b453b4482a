"""Fair Brush."""
import bpy

from ..blender import units
from ..interactive import running_operators
from ..interactive.brush_stroke import BrushedObject, BrushStroke
from ..model.refusal import Refusal
from ..model.solution import SolveSettings
from ..solver import limited_solve
from ..solver.brush import WIDEST, Brush
from ..ui.tool_properties import BrushSettings, limit_property, lights_property
from .solve_tool import SolveTool

TOOL = "reflection_lines.fair_brush"  # in the toolbar
LOWER = 0.25  # factor of the strength while Shift is held
CANCEL_KEYS = {'ESC', 'RIGHTMOUSE'}


class REFLINES_OT_fair_brush(running_operators.RunningOperator, SolveTool, BrushSettings, bpy.types.Operator):
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
        """Takes the objects below the brush; refuses where none can be brushed."""
        self.result = 'MESH'
        objects, self.refusals = [], []
        for ob in self.find_subjects(context):  # refuses where no face is selected
            try:
                objects.append(BrushedObject(context, ob, self.gather_patch(ob), self.settle_border()))
            except Refusal as refusal:
                self.refusals.append(refusal)
        if not objects:
            raise self.refusals[0]
        self.stroke, self.panels = BrushStroke(context.area, objects), [each.patch for each in objects]
        widest = max((each.patch for each in objects), key=lambda patch: patch.diagonal)
        length = context.scene.reflection_lines.length or WIDEST * widest.diagonal
        settings = SolveSettings(self.settle_border(), length, self.limit, limit_length=length)
        limit = limited_solve.choose_limit(widest, settings)
        self.brush = Brush(0.0, self.strength, length, limit, 1 if self.lights == 'SINGLE' else 2)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        changed = self.stroke.find_changed()
        if changed is not None:
            self.stroke.restore()
            return self.end(context, f"{changed.name} was changed during the stroke: it is left as it is now")
        if event.type in CANCEL_KEYS and event.value == 'PRESS':
            self.stroke.restore()
            return self.end(context, "")
        if event.type in {'MOUSEMOVE', 'INBETWEEN_MOUSEMOVE'}:
            try:
                self.paint(context, event)
            except Refusal as refusal:
                self.stroke.restore()
                return self.end(context, str(refusal))
        elif event.type == 'LEFTMOUSE' and event.value == 'RELEASE':
            return self.finish(context)
        return {'RUNNING_MODAL'}

    def paint(self, context: bpy.types.Context, event: bpy.types.Event) -> None:
        """Dabs up to where the mouse is, with less strength while Shift is held, and by a tablet's pressure."""
        strength = self.strength * (LOWER if event.shift else 1.0) * (event.pressure if event.is_tablet else 1.0)
        brush = Brush(0.0, strength, self.brush.length, self.brush.limit, self.brush.families)
        self.stroke.move_to(event.mouse_x, event.mouse_y, self.size, brush)
        context.area.header_text_set(f"{self.describe(context)}   ({self.bl_label})")

    def describe(self, context: bpy.types.Context) -> str:
        moved = units.format_length(self.stroke.largest_move, context.scene, precision=2)
        return f"Moved at most {moved}" if self.stroke.list_moved() else "No vertices under the brush that can move"

    def finish(self, context: bpy.types.Context) -> set[str]:
        moved = self.stroke.list_moved()
        for refusal in self.refusals:
            self.report({'WARNING'}, f"Left as it is: {refusal}")
        if not moved:
            names = ", ".join(each.name for each in self.stroke.objects)
            return self.end(context, f"{names}: the brush met no vertices that can move: make it larger (F), or "
                            "paint on the selected faces")
        solutions = [(bpy.data.objects[each.name], each.summarize()) for each in moved]
        self.end(context, "")
        for ob, solution in solutions:
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

    def take_back(self, context: bpy.types.Context) -> None:
        """Restores the meshes, where nobody else has changed them, and ends the stroke."""
        self.stroke.restore()
        self.end(context, "")
