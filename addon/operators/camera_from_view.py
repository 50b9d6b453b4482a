"""The operators that turn the view camera to this view, and back to the view that a panel was last seen in."""
import bpy

from ..bridge import scene_objects
from .camera_aim import CameraAim


class REFLINES_OT_camera_from_view(CameraAim, bpy.types.Operator):
    """Turn the view camera to look as this 3D view does now, and frame the panel, in Edit Mode its selection.

Adds a camera where there is none"""
    bl_idname = "reflines.camera_from_view"
    bl_label = "Camera from This View"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        camera = context.scene.reflection_lines.picture_camera()
        if camera is not None and (camera.library or camera.data.library):
            cls.poll_message_set(f"{camera.name} is linked from another file: press Add View Camera")
            return False
        return super().poll(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        return self.aim(context, context.scene.reflection_lines.picture_camera())


class REFLINES_OT_use_panel_view(bpy.types.Operator):
    """Take the view camera and the light that the active panel was last worked on with"""
    bl_idname = "reflines.use_panel_view"
    bl_label = "View of This Panel"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.find_active_object(context)
        cls.poll_message_set("Make a panel active that was worked on with another view camera or light")
        return ob is not None and ob.reflection_lines.has_other_view(context.scene)

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings, kept = context.scene.reflection_lines, scene_objects.find_active_object(context).reflection_lines
        for name in ("camera", "light"):
            if settings.present(getattr(kept, name)):
                setattr(settings, name, getattr(kept, name))
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_camera_from_view, REFLINES_OT_use_panel_view])
