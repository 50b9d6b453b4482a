"""Stores the region of a run in the mesh, as read.region_faces reads it."""
import bmesh
import bpy

from ..model.patch import Patch
from ..read.region_faces import ATTRIBUTE


def keep_region(ob: bpy.types.Object, patch: Patch) -> None:
    """Stores the faces of a patch gathered in Edit Mode, so that tools can run on them again in Object Mode.

    A new layer invalidates references to elements of the edit mesh, so call this before taking any.
    """
    if ob.mode != 'EDIT':
        return
    edit = bmesh.from_edit_mesh(ob.data)
    layers = edit.faces.layers.int
    layer = layers.get(ATTRIBUTE) or layers.new(ATTRIBUTE)
    for face, inside in zip(edit.faces, patch.faces.tolist(), strict=True):
        face[layer] = inside
