"""The warp lattice: a Blender Lattice that lies in the image plane over a region."""
from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Matrix

from ..model.patch import Patch
from ..model.refusal import Refusal
from ..read import read_mesh, scene_objects
from ..targets.warp import Lattice

LIFT = 0.1  # of the panel's diagonal, towards the viewer: the lattice is to be seen before the panel


def add_lattice(panels: Sequence[Patch], frame: np.ndarray, *, columns: int, rows: int, kind: str,
                collection: bpy.types.Collection) -> bpy.types.Object:
    """Adds a lattice over the extent of panels along the image-plane axes `frame` (3 x 3, rows x, y and towards the
    viewer).
    """
    data = bpy.data.lattices.new("Warp Lattice")
    data.points_u, data.points_v, data.points_w = columns, rows, 1
    data.interpolation_type_u = data.interpolation_type_v = data.interpolation_type_w = kind
    seen = np.concatenate([patch.V for patch in panels]) @ frame.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    centre = np.append((low + high)[:2] / 2.0, high[2] + LIFT * panels[0].diagonal)
    last = np.array(data.points[-1].co)  # a lattice given more points is larger in its own space, with the middle at 0
    size = (high - low)[:2] / (2.0 * last[:2])
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = frame.T * np.append(size, size.max()), frame.T @ centre
    lattice = bpy.data.objects.new("Warp Lattice", data)
    lattice.matrix_world = Matrix(matrix.tolist())
    collection.objects.link(lattice)
    return lattice


def find_lattice(scene: bpy.types.Scene, name: str = "") -> bpy.types.Object:
    """Returns the lattice of this name, else the scene's; refuses where there is none."""
    named = scene.objects.get(name) if name else scene.reflection_lines.warp.lattice
    if named is None or named.type != 'LATTICE' or not scene_objects.contains_object(scene.objects, named):
        raise Refusal("There is no warp lattice: "
                      "press Add Warp Lattice, or pick one in the sidebar's Reflection tab")
    return named


def read_lattice(ob: bpy.types.Object) -> Lattice:
    """Reads the lattice, in Edit Mode too: unlike a mesh a lattice shows there what is being edited."""
    data = ob.data
    now = read_mesh.read_values(data.points, "co_deform", np.float32, 3)
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    if not np.isfinite(matrix).all() or not np.isfinite(now).all():
        raise Refusal(f"{ob.name} has a transform or points that are not finite numbers: reset them")
    if np.linalg.matrix_rank(matrix[:3, :2]) < 2 or data.points_u < 2 or data.points_v < 2:
        raise Refusal(f"{ob.name} has no area: give it at least 2 x 2 points and a scale other than zero")
    u, v, w = read_rest_axes(data)
    rest = np.stack([axis.ravel() for axis in np.meshgrid(w, v, u, indexing='ij')][::-1], axis=1)
    shape = (data.points_w, data.points_v, data.points_u, 3)
    kinds = (data.interpolation_type_u, data.interpolation_type_v, data.interpolation_type_w)
    return Lattice(rest[0], rest[-1], (now.astype(float) - rest).reshape(shape), kinds, matrix)


def read_rest_axes(data: bpy.types.Lattice) -> list[np.ndarray]:
    """Reads the coordinates of the undeformed control points along u, v and w, which lie evenly about the middle.

    In Edit Mode Blender 3.4 counts `co` from a wrong first point, so that only the steps between points can be trusted.
    """
    values = read_mesh.read_values(data.points, "co", np.float32, 3)
    return [space_evenly(np.unique(axis), count) for axis, count
            in zip(values.astype(float).T, (data.points_u, data.points_v, data.points_w), strict=True)]


def space_evenly(values: np.ndarray, count: int) -> np.ndarray:
    """Returns `count` coordinates about 0 at the spacing of the given ones, in order."""
    if count == 1:
        return np.zeros(1)
    whole = values[-1] - values[0]
    step = whole / max(round(whole / np.diff(values).min()), 1)
    return step * (np.arange(count) - 0.5 * (count - 1))
