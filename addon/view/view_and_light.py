"""Reads view and light: two directions in world space, from a camera and an empty."""
import bpy
import numpy as np
from mathutils import Matrix, Vector

from .. import native
from ..model.refusal import Refusal
from ..model.view import View
from ..read import scene_objects
from . import shown_middles


def is_perspective(camera: bpy.types.Object) -> bool:
    return camera.data.type != 'ORTHO'


def normalize(vector: np.ndarray, what: str) -> np.ndarray:
    """Returns the unit vector; refuses zero and infinite ones, naming the object."""
    length = np.linalg.norm(vector)
    if not 0.0 < length < np.inf:
        raise Refusal(f"{what} has no direction: its scale is zero or it stands in the panel's centre; "
                      "move or rescale it")
    return vector / length


def read_z_axis(ob: bpy.types.Object) -> np.ndarray:
    """Returns the object's local Z axis in world space, unit."""
    return normalize(np.array(ob.matrix_world, dtype=np.float64)[:3, 2], ob.name)


def compute_view_direction(camera: bpy.types.Object, center: np.ndarray) -> np.ndarray:
    """Returns the unit direction from the surface to the viewer.

    An orthographic camera has one direction; a perspective one is taken at `center`, that of the patch in world space.
    """
    if not is_perspective(camera):
        return read_z_axis(camera)
    return normalize(np.array(camera.matrix_world.translation, dtype=np.float64) - center, camera.name)


def build_view(camera: bpy.types.Object, light: bpy.types.Object, center: np.ndarray) -> View:
    """Builds the view of a camera and a light; `center` is that of the patch, which perspective cameras need."""
    return View(compute_view_direction(camera, center), read_z_axis(light))


def read_viewport_frame(context: bpy.types.Context) -> Matrix | None:
    """Returns the axes of the 3D view under the mouse: columns right, up, towards the viewer, in world space; None in
    background.
    """
    region_3d = getattr(context.space_data, "region_3d", None)
    return None if region_3d is None else region_3d.view_matrix.to_3x3().transposed()


def build_frame(direction: Vector) -> Matrix:
    """Builds columns right, up, `direction`; up is as near to world Z as can be, and +Y for a view from above."""
    z = direction.normalized()
    right = Vector((-z.y, z.x, 0.0))
    right = right.normalized() if right.length > 1e-3 else Vector((1.0, 0.0, 0.0))
    return Matrix((right, z.cross(right), z)).transposed()


def measure_extent(ob: bpy.types.Object | None) -> tuple[Vector, float]:
    """Returns centre and diagonal of an object's bounding box in world space; those of a unit cube where there is no
    mesh.
    """
    if ob is None or ob.type != 'MESH' or not len(ob.data.vertices):
        return Vector(), 1.0
    corners = [ob.matrix_world @ Vector(corner) for corner in ob.bound_box]
    low = Vector(min(corner[axis] for corner in corners) for axis in range(3))
    high = Vector(max(corner[axis] for corner in corners) for axis in range(3))
    return (low + high) / 2.0, (high - low).length or 1.0


def read_camera_axes(camera: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Returns the right and up axes of the camera's picture, unit, in world space."""
    right, up = np.array(camera.matrix_world, dtype=np.float64)[:3, :2].T
    return right / np.linalg.norm(right), up / np.linalg.norm(up)


def find_picture_direction(camera: bpy.types.Object, angle: float) -> np.ndarray:
    """Returns the unit direction at an angle (radians, counter-clockwise) from the picture's horizontal."""
    right, up = read_camera_axes(camera)
    return np.cos(angle) * right + np.sin(angle) * up


def find_obstacle(scene: bpy.types.Scene) -> str:
    """Returns why no tool can run now, as a sentence; empty where tools can run."""
    return native.STATE.problem or scene.reflection_lines.missing()


def has_seen_panel(operator: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Returns whether there is a panel, and what its lines need; sets the message that says why not."""
    return scene_objects.has_panel(operator, context) and scene_objects.allow(operator, find_obstacle(context.scene))


def refuse_obstacle(scene: bpy.types.Scene) -> None:
    """Refuses where no tool can run now."""
    obstacle = find_obstacle(scene)
    if obstacle:
        raise Refusal(obstacle)


def read_scene_view(scene: bpy.types.Scene, center: np.ndarray) -> View:
    """Reads the scene's view and light for a patch whose centre, in world space, is given; refuses where one is
    missing: while a tool runs, scripts and other windows can remove them.
    """
    refuse_obstacle(scene)
    settings = scene.reflection_lines
    return build_view(settings.camera, settings.light, center)


def read_shown_directions(scene: bpy.types.Scene, ob: bpy.types.Object) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Reads view and line direction for the stripes on an object, those of its last solve where there is one; None for
    what is missing.
    """
    settings, stored = scene.reflection_lines, ob.reflection_lines
    camera = settings.picture_camera()
    center = ob.matrix_world @ stored.center if stored.report.termination else measure_extent(ob)[0]
    center = shown_middles.find_shown_middle(ob.name, np.array(center))
    try:
        seen = compute_view_direction(camera, center) if camera is not None else None
        return seen, read_z_axis(settings.light) if settings.present(settings.light) else None
    except Refusal:
        return None, None
