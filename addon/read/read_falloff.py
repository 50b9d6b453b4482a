"""Reads the fall-off of a tool: its centre, radius and curve, in world space."""
from collections.abc import Sequence

import bmesh
import bpy
import numpy as np

from ..model import meeting
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..targets import falloff
from ..targets.falloff import Falloff
from . import falloff_curve

AUTOMATIC_RADIUS = 1.0 / 3.0  # of the region's diagonal


def choose_radius(panels: Sequence[Patch]) -> float:
    """Returns the radius that 0 stands for. Around the middle of the region it ends inside: at half the width of its
    bounding box, the second of its three sides.
    """
    low, high = meeting.measure_bounds(panels)
    diagonal = float(np.linalg.norm(high - low))
    return min(AUTOMATIC_RADIUS * diagonal, 0.5 * np.sort(high - low)[1]) or diagonal


def find_centre(kind: str, scene: bpy.types.Scene, ob: bpy.types.Object, panels: Sequence[Patch]) -> np.ndarray:
    """Returns the centre of a tool in world space; `kind` is one of tool_properties.CENTRES."""
    if kind == 'CURSOR':
        return np.array(scene.cursor.location, dtype=np.float64)
    return find_active_vertex(ob) if kind == 'ACTIVE' else meeting.find_middle(panels)


def find_active_vertex(ob: bpy.types.Object) -> np.ndarray:
    """Returns the vertex selected last, in world space; of an edge or face its middle."""
    element = bmesh.from_edit_mesh(ob.data).select_history.active if ob.mode == 'EDIT' else None
    if element is None:
        raise Refusal(f"{ob.name} has no active vertex: select one last in Edit Mode, or take another centre")
    vertices = [element] if isinstance(element, bmesh.types.BMVert) else element.verts
    middle, matrix = np.mean([vertex.co for vertex in vertices], axis=0), np.array(ob.matrix_world)
    return matrix[:3, :3] @ middle + matrix[:3, 3]


def read_falloff(settings: bpy.types.Operator, scene: bpy.types.Scene, ob: bpy.types.Object,
                 panels: Sequence[Patch]) -> Falloff | None:
    """Reads the fall-off of an operator with tool_properties.FalloffSettings; None where it acts everywhere alike. Of
    several panels that meet it is the same for all; `ob` is the active object.
    """
    if settings.centre == 'EVERYWHERE':
        return None
    if settings.shape == 'CURVE':
        values = falloff_curve.tabulate_curve(scene.reflection_lines.curve or falloff_curve.ensure_curve())
    else:
        values = falloff.tabulate_preset(settings.shape)
    centre = find_centre(settings.centre, scene, ob, panels)
    return Falloff(centre, settings.radius or choose_radius(panels), values)
