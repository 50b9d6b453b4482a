"""The solve history: the last solve of each object, and whether undo took it back.

Objects go by their full names, which tell those of this file from linked ones.
"""
import bpy
import numpy as np

from ..blender.app_handlers import forget_at_load
from ..model.solution import LastSolve
from ..read import read_mesh, shape_keys

_solves: dict[str, LastSolve] = {}  # by the full name of the object
_undone: dict[str, float] = {}      # by the full name of the object: the run time in the report of the solve taken back

_changed: set[str] = set()          # full names of objects whose mesh is no longer as their last solve left it


def remember_solve(last: LastSolve) -> None:
    """Records a solve that was applied as the last one of its object."""
    _solves[last.patch.name] = last


def find_last_solve(name: str) -> LastSolve | None:
    """Returns the last solve of the object with this full name, None where there is none."""
    return _solves.get(name)


def read_original_shape(ob: bpy.types.Object, result: str) -> np.ndarray | None:
    """Reads the shape before the last run, whose result went to the mesh or a shape key: #vertices x 3, in Object Mode;
    None where the mesh has changed since.
    """
    if result == 'SHAPE_KEY':
        return shape_keys.read_original_shape(ob)
    last = find_last_solve(ob.name_full)
    return None if last is None else read_mesh.read_shape_before(ob, last.patch, last.positions)


def mark_changed(name: str, *, changed: bool) -> None:
    """Records whether an object's mesh is no longer as its last solve left it."""
    if changed:
        _changed.add(name)
    else:
        _changed.discard(name)


def is_changed(ob: bpy.types.Object) -> bool:
    """Returns whether an object's mesh was no longer as its last solve left it when that was last drawn."""
    return ob.name_full in _changed or is_undone(ob)


def mark_undone(ob: bpy.types.Object, *, undone: bool) -> None:
    """Records whether undo took back the solve that the object's report describes."""
    _undone.pop(ob.name_full, None)
    if undone:
        _undone[ob.name_full] = ob.reflection_lines.report.seconds


def is_undone(ob: bpy.types.Object) -> bool:
    """Returns whether undo took back the solve that the object's report describes; a later report has another run time.
    """
    return _undone.get(ob.name_full) == ob.reflection_lines.report.seconds


register, unregister = forget_at_load(_solves.clear, _undone.clear, _changed.clear)
