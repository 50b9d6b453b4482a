"""Selects faces of a mesh, in Edit Mode and in Object Mode, with their edges and vertices."""
import bmesh
import bpy
import numpy as np

from ..read import read_mesh


def find_faces_near(ob: bpy.types.Object, place: np.ndarray, radius: float) -> np.ndarray:
    """Finds the visible faces whose middle is no further than `radius` from a place in world space, and the nearest
    one: #faces, bool. In Edit Mode the mesh must have been updated from it.
    """
    centers = read_mesh.read_values(ob.data.polygons, "center", float, 3)
    hidden = read_mesh.read_values(ob.data.polygons, "hide", bool)
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    away = np.linalg.norm(centers @ matrix[:3, :3].T + matrix[:3, 3] - place, axis=1)
    away[hidden | ~np.isfinite(away)] = np.inf
    return away <= max(radius, away.min(initial=np.inf)) if len(away) and np.isfinite(away).any() else hidden & False


def select_faces(ob: bpy.types.Object, faces: np.ndarray) -> None:
    """Selects these faces (#faces, bool) and no others."""
    if ob.mode == 'EDIT':
        select_edited_faces(ob.data, faces)
    else:
        select_stored_faces(ob.data, faces)


def select_edited_faces(mesh: bpy.types.Mesh, faces: np.ndarray) -> None:
    edit = bmesh.from_edit_mesh(mesh)
    for elements in (edit.verts, edit.edges, edit.faces):
        for each in elements:
            each.select = False
    for face, chosen in zip(edit.faces, faces.tolist(), strict=True):
        if chosen:
            face.select_set(True)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def select_stored_faces(mesh: bpy.types.Mesh, faces: np.ndarray) -> None:
    corners, sizes = read_mesh.read_corners(mesh)
    edges = read_mesh.read_integers(mesh.loops, "edge_index")
    chosen = np.repeat(faces, sizes)
    for elements, index in ((mesh.vertices, corners[chosen]), (mesh.edges, edges[chosen])):
        selected = np.zeros(len(elements), dtype=bool)
        selected[index] = True
        elements.foreach_set("select", selected)
    mesh.polygons.foreach_set("select", faces)
    mesh.update()
