"""Refuses meshes that cannot be solved or written, each in one sentence."""
from enum import Enum, auto

import bpy
import numpy as np

from ..animation import baked_keys
from ..blender import compat
from ..model.refusal import Refusal


class Purpose(Enum):
    """A purpose that a mesh is read for; it decides what is refused."""
    WRITE = auto()         # to be written in the mode it is in
    WRITE_SHARED = auto()  # in Object Mode also where other objects use it
    READ = auto()          # to be measured only
    WRITE_EDITED = auto()  # by a run that came from Edit Mode, so as there: also where it is shared, or has shape keys


def refuse_unusable(ob: bpy.types.Object, key: str, purpose: Purpose) -> None:
    """Refuses objects whose mesh cannot be written: linked, shared, with locked or missing shape keys, or of no extent.
    """
    refuse_flat(ob)
    if purpose is Purpose.READ:
        return
    refuse_linked(ob)
    mesh, keys = ob.data, ob.data.shape_keys
    if mesh.override_library is not None:
        raise Refusal(f"The mesh of {ob.name} is linked from another file and overridden here, which keeps no moved "
                      "vertices: make it local")
    edited = ob.mode == 'EDIT' or purpose is Purpose.WRITE_EDITED
    if not edited and keys is not None and not key and not baked_keys.has_only_baked_keys(ob):
        raise Refusal(f"{ob.name} has shape keys: enter Edit Mode on the key that is to be changed, "
                      "or choose the result Shape Key")
    if key and keys is not None and not keys.use_relative:
        raise Refusal(f"{ob.name} has absolute shape keys, which cannot be mixed: choose the result Mesh in Edit Mode")
    refuse_mixed_keys(ob, key)
    others = count_sharers(ob) if not edited and purpose is not Purpose.WRITE_SHARED else 0
    if others:
        raise Refusal(f"{ob.name} shares its mesh with {others} other object{'s' if others > 1 else ''}: "
                      "make it single-user, or work in Edit Mode")
    written = keys and (keys.key_blocks.get(key) or (None if key else ob.active_shape_key))
    if written and compat.is_shape_locked(written):
        raise Refusal(f"The shape key {written.name} of {ob.name} is locked: unlock it, or choose another")


def refuse_linked(ob: bpy.types.Object) -> None:
    """Refuses an object or its mesh that belongs to another file."""
    if ob.library is not None:
        raise Refusal(f"{ob.name} is linked from another file and cannot be changed here: make it local")
    if ob.data.library is not None:
        raise Refusal(f"The mesh of {ob.name} is linked from another file and cannot be changed here: make it local")


def count_sharers(ob: bpy.types.Object) -> int:
    """Counts the other objects with the same mesh. A deleted one, kept only by a property that points at it, is none.
    """
    if ob.data.users - ob.data.use_fake_user < 2:
        return 0
    return sum(other.data == ob.data and other != ob and len(other.users_collection) > 0 for other in bpy.data.objects)


def refuse_flat(ob: bpy.types.Object) -> None:
    """Refuses objects of no extent, and those whose transform is no number."""
    scale = np.array(ob.matrix_world, dtype=np.float64)[:3, :3]
    if not np.isfinite(scale).all() or np.linalg.matrix_rank(scale) < 3:
        raise Refusal(f"{ob.name} is scaled to nothing in one direction: give it a scale other than zero")


def refuse_mixed_keys(ob: bpy.types.Object, key: str) -> None:
    """Refuses to put the region of one shape key into another one, which would tear the mesh at the region's border:
    shape keys hold whole shapes.
    """
    edited = ob.active_shape_key if ob.mode == 'EDIT' else None
    if key and edited is not None and edited.name != key and key in ob.data.shape_keys.key_blocks:
        raise Refusal(f"{ob.name} is edited in the shape key {edited.name}, but the result would go into {key}, which "
                      f"is there already: edit {key} to go on with it, or rename it to begin another")


def refuse_broken_coordinates(name: str, vertices: np.ndarray, local: np.ndarray) -> None:
    """Refuses vertices with coordinates that are not finite, which Blender's triangulation of n-gons must not get."""
    if np.isfinite(local).all():
        return
    broken = np.unique(vertices[~np.isfinite(local[vertices]).all(axis=1)])
    if len(broken):
        raise Refusal(f"{name} has {len(broken)} vertices in the region whose coordinates are no numbers, "
                      f"the first is {broken[0]}: delete or move them")


def refuse_taken_attribute(ob: bpy.types.Object, name: str, kind: str) -> None:
    """Refuses a name whose attribute holds something else than one number of this type for each vertex."""
    found = ob.data.attributes.get(name)
    if found is not None and (found.domain, found.data_type) != ('POINT', kind):
        raise Refusal(f"{ob.name} has another attribute {name} ({found.domain.lower()}, {found.data_type.lower()}) "
                      "than is to be stored there: rename or remove it")
