"""The cage behind what the viewport shows of an object, for stripes on its limit surface. Only reads, so that a drawing
viewport may call it."""
import bmesh
import bpy
import numpy as np

from . import cage, gather, modifiers, region
from .cage import Cage
from .refusal import Refusal


def read(ob: bpy.types.Object) -> tuple[Cage, np.ndarray] | None:
    """In object space, its region the visible faces; and which faces (#faces) are selected. None where what is shown is
    no cage's surface, or one with modifiers that are not followed."""
    if not modifiers.is_cage(ob):
        return None
    *below, modifier = modifiers.shaping(ob)
    if modifier.subdivision_type != 'CATMULL_CLARK' or ob.mode == 'EDIT' and not modifier.show_in_editmode:
        return None
    try:
        mirror = cage.mirror_of(ob.name, below)
    except Refusal:
        return None
    state = edited(ob.data) if ob.mode == 'EDIT' else stored(ob)
    if state is None or not np.isfinite(state[0]).all() or not state[1].any():
        return None
    local, visible, selected = state
    axis = -1 if mirror is None else next(k for k in range(3) if mirror.use_axis[k])
    whole = cage.read(ob.data, visible, np.eye(4), modifier, mirror, axis, local)
    return whole, np.tile(selected, 1 if mirror is None else 2)


def stored(ob: bpy.types.Object) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Positions, visible and selected faces. None below shape keys: what is shown mixes them."""
    if ob.data.shape_keys is not None or not len(ob.data.polygons):
        return None
    return gather.coordinates(ob), region.visible(ob.data), region.flags(ob.data, "select")


def edited(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """As `stored`, of the mesh being edited. None where its faces and edges are no longer those stored with it."""
    now = bmesh.from_edit_mesh(mesh)
    if (len(now.verts), len(now.edges)) != (len(mesh.vertices), len(mesh.edges)) or not len(now.faces):
        return None
    corners = [vertex.index for face in now.faces for vertex in face.verts]
    if not np.array_equal(corners, gather.corners(mesh)[0]):
        return None
    local = np.array([vertex.co for vertex in now.verts], dtype=np.float64)
    hidden, selected = np.array([(face.hide, face.select) for face in now.faces], dtype=bool).T
    return local, ~hidden, selected
