"""What becomes of last solves: written into the file when it is saved and read when it is opened, so that maps, Before
and Re-solve go on; and noted where undo takes them back."""
import bpy
from bpy.app.handlers import persistent

from . import session
from .bridge import apply, keys, record
from .solving import Last


@persistent
def save(*_: object) -> None:
    for ob in bpy.data.objects:
        stored, last = ob.reflection_lines, session.last_solution(ob.name)
        if ob.type != 'MESH' or last is None and not stored.last:
            continue
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        current = last is not None and apply.before(ob, last.panel, last.positions) is not None
        stored.last = record.written(last.panel, last.residual) if current else ""


@persistent
def load(*_: object) -> None:
    for ob in bpy.data.objects:
        text = ob.reflection_lines.last
        found = record.read(ob, text) if text and ob.type == 'MESH' else None
        if found is not None:
            session.remember(Last(*found))


@persistent
def note_undone(*_: object) -> None:
    """Undo and redo in Edit Mode change the mesh, but not what is told of the object."""
    for ob in bpy.data.objects:
        last = session.last_solution(ob.name)
        if last is None or ob.mode != 'EDIT' or last.panel.key and not keys.is_edited(ob):
            continue
        session.undone.pop(ob.name, None)
        if apply.is_undone(ob, last.panel, last.positions):
            session.undone[ob.name] = ob.reflection_lines.report.seconds


def register() -> None:
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        handlers.append(note_undone)
    bpy.app.handlers.save_pre.append(save)
    bpy.app.handlers.load_post.append(load)


def unregister() -> None:
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        handlers.remove(note_undone)
    bpy.app.handlers.load_post.remove(load)
    bpy.app.handlers.save_pre.remove(save)
