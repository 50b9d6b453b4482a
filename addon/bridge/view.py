"""View and light: two directions in world space, read from a camera and an empty."""
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix, Vector

from .refusal import Refusal


@dataclass(frozen=True)
class View:
    """What the solver and the stripes need to know of the scene. Unit vectors in world space."""
    view_direction: np.ndarray  # 3, from the surface towards the viewer
    line_direction: np.ndarray  # 3, along the line lights


def is_perspective(camera: bpy.types.Object) -> bool:
    return camera.data.type != 'ORTHO'


def unit(vector: np.ndarray, what: str) -> np.ndarray:
    length = np.linalg.norm(vector)
    if not 0.0 < length < np.inf:
        raise Refusal(f"{what} has no direction: its scale is zero or it stands in the panel's centre; "
                      "move or rescale it")
    return vector / length


def axis_z(ob: bpy.types.Object) -> np.ndarray:
    return unit(np.array(ob.matrix_world, dtype=np.float64)[:3, 2], ob.name)


def direction_to(camera: bpy.types.Object, center: np.ndarray) -> np.ndarray:
    """An orthographic camera looks along its -Z everywhere; a perspective one is taken at the panel's centre."""
    if not is_perspective(camera):
        return axis_z(camera)
    return unit(np.array(camera.matrix_world.translation, dtype=np.float64) - center, camera.name)


def view_of(camera: bpy.types.Object, light: bpy.types.Object, center: np.ndarray) -> View:
    """`center` is the panel's, in world space; it matters for perspective cameras only."""
    return View(direction_to(camera, center), axis_z(light))


def viewport_frame(context: bpy.types.Context) -> Matrix | None:
    """Columns right, up, towards the viewer of the 3D view the mouse is in, in world space; None in background."""
    region_3d = getattr(context.space_data, "region_3d", None)
    return None if region_3d is None else region_3d.view_matrix.to_3x3().transposed()


def frame_towards(direction: Vector) -> Matrix:
    """Columns right, up, `direction`; up is as near to world Z as can be, and +Y for a view from above."""
    z = direction.normalized()
    right = Vector((-z.y, z.x, 0.0))
    right = right.normalized() if right.length > 1e-3 else Vector((1.0, 0.0, 0.0))
    return Matrix((right, z.cross(right), z)).transposed()


def extent(ob: bpy.types.Object | None) -> tuple[Vector, float]:
    """Centre and diagonal of an object's bounding box in world space; of a unit cube where there is nothing."""
    if ob is None or ob.type != 'MESH' or not len(ob.data.vertices):
        return Vector(), 1.0
    corners = [ob.matrix_world @ Vector(corner) for corner in ob.bound_box]
    low = Vector(min(corner[axis] for corner in corners) for axis in range(3))
    high = Vector(max(corner[axis] for corner in corners) for axis in range(3))
    return (low + high) / 2.0, (high - low).length or 1.0
