"""The shape key that takes results: relative to the shape that the tool began with, so its value is the strength."""
import bpy
import numpy as np

from . import gather

NAME = "Reflection Lines"


def open_key(ob: bpy.types.Object) -> list[str]:
    """Makes it where it is not there, and the active one. In Object Mode. The names of the keys that were made."""
    made = [] if ob.data.shape_keys is not None else [ob.shape_key_add(name="Basis", from_mix=False).name]
    blocks = ob.data.shape_keys.key_blocks
    if blocks.get(NAME) is None:
        began, shape = ob.active_shape_key, gather.coordinates(ob).astype(np.float32)
        key = ob.shape_key_add(name=NAME, from_mix=False)
        key.relative_key, key.value = began, 1.0
        key.data.foreach_set("co", shape.ravel())
        made.append(key.name)
    ob.active_shape_key_index = blocks.find(NAME)
    return made


def is_edited(ob: bpy.types.Object) -> bool:
    return ob.mode == 'EDIT' and ob.active_shape_key is not None and ob.active_shape_key.name == NAME


def close_key(ob: bpy.types.Object, made: list[str]) -> None:
    """Takes away what `open_key` made."""
    blocks = ob.data.shape_keys.key_blocks if ob.data.shape_keys is not None else {}
    for key in [blocks[name] for name in reversed(made) if name in blocks]:
        ob.shape_key_remove(key)


def original(ob: bpy.types.Object) -> np.ndarray | None:
    """#vertices x 3: the shape that the key is relative to; None where there is no such key. In Object Mode."""
    keys = ob.data.shape_keys
    key = keys.key_blocks.get(NAME) if keys is not None else None
    return None if key is None else gather.coordinates(ob, key.relative_key.name)


def remarks(ob: bpy.types.Object, name: str) -> tuple[str, ...]:
    """Why nothing is seen of what went into the key with this name, as a sentence; empty for the mesh itself."""
    blocks = ob.data.shape_keys.key_blocks if ob.data.shape_keys is not None else {}
    key = blocks.get(name)
    if key is None or key.value != 0.0 and not key.mute:
        return ()
    why = "is muted: unmute it" if key.mute else "has the value 0: raise its Strength"
    return (f"Nothing of the result is seen, since the shape key {name} {why}",)
