"""Gathers the patch of an object: of its cage or of its mesh, whichever is solved for."""
from dataclasses import replace

import bpy
import numpy as np

from ..model.beside import Crossing
from ..model.patch import Patch
from . import modifiers, read_beside, read_cage, read_patch, shape_keys
from .mesh_checks import Purpose


def gather_patch(ob: bpy.types.Object, solve_for: str, result: str, local: np.ndarray | None = None, *,
             or_all: bool = False, purpose: Purpose = Purpose.WRITE, margin: float = 0.0,
                 crossing: Crossing | None = None) -> Patch:
    """Gathers the patch of an object, for the mesh or its cage.

    `solve_for` and `result` are values of the properties of these names; the rest is as in
    read_patch.gather_mesh_patch.
    """
    key = shape_keys.NAME if result == 'SHAPE_KEY' else ""
    if solve_for == 'CAGE' and modifiers.is_cage(ob):
        patch = read_cage.gather_cage_patch(ob, local, key, or_all=or_all, purpose=purpose)
        if crossing is None or not crossing.concerns(patch.border):
            return patch
        return replace(patch, beside=read_beside.measure_beside(patch))
    return read_patch.gather_mesh_patch(ob, local, key, or_all=or_all, purpose=purpose, margin=margin,
                                        crossing=crossing)
