"""Reads each vertex's share of the limit: the way that it may move, and the weight in a vertex group."""
import bpy
import numpy as np

from . import group_weights


def read_limit_share(ob: bpy.types.Object, index: np.ndarray) -> np.ndarray | None:
    """Reads the shares for a patch's vertices, whose numbers in the mesh are `index` (#V): #V x 2, of the lowest move
    -1 to 0 and of the highest 0 to 1; None where all have the whole limit.
    """
    settings = ob.reflection_lines
    ways = np.array([-float(settings.limit_side != 'OUTWARD'), float(settings.limit_side != 'INWARD')])
    share = group_weights.read_group_weights(ob, settings.limit_group, "the limit")[index][:, None] * ways
    return None if (np.abs(share) == 1.0).all() else share
