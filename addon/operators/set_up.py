"""The operator Set Up from This View."""
import bpy

from .camera_aim import CameraAim


class REFLINES_OT_set_up(CameraAim, bpy.types.Operator):
    """Add a view camera that looks as this 3D view does, and a light direction, where there is none, and show the
stripes"""
    bl_idname = "reflines.set_up"
    bl_label = "Set Up from This View"

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        if settings.picture_camera() is None:
            aimed = self.aim(context, None)
            if aimed != {'FINISHED'}:
                return aimed
        if not settings.present(settings.light):
            bpy.ops.reflines.add_light_direction()
        settings.stripes.show = True
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_set_up])
