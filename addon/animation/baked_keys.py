"""The shape keys of baked handles: one for each frame, whose value is keyed from 0 to 1 and back to 0."""
import re
from collections.abc import Sequence

import bpy
import numpy as np

from ..blender import compat
from ..model.refusal import Refusal

NAME = "Reflection Lines Frame"
OWN = re.compile(re.escape(NAME) + r" -?\d+(\.\d+)?")


def format_name(frame: float) -> str:
    """Returns the name of a frame's key; another name makes a key the artist's own."""
    return f"{NAME} {frame:.4f}".rstrip("0").rstrip(".")


def find_baked_keys(ob: bpy.types.Object) -> list[bpy.types.ShapeKey]:
    keys = ob.data.shape_keys
    return [] if keys is None else [key for key in keys.key_blocks if OWN.fullmatch(key.name)]


def are_seen(ob: bpy.types.Object) -> bool:
    """Returns whether baked keys are mixed into what is seen."""
    return any(not key.mute for key in find_baked_keys(ob))


def has_only_baked_keys(ob: bpy.types.Object) -> bool:
    """Returns whether the mesh has baked keys and none beside their basis, which is the active one."""
    keys, own = ob.data.shape_keys, len(find_baked_keys(ob))
    return own > 0 and own + 1 == len(keys.key_blocks) and ob.active_shape_key == keys.reference_key


def refuse_foreign_action(ob: bpy.types.Object) -> None:
    """Refuses shape keys whose action cannot take keys."""
    data = ob.data.shape_keys.animation_data if ob.data.shape_keys is not None else None
    action = data.action if data is not None else None
    if action is not None and action.library is not None:
        raise Refusal(f"{ob.name}: the action {action.name} of its shape keys is linked from another file: make it "
                      "local")


def replace_baked_keys(ob: bpy.types.Object, frames: Sequence[float], shapes: Sequence[np.ndarray], basis: str) -> None:
    """Replaces the baked keys by one for each frame, with its shape (#vertices x 3) relative to the key `basis`; the
    mesh gets a first key where it has none. In Object Mode; the active key stays.
    """
    active = ob.active_shape_key.name if ob.active_shape_key is not None else ""
    remove_baked_keys(ob)
    if ob.data.shape_keys is None:
        ob.shape_key_add(name=basis, from_mix=False)
    blocks = ob.data.shape_keys.key_blocks
    for number, (frame, shape) in enumerate(zip(frames, shapes, strict=True)):
        key = ob.shape_key_add(name=format_name(frame), from_mix=False)
        key.relative_key = blocks[basis]
        key.data.foreach_set("co", shape.astype(np.float32).ravel())
        insert_keys(key, [(frames[at], float(at == number)) for at in (number - 1, number, number + 1)
                          if 0 <= at < len(frames)])
    ob.active_shape_key_index = max(blocks.find(active), 0)
    ob.data.update()


def insert_keys(key: bpy.types.ShapeKey, values: Sequence[tuple[float, float]]) -> None:
    """Keys the value of a shape key at (frame, value), linearly between them."""
    for frame, value in values:
        key.value = value
        key.keyframe_insert("value", frame=frame)
    curve = find_value_curve(key)
    for point in curve.keyframe_points:
        point.interpolation = 'LINEAR'
    curve.update()


def find_value_curve(key: bpy.types.ShapeKey) -> bpy.types.FCurve | None:
    data = key.id_data.animation_data
    curves = compat.find_action_curves(data) if data is not None else None
    return None if curves is None else curves.find(key.path_from_id("value"))


def remove_baked_keys(ob: bpy.types.Object) -> None:
    """Removes the baked keys, with the keys of their values."""
    for key in find_baked_keys(ob):
        curve = find_value_curve(key)
        if curve is not None:
            compat.find_action_curves(key.id_data.animation_data).remove(curve)
        ob.shape_key_remove(key)
