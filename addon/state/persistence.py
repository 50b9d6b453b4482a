"""Saving and loading of last solves with the .blend file, so that maps, Before and Re-solve survive it; and tracking of
undo.
"""
import bpy
from bpy.app.handlers import persistent

from ..blender.app_handlers import listen
from ..model.solution import LastSolve
from ..read import read_mesh, shape_keys
from ..write import solve_record
from . import solve_history


@persistent
def save_solves(*_: object) -> None:
    """Writes the last solve of every object into its properties, before the file is saved."""
    for ob in (each for each in bpy.data.objects if each.library is None):
        stored, last = ob.reflection_lines, solve_history.find_last_solve(ob.name_full)
        if ob.type != 'MESH' or last is None and not stored.last:
            continue
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        current = last is not None and read_mesh.read_shape_before(ob, last.patch, last.positions) is not None
        stored.last = solve_record.encode_solve(last.patch, last.residual) if current else ""


@persistent
def load_solves(*_: object) -> None:
    """Reads the last solves from the properties, after a file was opened; handles of a file of before can be keyed."""
    for ob in bpy.data.objects:
        text = ob.reflection_lines.last
        found = solve_record.decode_solve(ob, text) if text and ob.type == 'MESH' else None
        if found is not None:
            solve_history.remember_solve(LastSolve(*found))
        if ob.type == 'MESH' and ob.library is None and ob.override_library is None:
            ob.reflection_lines.handles.adopt(ob.data)


@persistent
def note_undo(*_: object) -> None:
    """Records after undo and redo in Edit Mode, which change the mesh but not the object's report, whether the solve is
    undone.
    """
    for ob in bpy.data.objects:
        last = solve_history.find_last_solve(ob.name_full)
        if last is None or ob.type != 'MESH' or ob.mode != 'EDIT':  # it may have been converted since
            continue
        if last.patch.key and not shape_keys.is_result_key_edited(ob):
            continue
        solve_history.mark_undone(ob, undone=read_mesh.is_undone(ob, last.patch, last.positions))


register, unregister = listen((("undo_post", note_undo), ("redo_post", note_undo), ("save_pre", save_solves),
                               ("load_post", load_solves)))
