"""Reads the dense mesh that a cage is fitted to, as the viewport shows it, in world space."""
import bpy
import numpy as np

from ..model.refusal import Refusal
from ..targets.fit import DenseMesh
from . import viewport_surface


def read_dense_mesh(context: bpy.types.Context, cage: bpy.types.Object) -> DenseMesh:
    """Reads the one selected mesh beside the cage; refuses none and several."""
    others = [ob for ob in context.view_layer.objects if ob.select_get() and ob.type == 'MESH' and ob != cage]
    if len(others) != 1:
        raise Refusal(f"{len(others)} other meshes are selected: select the one that {cage.name} is to be fitted to, "
                      f"then {cage.name}")
    other = others[0]
    shown = viewport_surface.read_viewport_surface(other, context.evaluated_depsgraph_get(), None)
    matrix = np.array(other.matrix_world, dtype=np.float64)
    F = shown.F[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0.0 else shown.F
    return DenseMesh(other.name, shown.V @ matrix[:3, :3].T + matrix[:3, 3], np.ascontiguousarray(F))
