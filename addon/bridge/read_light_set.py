"""Reads the scene's set of lights for a press, and what may hide panels from their views."""
from collections.abc import Sequence

import bpy
import numpy as np

from ..model.light_set import Blockers, LightSet, SetLight
from . import modifiers, read_mesh, view_and_light


def read_light_set(settings: bpy.types.PropertyGroup, subjects: Sequence[bpy.types.Object]) -> LightSet | None:
    """Reads the lights that can be used; None where there is none. `subjects` are the panels of the press, of which all
    faces may hide the region.
    """
    lights = tuple(read_light(entry) for entry in settings.light_set.entries if entry.is_used())
    return LightSet(lights, read_blockers(subjects)) if lights else None


def read_light(entry: bpy.types.PropertyGroup) -> SetLight:
    """Reads one light: of its objects as they are now, or the directions that it keeps."""
    if entry.keeps_directions:
        return SetLight(entry.name, tuple(entry.line), tuple(entry.eye), False, entry.weight)
    line = tuple(view_and_light.read_z_axis(entry.light).tolist())
    is_place = view_and_light.is_perspective(entry.camera)
    eye = entry.camera.matrix_world.translation if is_place else view_and_light.read_z_axis(entry.camera)
    return SetLight(entry.name, line, tuple(float(x) for x in eye), is_place, entry.weight)


def read_blockers(subjects: Sequence[bpy.types.Object]) -> Blockers | None:
    """Reads all faces of the panels that are no cages, whose own faces lie beside their surface."""
    V, F, count = [], [], 0
    for ob in subjects:
        if modifiers.is_cage(ob):
            continue
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        matrix = np.array(ob.matrix_world, dtype=np.float64)
        places = read_mesh.read_coordinates(ob, "") @ matrix[:3, :3].T + matrix[:3, 3]
        triangles = read_mesh.read_triangles(ob.data)[0]
        triangles = triangles[np.isfinite(places[triangles]).all(axis=(1, 2))]
        used, corners = np.unique(triangles, return_inverse=True)
        V.append(places[used])
        F.append(corners.reshape(-1, 3) + count)
        count += len(used)
    return Blockers(np.concatenate(V), np.concatenate(F)) if count else None
