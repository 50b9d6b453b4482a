"""Add View Camera."""
import bpy

from ..bridge import scene_objects, view_camera


class REFLINES_OT_add_view_camera(bpy.types.Operator):
    """Add an orthographic camera that looks at the active mesh, in Edit Mode at its selection, as the 3D view does now.

Reflection lines are judged, and the panel is moved, along its direction of view"""
    bl_idname = "reflines.add_view_camera"
    bl_label = "Add View Camera"
    bl_options = {'REGISTER', 'UNDO'}

    # Hidden: in Edit Mode undo does not take the camera away, so a redo would add a second one.
    direction: bpy.props.FloatVectorProperty(
        name="Direction", subtype='XYZ', options={'HIDDEN', 'SKIP_SAVE'},
        description="From the panel to the camera; zero takes the 3D view's, in background the panel's mean normal")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        if ob is None or ob.type != 'MESH':
            cls.poll_message_set("Make the panel's mesh the active object")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.view_layer.update()
        ob = context.view_layer.objects.active
        frame = view_camera.choose_frame(context, ob, self.direction)
        camera = view_camera.add_camera(scene_objects.find_editable_collection(context))
        view_camera.aim_camera(context, camera, frame, view_camera.read_framed_points(ob))
        context.scene.reflection_lines.camera = camera
        ob.reflection_lines.keep_view(context.scene)
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_add_view_camera])
