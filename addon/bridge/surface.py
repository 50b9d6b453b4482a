"""The surface that the viewport shows of an object: modifiers applied, hidden faces left out."""
from dataclasses import dataclass

import bpy
import numpy as np

from . import gather, region


@dataclass(frozen=True)
class Surface:
    """In object space."""
    V: np.ndarray        # #V x 3
    F: np.ndarray        # #F x 3
    normals: np.ndarray  # #V x 3


def read(ob: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Surface:
    """`to_mesh` of the evaluated object is right in both modes; its plain data are empty in Edit Mode."""
    evaluated = ob.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    V, normals = np.empty(3 * len(mesh.vertices)), np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", V)
    mesh.vertices.foreach_get("normal", normals)
    F, polygons = gather.triangles(mesh)
    F = F[region.visible(mesh)[polygons]]
    evaluated.to_mesh_clear()
    return Surface(V.reshape(-1, 3), F, normals.reshape(-1, 3))
