"""Reads the mirror symmetry of an object: its Mirror modifier, or Blender's option Mirror X."""
import bpy
import numpy as np

from ..model import mirror
from ..model.mirror import Mirror


def read_mirror(ob: bpy.types.Object, local: np.ndarray) -> Mirror | None:
    """Reads the mirror symmetry of the region whose vertices are `local` (#V x 3, object space); None where there is
    none.
    """
    shown = [modifier for modifier in ob.modifiers if modifier.show_viewport]
    mirrors = [modifier for modifier in shown if modifier.type == 'MIRROR' and modifier.mirror_object is None]
    if mirrors:
        first = mirrors[0]
        axes = [axis for axis in range(3) if first.use_axis[axis]]
        reach = first.merge_threshold / 2.0 if first.use_mirror_merge else 0.0
        seam = (np.abs(local[:, axes]) <= reach).any(axis=1)
        alone = len(mirrors) == len(axes) == 1 and shown[0] == first and not any(first.use_bisect_axis)
        return Mirror(axes[0] if alone else -1, np.where(seam, np.arange(len(local)), -1), True, reach)
    return Mirror(0, mirror.find_pairs(local, 0), False) if ob.data.use_mirror_x else None
