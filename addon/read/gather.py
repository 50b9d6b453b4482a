"""Gathers the patch of an object: of its cage or of its mesh, whichever is solved for."""
from dataclasses import replace

import bpy
import numpy as np

from ..model.beside import Crossing
from ..model.patch import Patch
from ..model.region_patch import cut_patch
from . import modifiers, read_beside, read_cage, read_snapshot, shape_keys
from .mesh_checks import Purpose


def gather_patch(ob: bpy.types.Object, result: str = 'MESH', local: np.ndarray | None = None, *, as_mesh: bool = False,
                 or_all: bool = False, purpose: Purpose = Purpose.WRITE, margin: float = 0.0,
                 crossing: Crossing | None = None) -> Patch:
    """Reads the mesh of an object once, and gathers its patch: of the subdivided surface where it is a cage.

    `result` is a value of the property of this name; `as_mesh` gathers a cage's own faces; `local`, `or_all` and
    `purpose` are as in read_snapshot, `margin` as in cut_patch, for a mesh. `crossing` says what the border follows,
    where it does.
    """
    key = shape_keys.NAME if result == 'SHAPE_KEY' else ""
    snapshot = read_snapshot.read_snapshot(ob, key, local, or_all=or_all, purpose=purpose)
    is_cage = not as_mesh and modifiers.is_cage(ob)
    patch = cut_patch(snapshot, 0.0 if is_cage else margin)
    if is_cage:
        patch = read_cage.build_cage_patch(ob, snapshot, patch)
    if crossing is None or not crossing.concerns(patch.border):
        return patch
    return replace(patch, beside=read_beside.measure_beside(patch) if is_cage else
                   read_beside.read_beside(ob, snapshot, patch, crossing))
