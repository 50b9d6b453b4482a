"""Reads from scene and settings how stripes are drawn on an object: eye, lights and look."""
import bpy
import numpy as np
from mathutils import Matrix

from ..view import view_and_light
from . import stripes
from .stripes import Eye, Look

MAPS = {'RESIDUAL', 'DEVIATION', 'VERDICT'}


def needs_solution(settings: bpy.types.PropertyGroup) -> bool:
    """Returns whether the last solve is drawn."""
    return settings.before or settings.mode in MAPS


def is_split(settings: bpy.types.PropertyGroup) -> bool:
    """Returns whether the shapes before and after the last solve are drawn side by side."""
    return settings.before and settings.side_by_side and settings.mode not in MAPS


def identify_content(ob: bpy.types.Object, settings: bpy.types.PropertyGroup) -> tuple:
    """Returns the settings that determine what is uploaded; all others change uniforms only."""
    is_map = settings.mode in MAPS
    return is_map and settings.mode, settings.before, is_part_only(ob, settings), is_split(settings)


def is_part_only(ob: bpy.types.Object, settings: bpy.types.PropertyGroup) -> bool:
    """Returns whether only the selected faces are drawn."""
    return settings.scope == 'SELECTION' and ob.mode == 'EDIT'


def build_uniforms(context: bpy.types.Context, ob: bpy.types.Object) -> np.ndarray | None:
    """Builds the uniforms of an object; None where the light is missing or parallel to the view, so that theta is
    undefined.
    """
    settings = context.scene.reflection_lines.stripes
    seen, line = view_and_light.read_shown_directions(context.scene, ob)
    if line is None:
        return None
    eye = choose_eye(context, settings, ob, seen)
    # theta = 0 is the view camera's direction for every eye, since the lights do not move with the eye.
    lights = stripes.compute_lights(eye.direction if seen is None else seen, line)
    if lights is None:
        return None
    region_3d = context.region_data
    return stripes.pack_uniforms(model=to_array(ob.matrix_world), view_matrix=to_array(region_3d.view_matrix),
                            projection=to_array(region_3d.window_matrix), eye=eye, lights=lights,
                            look=read_look(settings, compute_offset(context, ob)))


def choose_eye(context: bpy.types.Context, settings: bpy.types.PropertyGroup, ob: bpy.types.Object,
           seen: np.ndarray | None) -> Eye:
    if settings.eye == 'FROZEN' and any(settings.frozen_eye):
        center = np.array(view_and_light.measure_extent(ob)[0])
        return build_frozen_eye(np.array(settings.frozen_eye, dtype=np.float64), center)
    if settings.eye != 'CAMERA' or seen is None:
        return build_viewport_eye(context.region_data)
    return Eye(seen, None)  # one direction for the whole panel, as the solver takes it


def build_frozen_eye(value: np.ndarray, center: np.ndarray) -> Eye:
    direction = value[:3] - value[3] * center
    direction = direction / max(np.linalg.norm(direction), 1e-12)
    return Eye(direction, value[:3] if value[3] else None)


def build_viewport_eye(region_3d: bpy.types.RegionView3D) -> Eye:
    back = to_array(region_3d.view_matrix.inverted_safe())
    return Eye(back[:3, 2], back[:3, 3] if region_3d.is_perspective else None)


def compute_offset(context: bpy.types.Context, ob: bpy.types.Object) -> float:
    """Returns how much nearer than the surface the stripes are drawn, as stripes.Look has it."""
    if ob.mode != 'EDIT':
        return stripes.ABOVE_SURFACE
    projection, distance = to_array(context.region_data.window_matrix), context.region_data.view_distance
    if context.region_data.view_perspective == 'CAMERA':
        distance = 1.0 / np.abs(np.diag(projection)[:2]).max()
    radius = stripes.VERTEX_RADIUS * context.preferences.system.pixel_size
    return stripes.compute_edit_offset(projection, distance,
                                       stripes.measure_pixels(projection, radius, context.region.width))


def read_look(settings: bpy.types.PropertyGroup, offset: float) -> Look:
    return Look(settings.mode, settings.count, settings.width, settings.softness, tuple(settings.color),
                        tuple(settings.gap_color), settings.image_rotation, offset)


def to_array(matrix: Matrix) -> np.ndarray:
    return np.array(matrix, dtype=np.float64)
