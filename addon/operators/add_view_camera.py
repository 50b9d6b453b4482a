"""The operator Add View Camera."""
import bpy

from .camera_aim import CameraAim


class REFLINES_OT_add_view_camera(CameraAim, bpy.types.Operator):
    """Add an orthographic camera that looks at the panel, in Edit Mode at its selection, as the 3D view does now.

Reflection lines are judged, and the panel is moved, along its direction of view"""
    bl_idname = "reflines.add_view_camera"
    bl_label = "Add View Camera"

    def execute(self, context: bpy.types.Context) -> set[str]:
        return self.aim(context, None)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_add_view_camera])
