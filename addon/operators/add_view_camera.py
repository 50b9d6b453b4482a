"""Add View Camera."""
import bpy
from mathutils import Matrix, Vector

from ..bridge import contents, gather, view

MARGIN = 1.1
DISTANCE = 2.0  # of the camera from the object's centre, in diagonals of its bounding box


class REFLINES_OT_add_view_camera(bpy.types.Operator):
    """Add an orthographic camera that looks at the active mesh as the 3D view does now.

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
        frame = self.frame(context, ob)
        center, size = view.extent(ob)
        data = bpy.data.cameras.new("View Camera")
        data.type = 'ORTHO'
        data.ortho_scale = MARGIN * size
        data.clip_start, data.clip_end = 0.01 * size, 2.0 * DISTANCE * size
        camera = bpy.data.objects.new("View Camera", data)
        camera.matrix_world = Matrix.Translation(center + DISTANCE * size * frame.col[2]) @ frame.to_4x4()
        contents.editable_collection(context).objects.link(camera)
        context.scene.reflection_lines.camera = camera
        return {'FINISHED'}

    def frame(self, context: bpy.types.Context, ob: bpy.types.Object) -> Matrix:
        if any(self.direction):
            return view.frame_towards(Vector(self.direction))
        return view.viewport_frame(context) or view.frame_towards(Vector(gather.mean_normal(ob)))


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_add_view_camera])
