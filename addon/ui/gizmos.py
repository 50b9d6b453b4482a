"""The gizmos beside the panel: an arrow that drags Smooth Lines, and a ring with a needle that turns the light.

They start the operators that buttons start too; what the mouse does then is the operator's own.
"""
import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..interactive import drag
from ..state import last_panels
from ..view import light_angles, places_beside, view_and_light, view_camera

ARROW_COLOR, LIGHT_COLOR, HIGHLIGHT = (0.35, 0.65, 1.0), (1.0, 0.7, 0.1), (1.0, 1.0, 1.0)
RING_SCALE, ARROW_SCALE, NEEDLE_SCALE = 0.6, 0.8, 0.55  # of the size of gizmos in the preferences
# From the region to the ring's middle, from there to the arrow, and to what covers the view; of the same size.
ASIDE, ABOVE, MARGIN = 0.9, 0.9, 1.4
EDGE_ON = 0.15  # cosine of the view's angle with the ring's axis, below which the ring is seen as a line


class VIEW3D_GGT_reflines(bpy.types.GizmoGroup):
    """The gizmos of the toolbar's tool."""
    bl_idname = "VIEW3D_GGT_reflines"
    bl_label = "Reflection Lines"
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'WINDOW'
    bl_options = {'3D', 'TOOL_FALLBACK_KEYMAP'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return last_panels.find_panel(context) is not None

    def setup(self, _context: bpy.types.Context) -> None:
        self.arrow, drag_properties = self.add_gizmo("GIZMO_GT_arrow_3d", ARROW_COLOR, ARROW_SCALE, "reflines.smooth")
        drag_properties.follow_mouse = True
        self.ring, self.ring_properties = self.add_gizmo("GIZMO_GT_dial_3d", LIGHT_COLOR, RING_SCALE,
                                                         "reflines.sweep_light")
        self.needle, self.needle_properties = self.add_gizmo("GIZMO_GT_arrow_3d", LIGHT_COLOR, NEEDLE_SCALE,
                                                             "reflines.sweep_light")
        self.corners, self.measured = np.zeros((8, 3)), False

    def add_gizmo(self, kind: str, color: tuple[float, float, float], scale: float,
                  operator: str) -> tuple[bpy.types.Gizmo, bpy.types.OperatorProperties]:
        """Adds a gizmo that starts an operator when it is pressed; returns it with the properties for the operator."""
        gizmo = self.gizmos.new(kind)
        gizmo.color, gizmo.color_highlight = color, HIGHLIGHT
        gizmo.alpha, gizmo.alpha_highlight = 0.9, 1.0
        gizmo.scale_basis, gizmo.line_width, gizmo.use_draw_modal = scale, 3.0, True
        properties = gizmo.target_set_operator(operator)
        properties.release_confirm = True
        return gizmo, properties

    def refresh(self, context: bpy.types.Context) -> None:
        """Measures the region again; not during a drag, in which the gizmos stay beside it."""
        ob = last_panels.find_panel(context)
        if ob is not None and not (self.measured and drag.is_running()):
            self.corners, self.measured = places_beside.measure_corners(view_camera.read_framed_points(ob)), True

    def draw_prepare(self, context: bpy.types.Context) -> None:
        """Places the gizmos for the present view, and hides those that can do nothing."""
        size = context.preferences.view.gizmo_size * context.preferences.system.ui_scale
        region, region_3d = context.region, context.region_data
        place = places_beside.find_place(context.area, region, region_3d, self.corners, aside=ASIDE * size,
                                         margin=MARGIN * size)
        above = place + Vector((-0.5 * ARROW_SCALE * size, ABOVE * size))
        view_axes = region_3d.view_matrix.to_3x3().transposed()
        self.place_arrow(places_beside.find_point(region, region_3d, above, self.corners), view_axes)
        self.place_light(context.scene.reflection_lines,
                         places_beside.find_point(region, region_3d, place, self.corners), view_axes)

    def place_arrow(self, point: Vector, view_axes: Matrix) -> None:
        """Places the arrow along the view's horizontal, as the mouse goes in the drag."""
        right, up, back = view_axes.col
        self.arrow.matrix_basis = Matrix.Translation(point) @ Matrix((up, back, right)).transposed().to_4x4()
        self.arrow.hide = not bpy.ops.reflines.smooth.poll()

    def place_light(self, settings: bpy.types.PropertyGroup, point: Vector, view_axes: Matrix) -> None:
        """Places the ring in the plane of the view camera's picture, and the needle along the light."""
        axes = light_angles.read_picture_axes(settings.picture_camera())
        fixed = bool(settings.explain_fixed_light())
        self.needle.hide = self.ring.hide = fixed or abs(view_axes.col[2] @ axes.col[2]) < EDGE_ON
        self.ring.matrix_basis = Matrix.Translation(point) @ axes.to_4x4()
        self.ring_properties.around = self.needle_properties.around = point
        if not fixed:
            along = settings.light.matrix_world.to_3x3().col[2]
            self.needle.matrix_basis = Matrix.Translation(point) @ view_and_light.build_frame(along).to_4x4()
