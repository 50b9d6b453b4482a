"""The faces whose lines are pinned: a face attribute, so that undo, save and edits keep it.

It is an integer, because Blender 3.4 has no boolean layers in Edit Mode.
"""
import bmesh
import bpy
import numpy as np

ATTRIBUTE = "reflines_pinned"


def read_pinned_faces(ob: bpy.types.Object) -> np.ndarray:
    """Reads which faces are pinned: #faces, bool."""
    mesh = ob.data
    if ob.mode == 'EDIT':
        edit = bmesh.from_edit_mesh(mesh)
        layer = edit.faces.layers.int.get(ATTRIBUTE)
        if layer is None:
            return np.zeros(len(edit.faces), dtype=bool)
        return np.fromiter((face[layer] != 0 for face in edit.faces), bool, len(edit.faces))
    attribute = mesh.attributes.get(ATTRIBUTE)
    if attribute is None or (attribute.domain, attribute.data_type) != ('FACE', 'INT'):
        return np.zeros(len(mesh.polygons), dtype=bool)
    values = np.empty(len(mesh.polygons), dtype=np.int32)
    attribute.data.foreach_get("value", values)
    return values != 0


def pin_selected_faces(mesh: bpy.types.Mesh, *, pinned: bool) -> int:
    """Pins the selected faces in Edit Mode, or unpins them; returns how many they are."""
    edit = bmesh.from_edit_mesh(mesh)
    layers = edit.faces.layers.int
    layer = layers.get(ATTRIBUTE) or layers.new(ATTRIBUTE)
    chosen = [face for face in edit.faces if face.select and not face.hide]
    for face in chosen:
        face[layer] = int(pinned)
    return len(chosen)
