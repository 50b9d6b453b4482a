"""Where a panel's vertices were when its live warp began, kept with the mesh so that undo, save and reload keep it too.

All of it in Object Mode: an attribute of the vertices, whose values are no numbers outside the region, and an own
property of the mesh that says what the live warp left it as.
"""
import hashlib

import bpy
import numpy as np

from . import apply, gather, keys
from .gather import Panel

ATTRIBUTE = "reflines_live_start"
LEFT, SIZE, KEY, MADE = "reflines_live_left", "reflines_live_size", "reflines_live_key", "reflines_live_made"


def keep(ob: bpy.types.Object, panel: Panel) -> None:
    """And makes the shape key that the panel asks for."""
    values = np.full((len(ob.data.vertices), 3), np.nan, dtype=np.float32)
    values[panel.index] = panel.local
    drop(ob)
    ob.data[KEY], ob.data[MADE] = panel.key, "\n".join(keys.open_key(ob) if panel.key else ())
    ob.data.attributes.new(ATTRIBUTE, 'FLOAT_VECTOR', 'POINT').data.foreach_set("vector", values.ravel())
    ob.data[SIZE] = size(ob)
    leave(ob)


def size(ob: bpy.types.Object) -> list[int]:
    return [len(ob.data.vertices), len(ob.data.polygons)]


def has_grown(ob: bpy.types.Object) -> tuple[int, int]:
    """How many vertices and faces there are more than at the start."""
    vertices, faces = np.array(size(ob)) - np.array(ob.data.get(SIZE, (0, 0)))
    return int(vertices), int(faces)


def kept(ob: bpy.types.Object) -> np.ndarray | None:
    """#vertices x 3 float32, no numbers outside the region; None where nothing is kept."""
    attribute = ob.data.attributes.get(ATTRIBUTE)
    if attribute is None or attribute.data_type != 'FLOAT_VECTOR' or attribute.domain != 'POINT':
        return None
    values = np.empty(3 * len(ob.data.vertices), dtype=np.float32)
    attribute.data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def everywhere(ob: bpy.types.Object) -> np.ndarray:
    """#vertices x 3: the start where it is kept, else the mesh as it is."""
    began, now = kept(ob), coordinates(ob)
    return now if began is None else np.where(np.isnan(began), now, began)


def coordinates(ob: bpy.types.Object) -> np.ndarray:
    """#vertices x 3: of the shape that the live warp changes."""
    return gather.coordinates(ob, ob.data.get(KEY, ""))


def leave(ob: bpy.types.Object) -> None:
    """Notes the region's positions: who changes them afterwards is not the live warp."""
    ob.data[LEFT] = mark(ob)


def is_left(ob: bpy.types.Object) -> bool:
    return ob.data.get(LEFT) == mark(ob)


def mark(ob: bpy.types.Object) -> str:
    inside = ~np.isnan(kept(ob)[:, 0])
    return hashlib.md5(coordinates(ob)[inside].tobytes(), usedforsecurity=False).hexdigest()


def restore(ob: bpy.types.Object) -> None:
    """To the last bit; what lies outside the region stays."""
    made = ob.data.get(MADE, "").splitlines()
    if made:
        keys.close_key(ob, made)
        return
    began = kept(ob)
    index = np.flatnonzero(~np.isnan(began[:, 0]))
    apply.write_shape(ob, ob.data.get(KEY, ""), index, began[index])


def drop(ob: bpy.types.Object) -> None:
    attribute = ob.data.attributes.get(ATTRIBUTE)
    if attribute is not None:
        ob.data.attributes.remove(attribute)
    for name in (LEFT, SIZE, KEY, MADE):
        if name in ob.data:
            del ob.data[name]
