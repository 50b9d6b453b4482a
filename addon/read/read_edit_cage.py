"""Reads the vertices and edges that Edit Mode shows of a mesh, to be drawn over the stripes."""
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np

from . import read_mesh


@dataclass(frozen=True)
class EditCage:
    """The visible vertices and edges, and which of them are selected."""
    V: np.ndarray               # #V x 3, object space
    vertices: np.ndarray        # the visible ones
    edges: np.ndarray           # #E x 2: the visible ones
    vertex_selected: np.ndarray  # #V, bool
    edge_selected: np.ndarray    # #E, bool

    def measure_edge(self) -> float:
        """Returns the mean length of the edges; 0 where there are none."""
        ends = self.V[self.edges]
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean()) if len(ends) else 0.0


def read_edit_cage(ob: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> EditCage:
    """Reads the cage of an object in Edit Mode.

    Without modifiers Blender's evaluated mesh is the cage, and its positions and edges are read faster than those of
    the edit mesh. Selections do not come to it before the next change of the shape.
    """
    edit = bmesh.from_edit_mesh(ob.data)
    if has_edit_modifiers(ob):
        return read_edit_mesh(edit)
    evaluated = ob.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    V = read_mesh.read_values(mesh.vertices, "co", np.float32, 3)
    hidden = read_mesh.read_values(mesh.vertices, "hide", bool)
    edges = read_mesh.read_integers(mesh.edges, "vertices", 2)
    edge_hidden = read_mesh.read_values(mesh.edges, "hide", bool)
    evaluated.to_mesh_clear()
    selected, edge_selected = (np.fromiter((each.select for each in elements), bool, len(elements))
                               for elements in (edit.verts, edit.edges))
    return EditCage(V, np.flatnonzero(~hidden), edges[~edge_hidden], selected, edge_selected[~edge_hidden])


def has_edit_modifiers(ob: bpy.types.Object) -> bool:
    """Returns whether Edit Mode shows a surface that modifiers made."""
    return any(modifier.show_viewport and modifier.show_in_editmode for modifier in ob.modifiers)


def read_selected_faces(ob: bpy.types.Object) -> np.ndarray:
    """Reads which faces of the edit mesh are selected: #faces, bool."""
    faces = bmesh.from_edit_mesh(ob.data).faces
    return np.fromiter((face.select for face in faces), bool, len(faces))


def read_edit_mesh(edit: bmesh.types.BMesh) -> EditCage:
    """Reads the cage from the edit mesh, which modifiers do not change."""
    edit.verts.index_update()
    V = np.array([vertex.co[:] for vertex in edit.verts], dtype=np.float32).reshape(-1, 3)
    vertices = np.array([(vertex.hide, vertex.select) for vertex in edit.verts], dtype=bool).reshape(-1, 2)
    shown = [edge for edge in edit.edges if not edge.hide]
    edges = np.array([[vertex.index for vertex in edge.verts] for edge in shown], dtype=np.int32).reshape(-1, 2)
    return EditCage(V, np.flatnonzero(~vertices[:, 0]), edges, vertices[:, 1],
                    np.array([edge.select for edge in shown], dtype=bool))


def read_active_vertex(mesh: bpy.types.Mesh) -> int:
    """Reads the index of the vertex that was selected last; -1 where something else was."""
    active = bmesh.from_edit_mesh(mesh).select_history.active
    return active.index if isinstance(active, bmesh.types.BMVert) else -1
