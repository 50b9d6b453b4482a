"""Reads the cage behind the surface that the viewport shows, for stripes on the limit surface.

It only reads, so that viewports may call it while they draw.
"""
import bmesh
import bpy
import numpy as np

from ..model.cage import Cage
from ..model.refusal import Refusal
from ..model.solution import LastSolve
from . import modifiers, read_cage, read_mesh, read_snapshot, region_faces, shape_keys


def read_viewport_cage(ob: bpy.types.Object, before: LastSolve | None = None) -> tuple[Cage, np.ndarray] | None:
    """Reads the cage in object space, its region the visible faces, and which faces (#faces) are selected; with the
    vertices of a solve where they were `before` it.

    None where what is shown is not the surface of a cage, or of one with modifiers that are not followed.
    """
    if not modifiers.is_cage(ob) or not modifiers.shows_cage_surface(ob):
        return None
    *below, modifier = modifiers.find_cage_modifiers(ob)
    if modifier.subdivision_type != 'CATMULL_CLARK' or ob.mode == 'EDIT' and not modifier.show_in_editmode:
        return None
    try:
        mirror = read_cage.find_followed_mirror(ob.name, below)
    except Refusal:
        return None
    state = read_edited_state(ob.data) if ob.mode == 'EDIT' else read_stored_state(ob)
    if state is None or not np.isfinite(state[0]).all() or not state[1].any():
        return None
    local, visible, selected = state
    if before is not None:
        patch = before.patch
        if patch.index[-1] >= len(local):
            return None
        if patch.key and ob.mode != 'EDIT':
            fraction = shape_keys.read_seen_fraction(ob, patch.key)
            local[patch.index] -= fraction * (patch.to_object_space(before.positions) - patch.local)
        else:
            local[patch.index] = patch.local
    whole = read_cage.read_cage(ob.data, read_snapshot.read_connectivity(ob.data), visible, np.eye(4), modifier,
                                mirror, local)
    return whole, np.tile(selected, 1 if mirror is None else 2)


def read_stored_state(ob: bpy.types.Object) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Reads positions, visible and selected faces; None where the shape that is shown is not known."""
    local = shape_keys.read_mixed_shape(ob) if len(ob.data.polygons) else None
    if local is None:
        return None
    selected = read_mesh.read_values(ob.data.polygons, "select", bool)
    return local, region_faces.read_visible_faces(ob.data), selected


def read_edited_state(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Reads positions, visible and selected faces of the edit mesh; None where its topology is no longer the stored
    mesh's.
    """
    now = bmesh.from_edit_mesh(mesh)
    if (len(now.verts), len(now.edges)) != (len(mesh.vertices), len(mesh.edges)) or not len(now.faces):
        return None
    corners = [vertex.index for face in now.faces for vertex in face.verts]
    if not np.array_equal(corners, read_mesh.read_corners(mesh)[0]):
        return None
    local = np.array([vertex.co for vertex in now.verts], dtype=np.float64)
    hidden, selected = np.array([(face.hide, face.select) for face in now.faces], dtype=bool).T
    return local, ~hidden, selected
