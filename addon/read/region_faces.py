"""The region: the faces that the artist chose, stored as a face attribute so that undo, save and edits keep it.

The attribute is an integer, because Blender 3.4 has no boolean layers in Edit Mode.
"""
import bpy
import numpy as np

from . import read_mesh

ATTRIBUTE = "reflines_region"


def has_stored_region(mesh: bpy.types.Mesh) -> bool:
    attribute = mesh.attributes.get(ATTRIBUTE)
    return attribute is not None and attribute.domain == 'FACE' and attribute.data_type == 'INT'


def describe_missing_region(ob: bpy.types.Object) -> str:
    """Says, in Object Mode, that the mesh of an object has no region from a run before, or none that is visible."""
    hidden = int(read_region_values(ob.data).sum())
    if hidden:
        return f"The {hidden} faces of the stored region of {ob.name} are hidden: show them in Edit Mode"
    return f"{ob.name} has no stored region: select the faces of the panel in Edit Mode and run the tool there once"


def read_selected_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads the selected visible faces: #faces, bool. In Edit Mode the mesh must have been updated from it."""
    return read_visible_faces(mesh) & read_mesh.read_values(mesh.polygons, "select", bool)


def read_stored_region(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads the stored region in Object Mode: #faces, bool; hidden faces are never part of it."""
    return read_visible_faces(mesh) & read_region_values(mesh)


def read_region_values(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads in Object Mode which faces are stored as the region, also hidden ones: #faces, bool."""
    if not has_stored_region(mesh):
        return np.zeros(len(mesh.polygons), dtype=bool)
    return read_mesh.read_values(mesh.attributes[ATTRIBUTE].data, "value", np.int32) != 0


def read_visible_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads which faces are not hidden: #faces, bool."""
    return ~read_mesh.read_values(mesh.polygons, "hide", bool)
