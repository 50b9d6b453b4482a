"""The shape key that takes results. It is relative to the shape that the tool began with, so its value is the strength.
"""
import bpy
import numpy as np

from ..animation import baked_keys
from . import read_mesh

NAME = "Reflection Lines"


def is_result_key_edited(ob: bpy.types.Object) -> bool:
    """Returns whether the object is in Edit Mode on the result's key."""
    return ob.mode == 'EDIT' and ob.active_shape_key is not None and ob.active_shape_key.name == NAME


def read_original_shape(ob: bpy.types.Object) -> np.ndarray | None:
    """Reads the shape that the result's key is relative to: #vertices x 3, in Object Mode; None without that key."""
    keys = ob.data.shape_keys
    key = keys.key_blocks.get(NAME) if keys is not None else None
    return None if key is None else read_mesh.read_coordinates(ob, key.relative_key.name)


def read_seen_fraction(ob: bpy.types.Object, name: str) -> float:
    """Reads how much is seen of the shape key of this name; all of it in Edit Mode, or where there is none."""
    blocks = ob.data.shape_keys.key_blocks if ob.data.shape_keys is not None else {}
    key = blocks.get(name)
    if key is None or ob.mode == 'EDIT' or ob.show_only_shape_key:
        return 1.0
    return 0.0 if key.mute else key.value


def read_mixed_shape(ob: bpy.types.Object) -> np.ndarray | None:
    """Reads the shape that the keys are mixed to in Object Mode: #vertices x 3; None where that takes vertex groups or
    times.
    """
    keys = ob.data.shape_keys
    if keys is None:
        return read_mesh.read_coordinates(ob)
    if ob.show_only_shape_key:
        return read_mesh.read_coordinates(ob, (keys.reference_key if ob.active_shape_key.mute else
                                               ob.active_shape_key).name)
    added = [key for key in keys.key_blocks if key != keys.reference_key and not key.mute and key.value != 0.0]
    if not keys.use_relative or any(key.vertex_group for key in added):
        return None
    mixed = read_mesh.read_coordinates(ob, keys.reference_key.name)
    for key in added:
        mixed += key.value * (read_mesh.read_coordinates(ob, key.name)
                              - read_mesh.read_coordinates(ob, key.relative_key.name))
    return mixed


def describe_hidden_key(ob: bpy.types.Object, name: str) -> tuple[str, ...]:
    """Describes why the result in the key of this name cannot be seen: a sentence, or nothing."""
    if baked_keys.are_seen(ob):
        return (f"Nothing of the result is seen, since the shape keys {baked_keys.NAME} are seen instead of it: bake "
                "again, or delete them",)
    blocks = ob.data.shape_keys.key_blocks if ob.data.shape_keys is not None else {}
    key = blocks.get(name)
    if key is None or key.value != 0.0 and not key.mute:
        return ()
    why = "is muted: unmute it" if key.mute else "has the value 0: raise its Strength"
    return (f"Nothing of the result is seen, since the shape key {name} {why}",)
