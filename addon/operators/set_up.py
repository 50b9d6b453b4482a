"""The operator Set Up from This View."""
import bpy

from .camera_aim import CameraAim


class REFLINES_OT_set_up(CameraAim, bpy.types.Operator):
    """Let the view camera look as this 3D view does and frame the panel, in Edit Mode its selection; add camera and
light direction where there are none, and show the stripes"""
    bl_idname = "reflines.set_up"
    bl_label = "Set Up from This View"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        camera = context.scene.reflection_lines.picture_camera()
        if camera is not None and (camera.library or camera.data.library):
            cls.poll_message_set(f"{camera.name} is linked from another file: press Add View Camera")
            return False
        return super().poll(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        aimed = self.aim(context, settings.picture_camera())
        if aimed != {'FINISHED'}:
            return aimed
        if not settings.present(settings.light):
            bpy.ops.reflines.add_light_direction()
        settings.stripes.show = True
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_set_up])
