"""The last check of each object as far as it is drawn: its seams by how they changed, and the worst places."""
from dataclasses import dataclass

import bpy
import numpy as np

from ..blender.app_handlers import listen
from ..read import read_mesh


@dataclass(frozen=True)
class DrawnCheck:
    """Seams and places in object space."""
    segments: np.ndarray  # #E x 2 x 3
    change: np.ndarray    # #E: "better", "unchanged", "worse" against before
    worst: np.ndarray     # #W x 3: the worst place of each line of the table that is worse or does not pass
    worse: np.ndarray     # #W, bool: whether that line is worse
    shape: np.ndarray     # #vertices x 3 float32: the whole mesh, of which alone all this is true


_checks: dict[str, DrawnCheck] = {}  # by the full name of the object


def remember_check(name: str, check: DrawnCheck) -> None:
    """Remembers the check of the object with this full name, and forgets those of objects that are gone."""
    for gone in _checks.keys() - {ob.name_full for ob in bpy.data.objects}:
        del _checks[gone]
    _checks[name] = check


def find_check(name: str) -> DrawnCheck | None:
    """Returns the last check of the object with this full name, None where there is none of its present shape."""
    return _checks.get(name)


@bpy.app.handlers.persistent
def forget_changed(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Forgets the checks of meshes that have changed; a new selection or attribute counts as a change, too."""
    for update in depsgraph.updates if _checks else ():
        ob = update.id.original
        check = _checks.get(ob.name_full) if isinstance(ob, bpy.types.Object) else None
        if check is not None and update.is_updated_geometry and not has_shape(ob, check.shape):
            del _checks[ob.name_full]


def has_shape(ob: bpy.types.Object, shape: np.ndarray) -> bool:
    """Returns whether an object is still a mesh with these coordinates: it may have been converted, or another one has
    got its name.
    """
    return ob.type == 'MESH' and np.array_equal(read_mesh.read_shown_coordinates(ob), shape)


@bpy.app.handlers.persistent
def forget_all(*_: object) -> None:
    _checks.clear()


register, unregister = listen(
    (("depsgraph_update_post", forget_changed), ("undo_post", forget_all), ("redo_post", forget_all),
     ("load_pre", forget_all)), forget_all)
