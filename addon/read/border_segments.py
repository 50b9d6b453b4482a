"""The border's condition by segment: a vertex attribute, so that undo, save and edits keep it.

It is an integer: 0 where the tool's own border holds, else one of VALUES. A vertex with which Blender cuts an edge gets
a mean of the ends' integers: between different borders it has none of its own.
"""
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np

from ..model import border
from . import read_mesh

ATTRIBUTE = "reflines_border"
# The stored value of each native code. No cut of an edge into up to 12 equal parts gives one of them between two
# others, nor between one and 0.
VALUES = (1000, 13000, 14000, 30000, 44000, 57000)
CODE_OF = {value: code for code, value in enumerate(VALUES)}


@dataclass(frozen=True)
class BorderEdges:
    """The edges between vertices with a condition of their own."""
    V: np.ndarray      # #V x 3, object space
    ends: np.ndarray   # #E x 2 of V
    codes: np.ndarray  # #V


def read_border(ob: bpy.types.Object) -> np.ndarray:
    """Reads the codes of the vertices: #vertices, border.UNSET where one has none of its own, border.WRONG where its
    value is neither that of a code nor between two.
    """
    values = (read_edit_values if ob.mode == 'EDIT' else read_object_values)(ob.data).astype(np.int64)
    return np.where((values < 0) | (values > VALUES[-1]), border.WRONG, decode_values(values))


def decode_values(values: np.ndarray) -> np.ndarray:
    """Returns the codes of stored values (#V): border.UNSET for what is none."""
    place = np.searchsorted(VALUES[:-1], values)
    return np.where(np.take(VALUES, place) == values, place, border.UNSET)


def read_edit_values(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads the stored values in Edit Mode, where attributes are empty: #vertices."""
    edit = bmesh.from_edit_mesh(mesh)
    layer = edit.verts.layers.int.get(ATTRIBUTE)
    if layer is None:
        return np.zeros(len(edit.verts), dtype=np.int32)
    return np.fromiter((vertex[layer] for vertex in edit.verts), np.int32, len(edit.verts))


def read_object_values(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads the stored values in Object Mode: #vertices; zeros where the attribute is of another type."""
    values = np.zeros(len(mesh.vertices), dtype=np.int32)
    attribute = mesh.attributes.get(ATTRIBUTE)
    if attribute is not None and (attribute.domain, attribute.data_type) == ('POINT', 'INT'):
        attribute.data.foreach_get("value", values)
    return values


def read_border_edges(ob: bpy.types.Object) -> BorderEdges | None:
    """Reads the edges to draw, of the shape that the tools change; None where no vertex has a border of its own."""
    return read_edit_edges(ob) if ob.mode == 'EDIT' else read_object_edges(ob)


def read_edit_edges(ob: bpy.types.Object) -> BorderEdges | None:
    edit = bmesh.from_edit_mesh(ob.data)
    layer = edit.verts.layers.int.get(ATTRIBUTE)
    own = [] if layer is None else [vertex for vertex in edit.verts if vertex[layer] in CODE_OF and not vertex.hide]
    if not own:
        return None
    number = {vertex: k for k, vertex in enumerate(own)}
    edges = {edge for vertex in own for edge in vertex.link_edges}
    ends = [[number[vertex] for vertex in edge.verts] for edge in edges
            if all(vertex in number for vertex in edge.verts)]
    return BorderEdges(np.array([vertex.co[:] for vertex in own]), np.array(ends, dtype=np.int64).reshape(-1, 2),
                       np.array([CODE_OF[vertex[layer]] for vertex in own]))


def read_object_edges(ob: bpy.types.Object) -> BorderEdges | None:
    codes = decode_values(read_object_values(ob.data))
    own = codes != border.UNSET
    if not own.any():
        return None
    ends = read_mesh.read_integers(ob.data.edges, "vertices", 2)
    number = np.cumsum(own) - 1
    return BorderEdges(read_mesh.read_coordinates(ob)[own], number[ends[own[ends].all(axis=1)]], codes[own])
