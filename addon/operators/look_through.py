"""The operator Look Through."""
import bpy

from ..read import scene_objects
from ..state import last_looks
from ..view import view_camera, view_region


class REFLINES_OT_look_through(bpy.types.Operator):
    """Look through the view camera in this 3D view; pressed again, look as before.

The scene's own camera stays as it is"""
    bl_idname = "reflines.look_through"
    bl_label = "Look Through"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if getattr(context.space_data, "region_3d", None) is None:
            return scene_objects.allow(cls, "Run this in a 3D view")
        cls.poll_message_set("No view camera: press Set Up from This View")
        return context.scene.reflection_lines.picture_camera() is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        space, camera = context.space_data, context.scene.reflection_lines.camera
        if view_camera.is_looking_through(space, camera):
            self.look_back(context)
            return {'FINISHED'}
        last_looks.remember_look(space, camera)
        space.use_local_camera, space.camera = True, camera
        if space.region_3d.view_perspective != 'CAMERA':
            self.switch_view(context)
        return {'FINISHED'}

    def look_back(self, context: bpy.types.Context) -> None:
        """Looks as before: through the scene's own or a local camera, where it is still there, or through none."""
        space, look = context.space_data, last_looks.take_look(context.space_data)
        local = bpy.data.objects.get(look.local)
        if not look.through or (local or context.scene.camera) is None:
            self.switch_view(context)
        space.use_local_camera = local is not None
        if local is not None:
            space.camera = local

    def switch_view(self, context: bpy.types.Context) -> None:
        """Looks through the camera of the 3D view, or no longer."""
        with context.temp_override(region=view_region.find_view_region(context.area)):
            bpy.ops.view3d.view_camera()
