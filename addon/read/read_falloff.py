"""Reads the fall-off of a tool: its centre, radius and curve, in world space."""
import bmesh
import bpy
import numpy as np

from ..model.patch import Patch
from ..model.refusal import Refusal
from ..targets import falloff
from ..targets.falloff import Falloff
from . import falloff_curve

AUTOMATIC_RADIUS = 1.0 / 3.0  # of the region's diagonal


def choose_radius(patch: Patch) -> float:
    """Returns the radius that 0 stands for. Around the middle of the region it ends inside: at half the width of its
    bounding box, the second of its three sides.
    """
    width = np.sort(np.ptp(patch.V, axis=0))[1]
    return min(AUTOMATIC_RADIUS * patch.diagonal, 0.5 * width) or patch.diagonal


def find_centre(kind: str, scene: bpy.types.Scene, ob: bpy.types.Object, patch: Patch) -> np.ndarray:
    """Returns the centre of a tool in world space; `kind` is one of tool_properties.CENTRES."""
    if kind == 'CURSOR':
        return np.array(scene.cursor.location, dtype=np.float64)
    return find_active_vertex(ob, patch) if kind == 'ACTIVE' else patch.center


def find_active_vertex(ob: bpy.types.Object, patch: Patch) -> np.ndarray:
    """Returns the vertex selected last, in world space; of an edge or face its middle."""
    element = bmesh.from_edit_mesh(ob.data).select_history.active if ob.mode == 'EDIT' else None
    if element is None:
        raise Refusal(f"{ob.name} has no active vertex: select one last in Edit Mode, or take another centre")
    vertices = [element] if isinstance(element, bmesh.types.BMVert) else element.verts
    middle = np.mean([vertex.co for vertex in vertices], axis=0)
    return patch.matrix[:3, :3] @ middle + patch.matrix[:3, 3]


def read_falloff(settings: bpy.types.Operator, scene: bpy.types.Scene, ob: bpy.types.Object,
                 patch: Patch) -> Falloff | None:
    """Reads the fall-off of an operator with tool_properties.FalloffSettings; None where it acts everywhere alike."""
    if settings.centre == 'EVERYWHERE':
        return None
    if settings.shape == 'CURVE':
        values = falloff_curve.tabulate_curve(scene.reflection_lines.curve or falloff_curve.ensure_curve())
    else:
        values = falloff.tabulate_preset(settings.shape)
    centre = find_centre(settings.centre, scene, ob, patch)
    return Falloff(centre, settings.radius or choose_radius(patch), values)
