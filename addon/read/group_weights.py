"""Reads the weights of a vertex group."""
import bmesh
import bpy
import numpy as np

from ..model.refusal import Refusal


def read_group_weights(ob: bpy.types.Object, name: str, purpose: str) -> np.ndarray:
    """Reads the weights in the vertex group of this name: #vertices; 1 everywhere without a name. `purpose` says in a
    refusal what the group is for.
    """
    mesh, group = ob.data, ob.vertex_groups.get(name)
    if not name:
        return np.ones(len(mesh.vertices))
    if group is None:
        raise Refusal(f"{ob.name} has no vertex group {name}: pick another one for {purpose}, or none")
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
