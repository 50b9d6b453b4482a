"""Reads the edges that a line can run parallel to."""
import bmesh
import bpy
import numpy as np

from ..model.patch import Patch
from ..model.triangulation import list_border


def read_selected_edges(patch: Patch) -> np.ndarray:
    """Reads the selected edges of the patch's mesh that bound no selected face. Ends in world space: #E x 2 x 3."""
    chosen = read_lone_edges(bpy.data.objects[patch.name].data)
    return patch.to_world(chosen.reshape(-1, 3)).reshape(-1, 2, 3)


def read_bounding_edges(patch: Patch) -> np.ndarray:
    """Reads the region's border and its marked creases. Ends in world space: #E x 2 x 3."""
    return patch.V[np.concatenate([list_border(patch.F), patch.creases.marked]).astype(int)]


def read_lone_edges(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads the ends of selected edges without a selected face: #E x 2 x 3, object space."""
    if mesh.is_editmode:
        edges = [edge for edge in bmesh.from_edit_mesh(mesh).edges
                 if edge.select and not any(face.select for face in edge.link_faces)]
        return np.array([[vertex.co[:] for vertex in edge.verts] for edge in edges]).reshape(-1, 2, 3)
    faces = {key for polygon in mesh.polygons if polygon.select for key in polygon.edge_keys}
    keys = [edge.key for edge in mesh.edges if edge.select and edge.key not in faces]
    return np.array([[mesh.vertices[vertex].co[:] for vertex in key] for key in keys]).reshape(-1, 2, 3)
