"""The operator Look Through."""
import bpy

from ..bridge import view_camera, view_region


class REFLINES_OT_look_through(bpy.types.Operator):
    """Look through the view camera in this 3D view; pressed again, look as before.

The scene's own camera stays as it is"""
    bl_idname = "reflines.look_through"
    bl_label = "Look Through"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if getattr(context.space_data, "region_3d", None) is None:
            cls.poll_message_set("Run this in a 3D view")
            return False
        cls.poll_message_set("No view camera: press Camera from This View")
        return context.scene.reflection_lines.picture_camera() is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        space, camera = context.space_data, context.scene.reflection_lines.camera
        back = view_camera.is_looking_through(space, camera)
        if not back:
            space.use_local_camera, space.camera = True, camera
        if back or space.region_3d.view_perspective != 'CAMERA':
            with context.temp_override(region=view_region.find_view_region(context.area)):
                bpy.ops.view3d.view_camera()
        if back:
            space.use_local_camera = False
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_look_through])
