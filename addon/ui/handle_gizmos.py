"""The gizmos of the handles that are kept with an object: a dot each, which starts Pull Line with that dot in hand.

They stand where the handles were put, which is beside the surface by as much as it moved since then along the view.
What the mouse does, and the dots while it does so, are the operator's.
"""
import bpy
from mathutils import Matrix, Vector

from ..interactive import drag, handle_tracing
from ..model.line_handle import Handles
from ..model.refusal import Refusal

SCALE = 0.1  # of the size of gizmos in the preferences: as large as the dots of a session
HIGHLIGHT = (1.0, 1.0, 1.0)
DRAWING = "reflection_lines.draw_highlight"  # the tool whose further presses draw lines


class VIEW3D_GGT_reflines_handles(bpy.types.GizmoGroup):
    """The dots of the active object's kept handles, for the tools that pull and draw lines."""
    bl_idname = "VIEW3D_GGT_reflines_handles"
    bl_label = "Handles on Lines"
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'WINDOW'
    bl_options = {'3D'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        return ob is not None and ob.type == 'MESH' and bool(ob.reflection_lines.handles.text)

    def setup(self, _context: bpy.types.Context) -> None:
        self.dots: list[tuple[bpy.types.Gizmo, bpy.types.OperatorProperties]] = []
        self.placed = 0         # number of them that stand at a dot
        self.key: tuple = ()    # what they were placed for

    def draw_prepare(self, context: bpy.types.Context) -> None:
        """Places the dots where something has changed, and hides them while a tool is dragged, which draws its own."""
        ob = context.view_layer.objects.active
        tool = context.workspace.tools.from_space_view3d_mode(context.mode, create=False)
        draws = tool is not None and tool.idname == DRAWING
        kept = ob.reflection_lines.handles  # a frame may change the values
        key = kept.text, kept.read_values(), len(ob.data.vertices), [*map(tuple, ob.matrix_world)], draws
        if key != self.key:
            self.key = key
            self.place_dots(read_handles(ob), ob.matrix_world, draws=draws)
        away = drag.is_running() or not bpy.ops.reflines.pull_line.poll()
        for number, (gizmo, _) in enumerate(self.dots):
            gizmo.hide = away or number >= self.placed

    def place_dots(self, handles: Handles, matrix: Matrix, *, draws: bool) -> None:
        """Places a gizmo at each dot, with new ones where they are too few."""
        wanted = [(index, number) for index, each in enumerate(handles) for number in range(len(each.dots))]
        self.dots += [self.add_dot() for _ in range(len(wanted) - len(self.dots))]
        self.placed = len(wanted)
        for (index, number), (gizmo, properties) in zip(wanted, self.dots, strict=False):
            gizmo.matrix_basis = Matrix.Translation(matrix @ Vector(handles[index].dots[number]))
            gizmo.color = handle_tracing.choose_color(handles[index])[:3]
            properties.taken, properties.draws = (index, number), draws

    def add_dot(self) -> tuple[bpy.types.Gizmo, bpy.types.OperatorProperties]:
        """Adds a gizmo that starts Pull Line; returns it with the properties for the operator."""
        gizmo = self.gizmos.new("GIZMO_GT_move_3d")
        gizmo.draw_style, gizmo.draw_options = 'RING_2D', {'ALIGN_VIEW', 'FILL', 'FILL_SELECT'}
        gizmo.color_highlight = HIGHLIGHT
        gizmo.alpha, gizmo.alpha_highlight, gizmo.scale_basis = 0.9, 1.0, SCALE
        return gizmo, gizmo.target_set_operator("reflines.pull_line")


def read_handles(ob: bpy.types.Object) -> Handles:
    """Reads the handles of an object; none where the tool would refuse them."""
    try:
        return ob.reflection_lines.handles.read(ob.data)
    except Refusal:
        return ()
