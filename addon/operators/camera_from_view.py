"""Camera from This View, and the view that a panel was last seen in."""
import bpy

from ..bridge import scene_objects, view_camera
from ..state import last_panels


def find_panel(context: bpy.types.Context) -> bpy.types.Object | None:
    """Returns the active mesh, else the last panel; None where there is neither."""
    ob = scene_objects.find_active_object(context)
    if ob is not None and ob.type == 'MESH':
        return ob
    return next(iter(last_panels.find_last_panels(context.scene, context.view_layer.objects)), None)


class REFLINES_OT_camera_from_view(bpy.types.Operator):
    """Turn the view camera to look as this 3D view does now, and frame the panel, in Edit Mode its selection.

Adds a camera where there is none"""
    bl_idname = "reflines.camera_from_view"
    bl_label = "Camera from This View"
    bl_options = {'REGISTER', 'UNDO'}

    # Hidden: in Edit Mode undo does not turn the camera back.
    direction: bpy.props.FloatVectorProperty(
        name="Direction", subtype='XYZ', options={'HIDDEN', 'SKIP_SAVE'},
        description="From the panel to the camera; zero takes the 3D view's, in background the panel's mean normal")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        camera = context.scene.reflection_lines.picture_camera()
        if find_panel(context) is None:
            cls.poll_message_set("Make the panel's mesh the active object")
            return False
        if camera is not None and (camera.library or camera.data.library):
            cls.poll_message_set(f"{camera.name} is linked from another file: press Add View Camera")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.view_layer.update()
        settings, ob = context.scene.reflection_lines, find_panel(context)
        frame = view_camera.choose_frame(context, ob, self.direction)
        if settings.picture_camera() is None:
            settings.camera = view_camera.add_camera(scene_objects.find_editable_collection(context))
        view_camera.aim_camera(context, settings.camera, frame, view_camera.read_framed_points(ob))
        ob.reflection_lines.keep_view(context.scene)
        return {'FINISHED'}


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
