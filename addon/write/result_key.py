"""Adds the shape key that takes results, and removes it."""
import bpy
import numpy as np

from ..read import read_mesh
from ..read.shape_keys import NAME


def open_result_key(ob: bpy.types.Object) -> list[str]:
    """Makes the result's key the active one in Object Mode, adding it where it is missing; returns the names of the
    keys added.
    """
    made = [] if ob.data.shape_keys is not None else [ob.shape_key_add(name="Basis", from_mix=False).name]
    blocks = ob.data.shape_keys.key_blocks
    if blocks.get(NAME) is None:
        began, shape = ob.active_shape_key, read_mesh.read_coordinates(ob).astype(np.float32)
        key = ob.shape_key_add(name=NAME, from_mix=False)
        key.relative_key, key.value = began, 1.0
        key.data.foreach_set("co", shape.ravel())
        made.append(key.name)
    ob.active_shape_key_index = blocks.find(NAME)
    return made


def remove_keys(ob: bpy.types.Object, made: list[str]) -> None:
    """Removes the keys that `open_result_key` added."""
    blocks = ob.data.shape_keys.key_blocks if ob.data.shape_keys is not None else {}
    for key in [blocks[name] for name in reversed(made) if name in blocks]:
        ob.shape_key_remove(key)
