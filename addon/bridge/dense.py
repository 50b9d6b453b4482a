"""The other mesh that a cage is fitted to: as the viewport shows it, in world space."""
import bpy
import numpy as np

from ..targets.fit import Dense
from . import surface
from .refusal import Refusal


def read(context: bpy.types.Context, cage: bpy.types.Object) -> Dense:
    """The one other selected mesh."""
    others = [ob for ob in context.view_layer.objects if ob.select_get() and ob.type == 'MESH' and ob != cage]
    if len(others) != 1:
        raise Refusal(f"{len(others)} other meshes are selected: select the one that {cage.name} is to be fitted to, "
                      f"then {cage.name}")
    other = others[0]
    shown = surface.read(other, context.evaluated_depsgraph_get(), None)
    matrix = np.array(other.matrix_world, dtype=np.float64)
    F = shown.F[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0.0 else shown.F
    return Dense(other.name, shown.V @ matrix[:3, :3].T + matrix[:3, 3], np.ascontiguousarray(F))
