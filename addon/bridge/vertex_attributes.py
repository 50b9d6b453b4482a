"""Writes results as float attributes of the vertices of a mesh."""
import bmesh
import bpy
import numpy as np

from ..model.refusal import Refusal


def refuse_taken_attribute(ob: bpy.types.Object, name: str, kind: str = 'FLOAT') -> None:
    """Refuses a name whose attribute holds something else than one number of this type for each vertex."""
    found = ob.data.attributes.get(name)
    if found is not None and (found.domain, found.data_type) != ('POINT', kind):
        raise Refusal(f"{ob.name} has another attribute {name} ({found.domain.lower()}, {found.data_type.lower()}) "
                      "than is to be stored there: rename or remove it")


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
