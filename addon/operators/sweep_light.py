"""Sweep Light."""
from math import degrees, radians

import bpy
from bpy.props import FloatProperty

from ..bridge import light_angles
from ..interactive.drag_handles import DragValues, Handle

HANDLES = (
    Handle("turn", "Turn", per_pixel=radians(0.3), low=-1e9, high=1e9, unit='ANGLE'),
    Handle("tilt", "Tilt", per_pixel=radians(0.1), low=-light_angles.TILT_LIMIT, high=light_angles.TILT_LIMIT,
           unit='ANGLE', wheel=True),
)
NOTCHES = {'WHEELUPMOUSE': 1, 'WHEELDOWNMOUSE': -1}
KEEP_KEYS, CANCEL_KEYS = {'LEFTMOUSE', 'RET', 'NUMPAD_ENTER'}, {'ESC', 'RIGHTMOUSE'}
STATUS = "Mouse: turn   Wheel: tilt   Shift: finer   Click, Enter: keep   Right click, Esc: as it was"


class REFLINES_OT_sweep_light(bpy.types.Operator):
    """Turn the light with the mouse while the stripes follow, in any mode: left and right turn it in the view camera's
picture, the wheel tilts it"""
    bl_idname = "reflines.sweep_light"
    bl_label = "Sweep Light"
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING', 'GRAB_CURSOR'}

    turn: FloatProperty(name="Turn", subtype='ANGLE', options={'SKIP_SAVE'},
                        description="Of the light in the view camera's picture, counter-clockwise from the horizontal")
    tilt: FloatProperty(name="Tilt", subtype='ANGLE', min=-light_angles.TILT_LIMIT, max=light_angles.TILT_LIMIT,
                        options={'SKIP_SAVE'}, description="Of the light out of the picture, towards the viewer")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        settings = context.scene.reflection_lines
        obstacle = settings.explain_fixed_light()
        cls.poll_message_set(obstacle)
        return not obstacle

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        start = light_angles.read_light_angles(settings.picture_camera(), settings.light)
        if not self.properties.is_property_set("turn"):
            self.turn = start[0]
        if not self.properties.is_property_set("tilt"):
            self.tilt = start[1]
        self.turn_light(context)
        return {'FINISHED'}

    def turn_light(self, context: bpy.types.Context) -> None:
        settings = context.scene.reflection_lines
        light_angles.turn_light(settings.picture_camera(), settings.light, self.turn, self.tilt)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if context.area is None or context.area.type != 'VIEW_3D':
            return self.execute(context)
        settings = context.scene.reflection_lines
        self.start = light_angles.read_transform(settings.light)
        angles = light_angles.read_light_angles(settings.picture_camera(), settings.light)
        self.values = DragValues(HANDLES, angles, lambda *_: None)
        self.values.move(event.mouse_x, precise=False)
        self.area = context.area
        self.follow(context)
        context.workspace.status_text_set(STATUS)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        settings = context.scene.reflection_lines
        if event.type in CANCEL_KEYS and event.value == 'PRESS' or settings.explain_fixed_light():
            return self.cancel_sweep(context)
        if event.type in KEEP_KEYS and event.value == 'PRESS':
            self.end(context)
            return {'FINISHED'}
        if event.type == 'MOUSEMOVE':
            self.values.move(event.mouse_x, precise=event.shift)
        elif event.type in NOTCHES:
            self.values.wheel(NOTCHES[event.type], precise=event.shift)
        else:
            return {'PASS_THROUGH'} if event.type == 'MIDDLEMOUSE' else {'RUNNING_MODAL'}
        self.follow(context)
        return {'RUNNING_MODAL'}

    def follow(self, context: bpy.types.Context) -> None:
        self.turn, self.tilt = self.values.values()
        self.turn_light(context)
        self.area.tag_redraw()  # the numbers in the sidebar too
        self.area.header_text_set(f"Turn {degrees(self.turn):.1f}\u00b0   Tilt {degrees(self.tilt):.1f}\u00b0")

    def cancel_sweep(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        if not settings.explain_fixed_light():
            light_angles.restore_transform(settings.light, self.start)
        self.end(context)
        return {'CANCELLED'}

    def cancel(self, context: bpy.types.Context) -> None:
        """Turns the light back when Blender exits or opens another file."""
        self.cancel_sweep(context)

    def end(self, context: bpy.types.Context) -> None:
        self.area.header_text_set(None)
        context.workspace.status_text_set(None)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_sweep_light])
