"""The base of operators that aim a view camera at the panel, as the 3D view looks at it."""
import bpy
import numpy as np
from bpy.props import FloatVectorProperty
from mathutils import Matrix

from ..model.refusal import Refusal
from ..read import scene_objects
from ..state import last_panels
from ..view import light_angles, view_camera

HELD_TOLERANCE = 1e-4  # of axes, and of places relative to the coordinates: matrices are of single precision


class CameraAim:
    """The part that Add View Camera and Set Up from This View have in common; they differ in which camera is aimed."""
    bl_options = {'REGISTER', 'UNDO'}

    # Hidden: in Edit Mode undo knows the mesh only, so a redo would begin with the camera of the first run.
    direction: FloatVectorProperty(
        name="Direction", subtype='XYZ', options={'HIDDEN', 'SKIP_SAVE'},
        description="From the panel to the camera; zero takes the 3D view's, in background the panel's mean normal")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("Make the panel's mesh the active object")
        return last_panels.find_panel(context) is not None

    def aim(self, context: bpy.types.Context, camera: bpy.types.Object | None) -> set[str]:
        """Aims a camera at the panel, a new one where it is None, and makes it the view camera of scene and panel."""
        context.view_layer.update()
        ob = last_panels.find_panel(context)
        try:
            points = view_camera.read_framed_points(ob)
            frame = view_camera.choose_frame(context, ob, self.direction)
            if camera is not None:
                refuse_held_camera(context, camera, Matrix.Translation(points.mean(axis=0)) @ frame.to_4x4())
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        camera = camera or view_camera.add_camera(scene_objects.find_editable_collection(context))
        view_camera.aim_camera(context, camera, frame, points)
        context.scene.reflection_lines.camera = camera
        ob.reflection_lines.keep_view(context.scene)
        return {'FINISHED'}


def refuse_held_camera(context: bpy.types.Context, camera: bpy.types.Object, wanted: Matrix) -> None:
    """Refuses a camera that does not go where it is put, as below a constraint or an uneven scale; leaves it as it was.
    """
    before = light_angles.read_transform(camera)
    camera.matrix_world = wanted
    context.view_layer.update()
    apart, size = np.abs(np.array(camera.matrix_world - wanted)), max(1.0, *np.abs(wanted.translation))
    light_angles.restore_transform(camera, before)
    context.view_layer.update()
    if apart[:3, :3].max() > HELD_TOLERANCE or apart[:3, 3].max() > HELD_TOLERANCE * size:
        raise Refusal(f"{camera.name} cannot be turned to this view, since a constraint, or the scale of its parent, "
                      "holds it: take that away, or press Add View Camera")
