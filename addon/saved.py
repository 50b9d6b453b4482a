"""Last solves are written into the file when it is saved and read when it is opened: maps, Before, Re-solve go on."""
import bpy
from bpy.app.handlers import persistent

from . import session
from .bridge import apply, record
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


def register() -> None:
    bpy.app.handlers.save_pre.append(save)
    bpy.app.handlers.load_post.append(load)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(load)
    bpy.app.handlers.save_pre.remove(save)
