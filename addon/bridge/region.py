"""The region: faces the user chose, stored as a face attribute so that it survives undo, save and new topology.

An integer attribute, because Blender 3.4 has no boolean layers in Edit Mode.
"""
import bmesh
import bpy
import numpy as np

ATTRIBUTE = "reflines_region"


def is_stored(mesh: bpy.types.Mesh) -> bool:
    attribute = mesh.attributes.get(ATTRIBUTE)
    return attribute is not None and attribute.domain == 'FACE' and attribute.data_type == 'INT'


def selected(mesh: bpy.types.Mesh) -> np.ndarray:
    """#faces bool. In Edit Mode the caller has brought the mesh up to date."""
    return visible(mesh) & flags(mesh, "select")


def stored(mesh: bpy.types.Mesh) -> np.ndarray:
    """#faces bool, in Object Mode; hidden faces are never part of it."""
    if not is_stored(mesh):
        return np.zeros(len(mesh.polygons), dtype=bool)
    values = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.attributes[ATTRIBUTE].data.foreach_get("value", values)
    return visible(mesh) & (values != 0)


def visible(mesh: bpy.types.Mesh) -> np.ndarray:
    return ~flags(mesh, "hide")


def flags(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    values = np.empty(len(mesh.polygons), dtype=bool)
    mesh.polygons.foreach_get(name, values)
    return values


def store(mesh: bpy.types.Mesh, faces: np.ndarray) -> None:
    """In Edit Mode. References to elements of the edit mesh die with a new layer, so call this before taking any."""
    edit = bmesh.from_edit_mesh(mesh)
    layers = edit.faces.layers.int
    layer = layers.get(ATTRIBUTE) or layers.new(ATTRIBUTE)
    for face, inside in zip(edit.faces, faces.tolist(), strict=True):
        face[layer] = inside
