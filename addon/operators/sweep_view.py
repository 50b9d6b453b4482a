"""The operator Sweep View: a turntable."""
from copy import copy

import bpy
from bpy.props import FloatProperty
from mathutils import Quaternion, Vector

from ..interactive import drag_input
from ..interactive.sweep import HANDLES, Sweep
from ..read import scene_objects
from ..view import view_and_light
from ..view.light_angles import TILT_LIMIT

KEPT = ("view_rotation", "view_location", "view_distance", "view_perspective")  # of the 3D view


class REFLINES_OT_sweep_view(Sweep, bpy.types.Operator):
    """Walk the view around the panel with the mouse while the stripes slide over it, in any mode: left and right turn
it about the vertical, the wheel tilts it; the lights stay where they are"""
    bl_idname = "reflines.sweep_view"
    bl_label = "Sweep View"
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING', 'GRAB_CURSOR'}
    navigates = False

    turn: FloatProperty(name="Turn", subtype='ANGLE', options={'HIDDEN', 'SKIP_SAVE'},
                        description="Of the view about the vertical, from where it is")
    tilt: FloatProperty(name="Tilt", subtype='ANGLE', min=-TILT_LIMIT, max=TILT_LIMIT,
                        options={'HIDDEN', 'SKIP_SAVE'},
                        description="Of the view up or down, from where it is")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        cls.poll_message_set("Make the panel's mesh active, in a 3D view")
        return ob is not None and ob.type == 'MESH' and getattr(context.space_data, "region_3d", None) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        self.begin(context)
        self.apply_angles(context)
        return {'FINISHED'}

    def begin(self, context: bpy.types.Context) -> None:
        """Keeps how the view is, and lets the stripes be seen from it."""
        self.area, self.region_3d = context.area, context.space_data.region_3d
        self.center = view_and_light.measure_extent(scene_objects.read_active_object(context))[0]
        self.kept = {name: copy(getattr(self.region_3d, name)) for name in KEPT}
        self.start = self.region_3d.view_matrix.inverted().to_quaternion()
        stripes = context.scene.reflection_lines.stripes
        self.eye, stripes.eye = stripes.eye, 'VIEWPORT'

    def apply_angles(self, _context: bpy.types.Context) -> None:
        """Turns the view around the panel's middle, by the angles from where it was."""
        if self.region_3d.view_perspective == 'CAMERA':
            self.region_3d.view_perspective = 'PERSP'
        around, up = Quaternion(Vector((0.0, 0.0, 1.0)), self.turn), Quaternion(Vector((1.0, 0.0, 0.0)), -self.tilt)
        self.region_3d.view_location = self.center
        self.region_3d.view_rotation = around @ self.start @ up

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.begin(context)
        self.values = drag_input.read_values(HANDLES, (self.turn, self.tilt), context.scene)
        return self.begin_sweep(context, event)

    def take_back(self, context: bpy.types.Context) -> None:
        """Turns the view back, and ends the sweep."""
        for name, value in self.kept.items():
            setattr(self.region_3d, name, value)
        context.scene.reflection_lines.stripes.eye = self.eye
        self.end(context)
