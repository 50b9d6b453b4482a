"""The start of a live warp: the former positions of the region's vertices, kept with the mesh so that undo, save and
reload preserve them.

All of it is for Object Mode. An attribute of the vertices holds the positions, NaN outside the region; custom
properties of the mesh hold its size, the shape key, and a hash of the positions that the live warp wrote last.
"""
import hashlib

import bpy
import numpy as np

from ..model.patch import Patch
from ..read import read_mesh
from . import result_key, write_mesh

ATTRIBUTE = "reflines_live_start"
LEFT, SIZE, KEY, MADE = "reflines_live_left", "reflines_live_size", "reflines_live_key", "reflines_live_made"


def store_start(ob: bpy.types.Object, patch: Patch) -> None:
    """Stores the patch's positions as the start, and makes the shape key of the patch."""
    values = np.full((len(ob.data.vertices), 3), np.nan, dtype=np.float32)
    values[patch.index] = patch.local
    remove_start(ob)
    ob.data[KEY], ob.data[MADE] = patch.key, "\n".join(result_key.open_result_key(ob) if patch.key else ())
    ob.data.attributes.new(ATTRIBUTE, 'FLOAT_VECTOR', 'POINT').data.foreach_set("vector", values.ravel())
    ob.data[SIZE] = count_elements(ob)
    store_mark(ob)


def count_elements(ob: bpy.types.Object) -> list[int]:
    """Returns the numbers of vertices and faces."""
    return [len(ob.data.vertices), len(ob.data.polygons)]


def count_growth(ob: bpy.types.Object) -> tuple[int, int]:
    """Returns how many vertices and faces the mesh has more than at the start."""
    vertices, faces = count_elements(ob)
    try:
        before = [int(count) for count in ob.data.get(SIZE, (0, 0))]
    except (TypeError, ValueError):  # a file may hold anything there
        before = []
    return (vertices - before[0], faces - before[1]) if len(before) == 2 else (vertices, faces)


def read_text(ob: bpy.types.Object, name: str) -> str:
    """Reads a custom property of the mesh; empty where there is none, or no text."""
    text = ob.data.get(name, "")
    return text if isinstance(text, str) else ""


def read_start(ob: bpy.types.Object) -> np.ndarray | None:
    """Reads the start: #vertices x 3 float32, NaN outside the region; None where none is stored."""
    attribute = ob.data.attributes.get(ATTRIBUTE)
    if attribute is None or attribute.data_type != 'FLOAT_VECTOR' or attribute.domain != 'POINT':
        return None
    return read_mesh.read_values(attribute.data, "vector", np.float32, 3)


def read_whole_start(ob: bpy.types.Object) -> np.ndarray:
    """Reads #vertices x 3: the start within the region, the mesh as it is elsewhere."""
    began, now = read_start(ob), read_live_coordinates(ob)
    return now if began is None else np.where(np.isnan(began), now, began)


def read_live_coordinates(ob: bpy.types.Object) -> np.ndarray:
    """Reads the coordinates of the shape that the live warp changes: #vertices x 3."""
    return read_mesh.read_coordinates(ob, read_text(ob, KEY))


def store_mark(ob: bpy.types.Object) -> None:
    """Stores a hash of the region's positions, so that changes by others differ from the live warp's own."""
    ob.data[LEFT] = hash_region(ob)


def is_unchanged(ob: bpy.types.Object) -> bool:
    """Returns whether nobody has moved the region's vertices since `store_mark`."""
    return ob.data.get(LEFT) == hash_region(ob)


def hash_region(ob: bpy.types.Object) -> str:
    """Returns the MD5 hash of the region's coordinates."""
    inside = ~np.isnan(read_start(ob)[:, 0])
    return hashlib.md5(read_live_coordinates(ob)[inside].tobytes(), usedforsecurity=False).hexdigest()


def restore_start(ob: bpy.types.Object) -> None:
    """Restores the start to the last bit; vertices outside the region stay."""
    made = read_text(ob, MADE).splitlines()
    if made:
        result_key.remove_keys(ob, made)
        return
    began = read_start(ob)
    index = np.flatnonzero(~np.isnan(began[:, 0]))
    write_mesh.write_shape(ob, read_text(ob, KEY), index, began[index])


def remove_start(ob: bpy.types.Object) -> None:
    """Removes everything that `store_start` stored with the mesh; a changed file may name another kind of object."""
    if ob.type != 'MESH':
        return
    attribute = ob.data.attributes.get(ATTRIBUTE)
    if attribute is not None:
        ob.data.attributes.remove(attribute)
    for name in (LEFT, SIZE, KEY, MADE):
        if name in ob.data:
            del ob.data[name]
