"""From solved positions back into the mesh: only vertices that moved are written."""
import bmesh
import bpy
import numpy as np

from . import region
from .gather import Panel


def apply(ob: bpy.types.Object, panel: Panel, positions: np.ndarray) -> int:
    """Writes world positions (#V x 3) of the region; returns how many vertices changed.

    What is added is the move, taken back to object space, so that a vertex leaves its place along the view only.
    """
    move = np.linalg.solve(panel.matrix[:3, :3], (positions - panel.V).T).T
    old = panel.local.astype(np.float32)
    new = (panel.local + move).astype(np.float32)
    moved = (new != old).any(axis=1)
    write = write_edit_mesh if ob.mode == 'EDIT' else write_mesh
    write(ob.data, panel.index[moved], new[moved])
    return int(moved.sum())


def write_mesh(mesh: bpy.types.Mesh, index: np.ndarray, new: np.ndarray) -> None:
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", values)
    values.reshape(-1, 3)[index] = new
    mesh.vertices.foreach_set("co", values)
    mesh.update()


def write_edit_mesh(mesh: bpy.types.Mesh, index: np.ndarray, new: np.ndarray) -> None:
    edit = bmesh.from_edit_mesh(mesh)
    edit.verts.ensure_lookup_table()
    vertices = edit.verts
    for i, co in zip(index.tolist(), new.tolist(), strict=True):
        vertices[i].co = co
    edit.normal_update()
    bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=False)


def keep_region(ob: bpy.types.Object, panel: Panel) -> None:
    """Remembers the faces, so that the tool can run on them again in Object Mode."""
    if ob.mode == 'EDIT':
        region.store(ob.data, panel.faces)
