"""Which kind of panel an object is for the solver."""
import bpy
import numpy as np

from . import cage, gather, keys, modifiers
from .gather import Panel


def gathered(ob: bpy.types.Object, solve_for: str, result: str, local: np.ndarray | None = None, *,
             or_all: bool = False) -> Panel:
    """`solve_for` and `result` as in properties; the rest as in gather.gather."""
    key = keys.NAME if result == 'SHAPE_KEY' else ""
    if solve_for == 'CAGE' and modifiers.is_cage(ob):
        return cage.gather_cage(ob, local, key, or_all=or_all)
    return gather.gather(ob, local, key, or_all=or_all)
