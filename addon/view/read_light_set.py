"""Reads the scene's set of lights for a press, and what may hide panels from their views."""
from collections.abc import Sequence

import bpy
import numpy as np

from ..model.light_set import Blockers, LightSet, SetLight
from ..read import modifiers, read_mesh
from . import view_and_light


def read_light_set(settings: bpy.types.PropertyGroup, subjects: Sequence[bpy.types.Object]) -> LightSet | None:
    """Reads the lights that can be used; None where there is none. `subjects` are the panels of the press, whose faces
    beside the region may hide it; those of a cage lie beside its surface, and so hide nothing.
    """
    lights = tuple(read_light(entry) for entry in settings.light_set.entries if entry.is_used())
    if not lights:
        return None
    return LightSet(lights, tuple(read_blockers(ob) for ob in subjects if not modifiers.is_cage(ob)))


def read_light(entry: bpy.types.PropertyGroup) -> SetLight:
    """Reads one light: of its objects as they are now, or the directions that it keeps."""
    if entry.keeps_directions:
        return SetLight(entry.name, tuple(entry.line), tuple(entry.eye), False, entry.weight)
    line = tuple(view_and_light.read_z_axis(entry.light).tolist())
    is_place = view_and_light.is_perspective(entry.camera)
    eye = entry.camera.matrix_world.translation if is_place else view_and_light.read_z_axis(entry.camera)
    return SetLight(entry.name, line, tuple(float(x) for x in eye), is_place, entry.weight)


def read_blockers(ob: bpy.types.Object) -> Blockers:
    """Reads all faces of a panel whose vertices have finite coordinates."""
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    V = read_mesh.read_coordinates(ob, "") @ matrix[:3, :3].T + matrix[:3, 3]
    F, face = read_mesh.read_triangles(ob.data)
    finite = np.isfinite(V).all(axis=1)[F].all(axis=1)
    return Blockers(ob.name, V, F[finite], face[finite])
