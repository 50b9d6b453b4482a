"""Reads the range of each vertex's move within the limit: by the side that it may move to, and a vertex group."""
import bpy
import numpy as np

from . import group_weights


def read_limit_range(ob: bpy.types.Object, index: np.ndarray) -> np.ndarray | None:
    """Reads the ranges of a patch's vertices, whose numbers in the mesh are `index` (#V): #V x 2, of the lowest move
    -1 to 0 and of the highest 0 to 1; None where all have the whole limit.
    """
    settings = ob.reflection_lines
    ways = np.array([-float(settings.limit_side != 'OUTWARD'), float(settings.limit_side != 'INWARD')])
    ranges = group_weights.read_group_weights(ob, settings.limit_group, "the limit")[index][:, None] * ways
    return None if (np.abs(ranges) == 1.0).all() else ranges
