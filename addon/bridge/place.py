"""Places and directions that the artist points at, in world space."""
import bmesh
import bpy
import numpy as np

from .gather import Panel
from .refusal import Refusal


def centre_of(kind: str, scene: bpy.types.Scene, ob: bpy.types.Object, panel: Panel) -> np.ndarray:
    """`kind` as in properties.CENTRES."""
    if kind == 'CURSOR':
        return np.array(scene.cursor.location, dtype=np.float64)
    return active_vertex(ob, panel) if kind == 'ACTIVE' else panel.center


def active_vertex(ob: bpy.types.Object, panel: Panel) -> np.ndarray:
    """The vertex last selected; of an edge or face last selected its middle."""
    element = bmesh.from_edit_mesh(ob.data).select_history.active if ob.mode == 'EDIT' else None
    if element is None:
        raise Refusal(f"{ob.name} has no active vertex: select one last in Edit Mode, or take another centre")
    vertices = [element] if isinstance(element, bmesh.types.BMVert) else element.verts
    middle = np.mean([vertex.co for vertex in vertices], axis=0)
    return panel.matrix[:3, :3] @ middle + panel.matrix[:3, 3]


def camera_axes(camera: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Right and up of the picture, unit."""
    right, up = np.array(camera.matrix_world, dtype=np.float64)[:3, :2].T
    return right / np.linalg.norm(right), up / np.linalg.norm(up)


def in_picture(camera: bpy.types.Object, angle: float) -> np.ndarray:
    """The direction at an angle (radians, counter-clockwise) from the picture's horizontal, unit."""
    right, up = camera_axes(camera)
    return np.cos(angle) * right + np.sin(angle) * up
