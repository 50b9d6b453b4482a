"""Reads Blender meshes as arrays: corners, triangles, and the coordinates of a shape."""
import bmesh
import bpy
import numpy as np

from ..model.patch import Patch


def read_corners(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Reads the vertices of all faces, corner by corner, and the number of corners of each face."""
    return read_integers(mesh.loops, "vertex_index"), read_integers(mesh.polygons, "loop_total")


def read_integers(collection: bpy.types.bpy_prop_collection, name: str, each: int = 1) -> np.ndarray:
    """Reads non-negative integers of every element: #elements, or #elements x each.

    Blender stores them unsigned; reading them as signed takes ten times longer.
    """
    return read_values(collection, name, np.uint32, each).view(np.int32)


def read_values(elements: bpy.types.bpy_prop_collection, name: str, kind: type, each: int = 1) -> np.ndarray:
    """Reads numbers of a type of every element: #elements, or #elements x each."""
    values = np.empty(each * len(elements), dtype=kind)
    elements.foreach_get(name, values)
    return values if each == 1 else values.reshape(-1, each)


def read_coordinates(ob: bpy.types.Object, key: str = "") -> np.ndarray:
    """Reads the coordinates of the shape found by `find_shape_points`: #vertices x 3, object space."""
    # The stored type: reading as double takes ten times longer.
    return read_values(find_shape_points(ob, key), "co", np.float32, 3).astype(np.float64)


def read_shown_coordinates(ob: bpy.types.Object) -> np.ndarray:
    """Reads the coordinates as they are being edited: #vertices x 3 float32, object space."""
    if ob.mode == 'EDIT':
        vertices = bmesh.from_edit_mesh(ob.data).verts
        return np.array([vertex.co[:] for vertex in vertices], dtype=np.float32).reshape(-1, 3)
    return read_coordinates(ob).astype(np.float32)


def find_shape_points(ob: bpy.types.Object, key: str = "") -> bpy.types.bpy_prop_collection:
    """Returns the points of the shape that tools change.

    In Edit Mode that is the active shape key, since the mesh keeps the basis; in Object Mode the key of this name where
    there is one, else the active one, of an object that has none the first; without shape keys the mesh's vertices.
    """
    keys = ob.data.shape_keys
    if keys is None:
        return ob.data.vertices
    own = keys.key_blocks.get(key) if key and ob.mode != 'EDIT' else None
    return (own or ob.active_shape_key or keys.reference_key).data


def read_triangles(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Reads Blender's own triangulation: vertices (#triangles x 3), and the face of each triangle."""
    mesh.calc_loop_triangles()
    cut = mesh.loop_triangles
    return read_integers(cut, "vertices", 3), read_integers(cut, "polygon_index")


SAMPLE = 64  # positions compared to detect a changed mesh


def read_patch_positions(ob: bpy.types.Object, patch: Patch) -> np.ndarray:
    """Reads the present positions of the patch's vertices: #V x 3 float32, object space; in Object Mode."""
    return read_coordinates(ob, patch.key)[patch.index].astype(np.float32)


def read_shape_before(ob: bpy.types.Object, patch: Patch, positions: np.ndarray) -> np.ndarray | None:
    """Reconstructs the mesh (#vertices x 3) as it was before the solve that moved the patch to `positions`.

    None where the patch's vertices are no longer there, up to rounding.
    """
    whole = read_coordinates(ob, patch.key)
    if len(whole) <= patch.index[-1]:
        return None
    apart = np.abs(whole[patch.index] - patch.to_object_space(positions))
    if not (apart <= 2.0 * np.spacing(np.abs(whole[patch.index]).max().astype(np.float32))).all():
        return None
    whole[patch.index] = patch.local
    return whole


def is_undone(ob: bpy.types.Object, patch: Patch, positions: np.ndarray) -> bool:
    """Returns whether the mesh is no longer as the move of the patch to `positions` left it, as after undo.

    Only the vertex that moved furthest is compared, so that undo and drawing take no longer.
    """
    edited = ob.mode == 'EDIT'
    vertices = bmesh.from_edit_mesh(ob.data).verts if edited else find_shape_points(ob, patch.key)
    furthest = int(np.abs(positions - patch.V).max(axis=1).argmax())
    if patch.index[furthest] >= len(vertices):
        return True
    if edited:
        vertices.ensure_lookup_table()
    now, left = np.array(vertices[patch.index[furthest]].co), patch.to_object_space(positions)[furthest]
    return bool((np.abs(now - left) > 2.0 * np.spacing(np.abs(left).max())).any())


def count_elements(ob: bpy.types.Object) -> tuple[int, int, int]:
    """Returns the numbers of vertices, edges and faces of the mesh as it is edited."""
    if ob.mode == 'EDIT':
        edit = bmesh.from_edit_mesh(ob.data)
        return len(edit.verts), len(edit.edges), len(edit.faces)
    return len(ob.data.vertices), len(ob.data.edges), len(ob.data.polygons)


def has_positions(ob: bpy.types.Object, patch: Patch, positions: np.ndarray) -> bool:
    """Returns whether the mesh is as a drag wrote it: its size, and a sample of the positions (#V x 3 float32, object
    space).
    """
    mesh = bmesh.from_edit_mesh(ob.data) if ob.mode == 'EDIT' else ob.data
    vertices = mesh.verts if ob.mode == 'EDIT' else find_shape_points(ob, patch.key)
    faces = mesh.faces if ob.mode == 'EDIT' else mesh.polygons
    if len(faces) != len(patch.faces) or patch.index[-1] >= len(vertices):
        return False
    if ob.mode == 'EDIT':
        vertices.ensure_lookup_table()
    sample = np.linspace(0, len(positions) - 1, SAMPLE).astype(int)
    now = np.array([vertices[i].co for i in patch.index[sample].tolist()], dtype=np.float32)
    return np.array_equal(now, positions[sample])
