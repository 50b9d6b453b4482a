"""The gizmo that drags the divider between the shapes before and after the last solve, pressed on its line.

overlay/legend.py draws it, since Blender draws what is over the view after the gizmos.
"""
import bpy
from mathutils import Vector

from ..overlay import legend
from ..state import compared
from ..view import view_region

GRIP = 6.0  # pixels beside the line that still take it, times the interface's scale
# Tools and modes in which a press on the panel does something, so that there the knob alone takes the line.
PRESSING = {"reflection_lines.pull_line", "reflection_lines.draw_highlight", "reflection_lines.fair_brush"}
MODES = {'OBJECT', 'EDIT_MESH'}


class REFLINES_GT_divider(bpy.types.Gizmo):
    """The line that is dragged. Escape or a right click puts it back."""
    bl_idname = "REFLINES_GT_divider"

    def setup(self) -> None:
        self.use_draw_modal = True
        self.began = compared.MIDDLE

    def draw(self, _context: bpy.types.Context) -> None:
        compared.NOW.taken = self.is_highlight or self.is_modal

    def test_select(self, context: bpy.types.Context, location: tuple[float, float]) -> int:
        """Returns 0 for a place (pixels of the region) near the line or, where the tool presses too, its knob; else -1.
        """
        x, scale = compared.find_divider(context.region), context.preferences.system.ui_scale
        if x is None:
            return -1
        knob = Vector((x, legend.LOW * scale))
        near = abs(location[0] - x) <= GRIP * scale and is_line_free(context)
        return 0 if near or (Vector(location) - knob).length <= (legend.KNOB + GRIP) * scale else -1

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self.began = compared.NOW.fraction
        context.window.cursor_modal_set('MOVE_X')
        return {'RUNNING_MODAL'}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event, _tweak: set[str]) -> set[str]:
        compared.move_divider(context.region, event.mouse_region_x)
        view_region.redraw_views(context)
        return {'RUNNING_MODAL'}

    def exit(self, context: bpy.types.Context, cancel: bool) -> None:
        context.window.cursor_modal_restore()
        if cancel:
            compared.NOW.fraction = self.began
        view_region.redraw_views(context)


class VIEW3D_GGT_reflines_divider(bpy.types.GizmoGroup):
    """The divider of every 3D view, with any tool."""
    bl_idname = "VIEW3D_GGT_reflines_divider"
    bl_label = "Before and After"
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'WINDOW'
    bl_options = {'PERSISTENT'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        stripes = context.scene.reflection_lines.stripes
        return stripes.show and stripes.before and stripes.side_by_side

    def setup(self, _context: bpy.types.Context) -> None:
        self.gizmos.new(REFLINES_GT_divider.bl_idname)


def is_line_free(context: bpy.types.Context) -> bool:
    """Returns whether a press on the line is not one that the tool is waiting for."""
    tool = context.workspace.tools.from_space_view3d_mode(context.mode, create=False)
    return context.mode in MODES and (tool is None or tool.idname not in PRESSING)
