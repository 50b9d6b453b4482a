"""The arrow that is added as the light direction."""
import bpy
from mathutils import Matrix, Vector

from ..read import scene_objects
from . import view_and_light

FRACTION = 0.3  # of the object's size: the arrow's length, and how far it stands before the middle


def add_light_arrow(context: bpy.types.Context, direction: Vector) -> bpy.types.Object:
    """Adds an arrow in a direction of world space, at zero along the horizontal of the view; returns it."""
    frame = choose_frame(context)
    center, size = view_and_light.measure_extent(scene_objects.read_active_object(context))
    arrow = bpy.data.objects.new("Light Direction", None)
    arrow.empty_display_type = 'SINGLE_ARROW'
    arrow.empty_display_size = FRACTION * size
    place = Matrix.Translation(center + FRACTION * size * frame.col[2])
    axes = view_and_light.build_frame(direction if direction.length_squared else frame.col[0])
    arrow.matrix_world = place @ axes.to_4x4()
    scene_objects.find_editable_collection(context).objects.link(arrow)
    return arrow


def choose_frame(context: bpy.types.Context) -> Matrix:
    """Returns the axes of the view camera's picture; without a camera those of the 3D view, in background of a view
    from above.
    """
    camera = context.scene.reflection_lines.picture_camera()
    if camera is not None:
        return camera.matrix_world.to_3x3().normalized()
    return view_and_light.read_viewport_frame(context) or Matrix.Identity(3)
