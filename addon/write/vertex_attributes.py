"""Writes results as float attributes of the vertices of a mesh."""
import bmesh
import bpy
import numpy as np


def store_vertex_values(ob: bpy.types.Object, name: str, values: np.ndarray) -> None:
    """Stores a float (#vertices) for each vertex of the mesh, in Edit Mode or Object Mode."""
    if ob.mode == 'EDIT':
        edit = bmesh.from_edit_mesh(ob.data)
        layer = edit.verts.layers.float.get(name) or edit.verts.layers.float.new(name)
        for vertex, value in zip(edit.verts, values.tolist(), strict=True):
            vertex[layer] = value
        return
    attribute = ob.data.attributes.get(name) or ob.data.attributes.new(name, 'FLOAT', 'POINT')
    attribute.data.foreach_set("value", values.astype(np.float32))
