"""The modal part of the operators that sweep: two angles follow the mouse until a key keeps them or takes them back."""
from math import radians

import bpy

from ..view.light_angles import TILT_LIMIT
from . import drag_input, running_operators
from .drag_handles import DragValues, Handle

HANDLES = (
    Handle("turn", "Turn", per_pixel=radians(0.3), low=-1e9, high=1e9, unit='ANGLE'),
    Handle("tilt", "Tilt", per_pixel=radians(0.1), low=-TILT_LIMIT, high=TILT_LIMIT, unit='ANGLE', wheel=True),
)


class Sweep(running_operators.RunningOperator):
    """The modal part of an operator with the properties `turn` and `tilt`. It has `area` and `values` from its begin,
    and gives `apply_angles` and `take_back`, which ends with `end`.
    """
    area: bpy.types.Area
    values: DragValues
    navigates = True         # whether the view can be navigated meanwhile
    release_confirm = False  # see REFLINES_OT_sweep_light

    def apply_angles(self, context: bpy.types.Context) -> None:
        raise NotImplementedError

    def can_go_on(self, _context: bpy.types.Context) -> bool:
        """Returns whether what is swept is still there."""
        return True

    def move_mouse(self, _context: bpy.types.Context, event: bpy.types.Event) -> None:
        """Moves the held value with the mouse, from left to right."""
        self.values.move(event.mouse_x, precise=event.shift)

    def begin_sweep(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.move_mouse(context, event)
        self.follow(context)
        context.workspace.status_text_set(drag_input.describe_keys(self.values))
        return running_operators.begin(self, context)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if drag_input.cancels(event) or not self.can_go_on(context):
            self.take_back(context)
            return {'CANCELLED'}
        if self.navigates and drag_input.navigates(event, self.values):
            return {'PASS_THROUGH'}
        if drag_input.keeps(event, self.values, held=self.release_confirm):
            self.end(context)
            return {'FINISHED'}
        if event.type == 'MOUSEMOVE':
            self.move_mouse(context, event)
        else:
            drag_input.change_values(self.values, event)
        self.follow(context)
        return {'RUNNING_MODAL'}

    def follow(self, context: bpy.types.Context) -> None:
        self.turn, self.tilt = self.values.values()
        self.apply_angles(context)
        self.area.tag_redraw()  # the numbers in the sidebar too
        self.area.header_text_set(f"{drag_input.describe_values(self.values, context.scene)}   ({self.bl_label})")

    def end(self, context: bpy.types.Context) -> None:
        running_operators.end(self, context)
        self.area.header_text_set(None)
