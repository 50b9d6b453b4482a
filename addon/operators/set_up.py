"""The operator Set Up from This View."""
import bpy
import numpy as np
from bpy.props import EnumProperty, FloatVectorProperty
from mathutils import Matrix, Vector

from ..blender.tooltips import tell_by
from ..model.refusal import Refusal, report_refusals
from ..read import scene_objects
from ..state import last_panels
from ..view import light_angles, light_arrow, view_camera

HELD_TOLERANCE = 1e-4  # of axes, and of places relative to the coordinates: matrices are of single precision
PARTS = (
    ('ALL', "All", "The view camera looks as this view does; what is missing is added, and the stripes are shown"),
    ('CAMERA', "Another Camera", "Another view camera that looks as this view does"),
    ('LIGHT', "Light Direction", "An arrow along the horizontal of the view camera's picture"),
    ('PANEL', "View of This Panel", "The view camera and the light that the active panel was last worked on with"),
)
TIPS = {'CAMERA': "Add another view camera, which looks at the panel as the 3D view does now; the first one stays",
        'LIGHT': "Add an arrow that shows the direction of the line lights, at first along the horizontal of the view",
        'PANEL': "Take the view camera and the light that the active panel was last worked on with"}


class REFLINES_OT_set_up(bpy.types.Operator):
    """Let the view camera look as this 3D view does and frame the panel, in Edit Mode its selection; add camera and
light direction where there are none, and show the stripes"""
    bl_idname = "reflines.set_up"
    bl_label = "Set Up from This View"
    bl_options = {'REGISTER', 'UNDO'}

    # Hidden: in Edit Mode undo knows the mesh only, so a redo would begin with the camera of the first run.
    part: EnumProperty(name="Part", items=PARTS, default='ALL', options={'HIDDEN', 'SKIP_SAVE'})
    direction: FloatVectorProperty(
        name="Direction", subtype='XYZ', options={'HIDDEN', 'SKIP_SAVE'},
        description="From the panel to the camera, or of the light; zero takes that of the 3D view, in background of "
        "the panel's mean normal")

    description = tell_by("part", TIPS)

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("Make the panel's mesh the active object")
        return last_panels.find_panel(context) is not None

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        if self.part == 'PANEL':
            take_kept_view(settings, last_panels.find_panel(context))
            return {'FINISHED'}
        if self.part != 'LIGHT':
            self.aim_camera(context, settings.picture_camera() if self.part == 'ALL' else None)
        if self.part == 'LIGHT' or (self.part == 'ALL' and not settings.present(settings.light)):
            settings.light = light_arrow.add_light_arrow(
                context, Vector(self.direction) if self.part == 'LIGHT' else Vector())
        if self.part == 'ALL':
            settings.stripes.show = True
        return {'FINISHED'}

    def aim_camera(self, context: bpy.types.Context, camera: bpy.types.Object | None) -> None:
        """Aims a camera at the panel, a new one where it is None, and makes it the view camera of scene and panel."""
        context.view_layer.update()
        ob = last_panels.find_panel(context)
        points = view_camera.read_framed_points(ob)
        frame = view_camera.choose_frame(context, ob, self.direction)
        if camera is not None:
            refuse_held_camera(context, camera, Matrix.Translation(points.mean(axis=0)) @ frame.to_4x4())
        camera = camera or view_camera.add_camera(scene_objects.find_editable_collection(context))
        view_camera.aim_camera(context, camera, frame, points)
        context.scene.reflection_lines.camera = camera
        ob.reflection_lines.keep_view(context.scene)


def take_kept_view(settings: bpy.types.PropertyGroup, ob: bpy.types.Object) -> None:
    """Makes the camera and the light that a panel was last worked on with those of the scene."""
    kept = ob.reflection_lines
    if not kept.has_other_view(settings.id_data):
        raise Refusal(f"{ob.name} was worked on with no other view camera or light")
    for name in ("camera", "light"):
        if settings.present(getattr(kept, name)):
            setattr(settings, name, getattr(kept, name))


def refuse_held_camera(context: bpy.types.Context, camera: bpy.types.Object, wanted: Matrix) -> None:
    """Refuses a camera that does not go where it is put, as below a constraint or an uneven scale, or where it is
    linked; leaves it as it was.
    """
    remedy = "or add another camera by the plus beside its name"
    if camera.library or camera.data.library:
        raise Refusal(f"{camera.name} is linked from another file: make it local, {remedy}")
    before = light_angles.read_transform(camera)
    camera.matrix_world = wanted
    context.view_layer.update()
    apart, size = np.abs(np.array(camera.matrix_world - wanted)), max(1.0, *np.abs(wanted.translation))
    light_angles.restore_transform(camera, before)
    context.view_layer.update()
    if apart[:3, :3].max() > HELD_TOLERANCE or apart[:3, 3].max() > HELD_TOLERANCE * size:
        raise Refusal(f"{camera.name} cannot be turned to this view, since a constraint, or the scale of its parent, "
                      f"holds it: take that away, {remedy}")
