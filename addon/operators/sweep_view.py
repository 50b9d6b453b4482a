"""The operator Sweep View: a turntable."""
from copy import copy
from math import radians

import bpy
from bpy.props import FloatProperty
from mathutils import Quaternion, Vector

from ..bridge import scene_objects, view_and_light
from ..interactive import drag_input, running_operators
from ..interactive.drag_handles import Handle

TILT_LIMIT = radians(85.0)
HANDLES = (
    Handle("turn", "Turn", per_pixel=radians(0.3), low=-1e9, high=1e9, unit='ANGLE'),
    Handle("tilt", "Tilt", per_pixel=radians(0.1), low=-TILT_LIMIT, high=TILT_LIMIT, unit='ANGLE', wheel=True),
)
KEPT = ("view_rotation", "view_location", "view_distance", "view_perspective")  # of the 3D view


class REFLINES_OT_sweep_view(bpy.types.Operator):
    """Walk the view around the panel with the mouse while the stripes slide over it, in any mode: left and right turn
it about the vertical, the wheel tilts it; the lights stay where they are"""
    bl_idname = "reflines.sweep_view"
    bl_label = "Sweep View"
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING', 'GRAB_CURSOR'}

    turn: FloatProperty(name="Turn", subtype='ANGLE', options={'SKIP_SAVE'},
                        description="Of the view about the vertical, from where it is")
    tilt: FloatProperty(name="Tilt", subtype='ANGLE', min=-TILT_LIMIT, max=TILT_LIMIT, options={'SKIP_SAVE'},
                        description="Of the view up or down, from where it is")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        cls.poll_message_set("Make the panel's mesh active, in a 3D view")
        return ob is not None and ob.type == 'MESH' and getattr(context.space_data, "region_3d", None) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        self.begin(context)
        self.turn_view()
        return {'FINISHED'}

    def begin(self, context: bpy.types.Context) -> None:
        """Keeps how the view is, and lets the stripes be seen from it."""
        self.area, self.region_3d = context.area, context.space_data.region_3d
        self.center = view_and_light.measure_extent(scene_objects.read_active_object(context))[0]
        self.kept = {name: copy(getattr(self.region_3d, name)) for name in KEPT}
        self.start = self.region_3d.view_matrix.inverted().to_quaternion()
        stripes = context.scene.reflection_lines.stripes
        self.eye, stripes.eye = stripes.eye, 'VIEWPORT'

    def turn_view(self) -> None:
        """Turns the view around the panel's middle, by the angles from where it was."""
        if self.region_3d.view_perspective == 'CAMERA':
            self.region_3d.view_perspective = 'PERSP'
        around, up = Quaternion(Vector((0.0, 0.0, 1.0)), self.turn), Quaternion(Vector((1.0, 0.0, 0.0)), -self.tilt)
        self.region_3d.view_location = self.center
        self.region_3d.view_rotation = around @ self.start @ up

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.begin(context)
        self.values = drag_input.read_values(HANDLES, (self.turn, self.tilt), context.scene)
        self.values.move(event.mouse_x, precise=event.shift)
        self.follow(context)
        context.workspace.status_text_set(drag_input.describe_keys(self.values))
        context.window_manager.modal_handler_add(self)
        running_operators.note_begin(self)
        return {'RUNNING_MODAL'}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if drag_input.cancels(event):
            self.take_back(context)
            return {'CANCELLED'}
        if drag_input.keeps(event, self.values, held=False):
            self.end(context)
            return {'FINISHED'}
        if event.type == 'MOUSEMOVE':
            self.values.move(event.mouse_x, precise=event.shift)
        else:
            drag_input.change_values(self.values, event)
        self.follow(context)
        return {'RUNNING_MODAL'}

    def follow(self, context: bpy.types.Context) -> None:
        self.turn, self.tilt = self.values.values()
        self.turn_view()
        self.area.tag_redraw()
        self.area.header_text_set(f"{drag_input.describe_values(self.values, context.scene)}   ({self.bl_label})")

    def take_back(self, context: bpy.types.Context) -> None:
        """Turns the view back, and ends the sweep."""
        for name, value in self.kept.items():
            setattr(self.region_3d, name, value)
        context.scene.reflection_lines.stripes.eye = self.eye
        self.end(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Turns the view back when Blender exits or opens another file."""
        self.take_back(context)

    def end(self, context: bpy.types.Context) -> None:
        running_operators.note_end(self)
        self.area.header_text_set(None)
        context.workspace.status_text_set(None)


register, unregister_classes = bpy.utils.register_classes_factory([REFLINES_OT_sweep_view])


def unregister() -> None:
    running_operators.take_back(REFLINES_OT_sweep_view)
    unregister_classes()
