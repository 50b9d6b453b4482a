"""Writes positions into the mesh; only vertices that moved are written."""
from itertools import compress

import bmesh
import bpy
import numpy as np

from ..model.patch import Patch
from ..read import read_mesh, shape_keys
from . import result_key

# Fraction of moved vertices below which updating their normals one by one is faster than all together.
FEW = 0.03


class EditVertices:
    """The vertices of a patch in Edit Mode, kept for a drag: looking them up takes as long as writing them."""

    def __init__(self, index: np.ndarray) -> None:
        self.index = index
        self.edit: bmesh.types.BMesh | None = None
        self.vertices: list[bmesh.types.BMVert] = []

    def find(self, edit: bmesh.types.BMesh) -> list[bmesh.types.BMVert]:
        if self.edit is not edit or not self.edit.is_valid:
            edit.verts.ensure_lookup_table()
            vertices = edit.verts
            self.edit, self.vertices = edit, [vertices[i] for i in self.index.tolist()]
        return self.vertices


def write_solution(ob: bpy.types.Object, patch: Patch, positions: np.ndarray, *, edited: bool = False) -> None:
    """Writes world positions (#V x 3) of the patch, into the shape key of the patch if it has one.

    That key can only be made in Object Mode, so this leaves Edit Mode unless the key is the one being edited. With
    `edited` the run came from Edit Mode into Object Mode; the active key is then written as there.
    """
    if edited and not patch.key and ob.mode == 'OBJECT' and ob.data.shape_keys is not None:
        write_active_key(ob, patch, positions)
        return
    if patch.key and not shape_keys.is_result_key_edited(ob):
        if ob.mode == 'EDIT':
            bpy.ops.object.mode_set(mode='OBJECT')
        result_key.open_result_key(ob)
    old = patch.round_start_positions() if ob.mode == 'EDIT' else read_mesh.read_patch_positions(ob, patch)
    write_positions(ob, patch, patch.to_object_space(positions), old)


def write_active_key(ob: bpy.types.Object, patch: Patch, positions: np.ndarray) -> None:
    """Writes world positions into the active shape key from Object Mode. Edit Mode does so, since Blender then moves
    the keys that are relative to it along.
    """
    bpy.ops.object.mode_set(mode='EDIT')
    old = read_mesh.read_shown_coordinates(ob)[patch.index]
    write_positions(ob, patch, patch.to_object_space(positions), old)
    bpy.ops.object.mode_set(mode='OBJECT')


def write_positions(ob: bpy.types.Object, patch: Patch, new: np.ndarray, old: np.ndarray,
         kept: EditVertices | None = None) -> None:
    """Writes object-space positions (#V x 3 float32) over `old`, those that the mesh has now."""
    moved = (new != old).any(axis=1)
    if moved.any():
        if ob.mode == 'EDIT':
            write_edit_mesh(ob.data, kept or EditVertices(patch.index), moved, new[moved])
        else:
            write_shape(ob, patch.key, patch.index[moved], new[moved])


def write_shape(ob: bpy.types.Object, key: str, index: np.ndarray, new: np.ndarray) -> None:
    """Writes coordinates in Object Mode, into the shape found by read_mesh.find_shape_points."""
    mesh, points = ob.data, read_mesh.find_shape_points(ob, key)
    values = read_mesh.read_values(points, "co", np.float32, 3)
    values[index] = new
    points.foreach_set("co", values.ravel())
    if mesh.shape_keys is not None:
        mesh.shape_keys.update_tag()
    mesh.update()


def write_edit_mesh(mesh: bpy.types.Mesh, vertices: EditVertices, moved: np.ndarray, new: np.ndarray) -> None:
    """Writes coordinates in Edit Mode: `moved` (bool) says which of the vertices, `new` has a row for each of those."""
    edit = bmesh.from_edit_mesh(mesh)
    columns = new.T.tolist()  # a list for each vertex takes three times longer, in the garbage collector
    for vertex, co in zip(compress(vertices.find(edit), moved.tolist()), zip(*columns, strict=True), strict=True):
        vertex.co = co
    if len(new) < FEW * len(edit.verts):
        update_normals(list(compress(vertices.find(edit), moved.tolist())))
    else:
        edit.normal_update()
    bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=False)


def update_normals(moved: list[bmesh.types.BMVert]) -> None:
    """Updates the normals around moved vertices: Blender draws them and updates none by itself."""
    faces = {face for vertex in moved for face in vertex.link_faces}
    for face in faces:
        face.normal_update()
    for vertex in {vertex for face in faces for vertex in face.verts}:
        vertex.normal_update()
