"""The operator Pick Line Direction."""
import bpy
import numpy as np
from bpy_extras.view3d_utils import region_2d_to_location_3d

from ..interactive import drag_input, running_operators
from ..read import scene_objects
from ..view import view_and_light, view_region
from ..view.view_region import View

NAVIGATION = {*drag_input.NAVIGATION, *drag_input.NOTCHES}


class REFLINES_OT_pick_direction(bpy.types.Operator):
    """Click twice in the 3D view: the lines are to run from the first point to the second"""
    bl_idname = "reflines.pick_direction"
    bl_label = "Pick Two Points"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.find_active_object(context)
        cls.poll_message_set("Make the panel's mesh the active object, and the 3D view visible")
        return ob is not None and ob.type == 'MESH' and context.area is not None and context.area.type == 'VIEW_3D'

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self.points = []
        self.view: View | None = None  # that of the first click, one of four in Quad View
        context.workspace.status_text_set("Click where the line starts, then where it goes. Esc: leave all as it is")
        return running_operators.begin(self, context)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in {'ESC', 'RIGHTMOUSE'}:
            self.take_back(context)
            return {'CANCELLED'}
        if event.type != 'LEFTMOUSE' or event.value != 'PRESS':
            return {'PASS_THROUGH'} if event.type in NAVIGATION else {'RUNNING_MODAL'}
        view = view_region.find_view_at(context.area, event.mouse_x, event.mouse_y)
        if view is None or self.points and view != self.view:
            return {'RUNNING_MODAL'}  # beside the view
        self.view = view
        self.points.append(self.find_point(context, event))
        return {'RUNNING_MODAL'} if len(self.points) < 2 else self.finish(context)

    def find_point(self, context: bpy.types.Context, event: bpy.types.Event) -> np.ndarray:
        """Returns the point under the mouse in world space, as far away as the panel's middle: only the direction
        between two points is used.
        """
        region, region_3d = self.view
        at = (event.mouse_x - region.x, event.mouse_y - region.y)
        centre = view_and_light.measure_extent(scene_objects.find_active_object(context))[0]
        return np.array(region_2d_to_location_3d(region, region_3d, at, centre))

    def finish(self, context: bpy.types.Context) -> set[str]:
        self.take_back(context)
        settings = context.scene.reflection_lines.direction
        settings.start, settings.end = self.points
        settings.direction = 'POINTS'
        return {'FINISHED'}

    def take_back(self, context: bpy.types.Context) -> None:
        """Takes back the text of the status bar."""
        running_operators.end(self, context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Takes the text away when Blender exits or opens another file."""
        self.take_back(context)


register, unregister = running_operators.make_registration(REFLINES_OT_pick_direction)
