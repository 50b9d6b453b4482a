"""Reads the mirror symmetry of an object: its Mirror modifier, or Blender's option Mirror X."""
import bpy
import numpy as np

from ..model import mirror
from ..model.mirror import Mirror

ROUNDING = 4.0 * np.finfo(np.float32).eps  # of the matrices of two objects, relative to the coordinates


def read_mirror(ob: bpy.types.Object, local: np.ndarray) -> Mirror | None:
    """Reads the mirror symmetry of the region whose vertices are `local` (#V x 3, object space); None where there is
    none.
    """
    shown = [modifier for modifier in ob.modifiers if modifier.show_viewport]
    mirrors = [modifier for modifier in shown if modifier.type == 'MIRROR']
    if mirrors:
        first = mirrors[0]
        axes = [axis for axis in range(3) if first.use_axis[axis]]
        merged = first.merge_threshold / 2.0 if first.use_mirror_merge else 0.0
        seam = np.any([find_modifier_seam(ob, modifier, local) for modifier in mirrors], axis=0)
        one_plane = len(mirrors) == len(axes) == 1 and not any(first.use_bisect_axis)
        alone = one_plane and shown[0] == first and first.mirror_object is None
        return Mirror(axes[0] if alone else -1, np.where(seam, np.arange(len(local)), -1), True, merged,
                      find_reflection(ob, first) if one_plane else None)
    return Mirror(0, mirror.find_pairs(local, 0), False) if ob.data.use_mirror_x else None


def find_reflection(ob: bpy.types.Object, modifier: bpy.types.MirrorModifier) -> np.ndarray | None:
    """Finds the reflection of world space (4 x 4) about the only plane of a Mirror modifier; None where its object has
    none, being flat.
    """
    frame = np.array((modifier.mirror_object or ob).matrix_world, dtype=np.float64)
    back = np.array((modifier.mirror_object or ob).matrix_world.inverted_safe(), dtype=np.float64)
    found = frame @ np.diag([*(-1.0 if axis else 1.0 for axis in modifier.use_axis), 1.0]) @ back
    return found if np.isfinite(found).all() else None


def find_modifier_seam(ob: bpy.types.Object, modifier: bpy.types.MirrorModifier, local: np.ndarray) -> np.ndarray:
    """Finds the vertices (#V, bool) that a Mirror modifier joins with their images, about any of its planes. Those are
    the coordinate planes of the mirror object where there is one, which rounding may have shifted a little.
    """
    axes = [axis for axis in range(3) if modifier.use_axis[axis]]
    merged = modifier.merge_threshold / 2.0 if modifier.use_mirror_merge else 0.0
    if modifier.mirror_object is None:
        return (np.abs(local[:, axes]) <= merged).any(axis=1)
    there = np.array(modifier.mirror_object.matrix_world.inverted_safe() @ ob.matrix_world, dtype=np.float64)
    if not np.isfinite(there).all():
        return np.zeros(len(local), dtype=bool)
    placed = local @ there[:3, :3].T + there[:3, 3]
    rounding = ROUNDING * np.abs(placed).max(initial=0.0)
    sizes = np.linalg.norm(np.linalg.pinv(there[:3, :3]), axis=0)  # of the mirror object's axes in object space
    return (np.abs(placed[:, axes]) * sizes[axes] <= merged + rounding * sizes[axes]).any(axis=1)
