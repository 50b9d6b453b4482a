"""Reads each vertex's share of the limit: the way that it may move, and the weight in a vertex group."""
import bmesh
import bpy
import numpy as np

from ..model.refusal import Refusal


def read_limit_share(ob: bpy.types.Object, index: np.ndarray) -> np.ndarray | None:
    """Reads the shares for a patch's vertices, whose numbers in the mesh are `index` (#V): #V x 2, of the lowest move
    -1 to 0 and of the highest 0 to 1; None where all have the whole limit.
    """
    settings = ob.reflection_lines
    ways = np.array([-float(settings.limit_side != 'OUTWARD'), float(settings.limit_side != 'INWARD')])
    share = read_weights(ob, settings.limit_group)[index][:, None] * ways
    return None if (np.abs(share) == 1.0).all() else share


def read_weights(ob: bpy.types.Object, name: str) -> np.ndarray:
    """Reads the weights in the vertex group of this name: #vertices; 1 everywhere without a name."""
    mesh, group = ob.data, ob.vertex_groups.get(name)
    if not name:
        return np.ones(len(mesh.vertices))
    if group is None:
        raise Refusal(f"{ob.name} has no vertex group {name}: pick another one for the limit, or none")
    weights = np.zeros(len(mesh.vertices))
    if ob.mode == 'EDIT':
        edit = bmesh.from_edit_mesh(mesh)
        layer = edit.verts.layers.deform.active
        for vertex in edit.verts if layer is not None else ():
            weights[vertex.index] = vertex[layer].get(group.index, 0.0)
        return weights
    for vertex in mesh.vertices:
        for each in vertex.groups:
            if each.group == group.index:
                weights[vertex.index] = each.weight
    return weights
