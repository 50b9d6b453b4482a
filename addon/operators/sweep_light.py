"""The operator Sweep Light."""
from math import remainder, tau

import bpy
from bpy.props import BoolProperty, FloatProperty, FloatVectorProperty
from mathutils import Vector

from ..interactive import drag_input
from ..interactive.sweep import HANDLES, Sweep
from ..read import scene_objects
from ..view import light_angles


class REFLINES_OT_sweep_light(Sweep, bpy.types.Operator):
    """Turn the light with the mouse while the stripes follow, in any mode: left and right turn it in the view camera's
picture, the wheel tilts it"""
    bl_idname = "reflines.sweep_light"
    bl_label = "Sweep Light"
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING', 'GRAB_CURSOR'}

    turn: FloatProperty(name="Turn", subtype='ANGLE', options={'HIDDEN', 'SKIP_SAVE'},
                        description="Of the light in the view camera's picture, counter-clockwise from the horizontal")
    tilt: FloatProperty(name="Tilt", subtype='ANGLE', min=-light_angles.TILT_LIMIT, max=light_angles.TILT_LIMIT,
                        options={'HIDDEN', 'SKIP_SAVE'},
                        description="Of the light out of the picture, towards the viewer")
    around: FloatVectorProperty(subtype='XYZ', options={'HIDDEN', 'SKIP_SAVE'},
                                description="Middle of the gizmo's ring, along which the mouse turns the light then")
    release_confirm: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Keep the light when the mouse button "
                                  "that began the drag is let go, as gizmos do")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return scene_objects.allow(cls, context.scene.reflection_lines.explain_fixed_light())

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        start = light_angles.read_light_angles(settings.picture_camera(), settings.light)
        if not self.properties.is_property_set("turn"):
            self.turn = start[0]
        if not self.properties.is_property_set("tilt"):
            self.tilt = start[1]
        self.apply_angles(context)
        return {'FINISHED'}

    def apply_angles(self, context: bpy.types.Context) -> None:
        settings = context.scene.reflection_lines
        light_angles.turn_light(settings.picture_camera(), settings.light, self.turn, self.tilt)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if context.area is None or context.area.type != 'VIEW_3D':
            return self.execute(context)
        settings = context.scene.reflection_lines
        self.light, self.start = settings.light.name, light_angles.read_transform(settings.light)
        angles = light_angles.read_light_angles(settings.picture_camera(), settings.light)
        self.values = drag_input.read_values(HANDLES, angles, context.scene)
        self.area, self.region, self.region_3d = context.area, context.region, context.region_data
        self.angle = 0.0  # of the mouse around the ring, in radians, counted on over full turns
        return self.begin_sweep(context, event)

    def can_go_on(self, context: bpy.types.Context) -> bool:
        """Returns whether the light is still there, can be turned, and is the one that the sweep began with."""
        settings = context.scene.reflection_lines
        return not settings.explain_fixed_light() and settings.light.name == self.light

    def move_mouse(self, context: bpy.types.Context, event: bpy.types.Event) -> None:
        """Moves the held value with the mouse: from left to right, or with `around` along the gizmo's ring."""
        x = event.mouse_x
        if self.properties.is_property_set("around"):
            x = self.read_angle(context, event) / HANDLES[0].per_pixel
        self.values.move(x, precise=event.shift)

    def read_angle(self, context: bpy.types.Context, event: bpy.types.Event) -> float:
        """Returns the angle of the mouse around the gizmo's ring, in radians."""
        place = event.mouse_x - self.region.x, event.mouse_y - self.region.y
        camera = context.scene.reflection_lines.picture_camera()
        angle = light_angles.find_turn_at(camera, self.region, self.region_3d, place, Vector(self.around))
        self.angle += 0.0 if angle is None else remainder(angle - self.angle, tau)
        return self.angle

    def take_back(self, context: bpy.types.Context) -> None:
        """Turns the light back, where it is still there, and ends the sweep."""
        light = bpy.data.objects.get(self.light)
        if light is not None:
            light_angles.restore_transform(light, self.start)
        self.end(context)
