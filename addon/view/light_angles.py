"""The light direction as two angles in the view camera's picture, and turning the light by them."""
from math import asin, atan2, cos, radians, sin

import bpy
from bpy_extras import view3d_utils
from mathutils import Matrix, Vector, geometry

# What an object's transform is stored in; a matrix written to it is taken apart, which loses bits.
TRANSFORM = ("location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale")
DIGITS = 5
TILT_LIMIT = radians(85.0)  # along the view no lines are seen


def read_picture_axes(camera: bpy.types.Object | None) -> Matrix:
    """Returns the axes of the camera's picture as columns right, up, towards the viewer; without a camera those of the
    world as seen from above.
    """
    return Matrix.Identity(3) if camera is None else camera.matrix_world.to_3x3().normalized()


def read_light_direction(camera: bpy.types.Object | None, light: bpy.types.Object) -> Vector:
    """Returns the light direction in the axes of the picture, unit; zero where the light is scaled to nothing."""
    return read_picture_axes(camera).transposed() @ light.matrix_world.to_3x3().col[2].normalized()


def read_light_angles(camera: bpy.types.Object | None, light: bpy.types.Object) -> tuple[float, float]:
    """Returns the turn of the light, counter-clockwise from the picture's horizontal, and its tilt towards the viewer,
    in radians, to DIGITS: the matrices are of single precision, and the sidebar would show a turn of -0.000002 degrees.
    """
    direction = read_light_direction(camera, light)
    turn = atan2(direction.y, direction.x) if direction.xy.length > 1e-6 else 0.0
    return round(turn, DIGITS) + 0.0, round(asin(min(max(direction.z, -1.0), 1.0)), DIGITS) + 0.0  # no -0


def turn_light(camera: bpy.types.Object | None, light: bpy.types.Object, turn: float, tilt: float) -> None:
    """Turns the light to the angles of `read_light_angles`, the shortest way; its place and scale stay."""
    point_light(camera, light, Vector((cos(tilt) * cos(turn), cos(tilt) * sin(turn), sin(tilt))))


def point_light(camera: bpy.types.Object | None, light: bpy.types.Object, direction: Vector) -> None:
    """Turns the light to a direction in the axes of the picture. Its own transform is turned, below those of its
    parents: behind an uneven scale of theirs a turn of the whole would shear it, and a negative scale of its own
    points its axis the other way.
    """
    own = light.matrix_basis.to_3x3()
    above = light.matrix_world.to_3x3() @ own.inverted_safe()
    wanted = above.inverted_safe() @ read_picture_axes(camera) @ direction
    if not wanted.length > 0.0:
        return
    turn = own.col[2].rotation_difference(wanted).to_matrix()
    light.matrix_world = Matrix.Translation(light.matrix_world.translation) @ (above @ turn @ own).to_4x4()


def find_turn_at(camera: bpy.types.Object | None, region: bpy.types.Region, region_3d: bpy.types.RegionView3D,
                 place: tuple[float, float], centre: Vector) -> float | None:
    """Returns the turn, in radians, of the point of the picture plane through `centre` that a place of a 3D view shows
    (pixels of its region); None where the view sees that plane edge-on.
    """
    axes = read_picture_axes(camera)
    eye = view3d_utils.region_2d_to_origin_3d(region, region_3d, place)
    ahead = eye + view3d_utils.region_2d_to_vector_3d(region, region_3d, place)
    point = geometry.intersect_line_plane(eye, ahead, centre, axes.col[2])
    if point is None:
        return None
    from_centre = axes.transposed() @ (point - centre)
    return atan2(from_centre.y, from_centre.x)


def read_transform(ob: bpy.types.Object) -> tuple[tuple[float, ...], ...]:
    """Reads the stored transform of an object, to be restored exactly."""
    return tuple(tuple(getattr(ob, name)) for name in TRANSFORM)


def restore_transform(ob: bpy.types.Object, stored: tuple[tuple[float, ...], ...]) -> None:
    """Restores what `read_transform` read."""
    for name, values in zip(TRANSFORM, stored, strict=True):
        setattr(ob, name, values)
