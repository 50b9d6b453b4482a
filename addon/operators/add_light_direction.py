"""The operator Add Light Direction."""
import bpy
from mathutils import Matrix, Vector

from ..read import scene_objects
from ..view import view_and_light


class REFLINES_OT_add_light_direction(bpy.types.Operator):
    """Add an arrow that shows the direction of the line lights, at first along the horizontal of the view.

Turn the arrow to turn the reflection lines; it must not point along the view"""
    bl_idname = "reflines.add_light_direction"
    bl_label = "Add Light Direction"
    bl_options = {'REGISTER', 'UNDO'}

    # Hidden: in Edit Mode undo does not take the arrow away, so a redo would add a second one.
    direction: bpy.props.FloatVectorProperty(
        name="Direction", subtype='XYZ', options={'HIDDEN', 'SKIP_SAVE'},
        description="In world space; zero takes the horizontal of the view")

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        frame = self.choose_frame(context, settings)
        direction = Vector(self.direction) if any(self.direction) else frame.col[0]
        center, size = view_and_light.measure_extent(scene_objects.read_active_object(context))
        arrow = bpy.data.objects.new("Light Direction", None)
        arrow.empty_display_type = 'SINGLE_ARROW'
        arrow.empty_display_size = 0.3 * size
        place = Matrix.Translation(center + 0.3 * size * frame.col[2])
        arrow.matrix_world = place @ view_and_light.build_frame(direction).to_4x4()
        scene_objects.find_editable_collection(context).objects.link(arrow)
        settings.light = arrow
        return {'FINISHED'}

    def choose_frame(self, context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> Matrix:
        """Returns the axes of the view camera's picture; without a camera those of the 3D view, in background of a view
        from above.
        """
        if settings.picture_camera() is not None:
            return settings.camera.matrix_world.to_3x3().normalized()
        return view_and_light.read_viewport_frame(context) or Matrix.Identity(3)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_add_light_direction])
