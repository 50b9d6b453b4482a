"""The animation of kept handles: F-curves and drivers, which name a handle by its place among those of its object."""
import re
from collections.abc import Iterator

import bpy
import numpy as np

from ..blender import compat

PATH = re.compile(r"reflection_lines\.handles\.kept\[(\d{1,9})\](\..+)", re.DOTALL)
LAST_FRAME = 2**20  # just beyond Blender's

Curves = bpy.types.bpy_prop_collection  # of F-curves
Holder = bpy.types.AnimData | bpy.types.NlaStrip


def list_keyed_frames(ob: bpy.types.Object) -> list[float]:
    """Returns the frames at which the object's action has keys of handles, each once, in order."""
    data = ob.animation_data
    curves = compat.find_action_curves(data) if data is not None else None
    frames = [key.co.x for curve in curves or () if PATH.fullmatch(curve.data_path) for key in curve.keyframe_points]
    return sorted({frame for frame in frames if abs(frame) < LAST_FRAME})


def has_animated_handles(ob: bpy.types.Object) -> bool:
    """Returns whether keys, strips or drivers change the object's handles."""
    data = ob.animation_data
    if data is None:
        return False
    owned = (data.drivers, *(compat.find_action_curves(each) or () for each in find_holders(ob)))
    return any(PATH.fullmatch(curve.data_path) for curves in owned for curve in curves)


def move_keys(ob: bpy.types.Object, moves: dict[int, int | None]) -> tuple[str, ...]:
    """Moves the animation of handles with them to their new places in the order, and removes that of handles that are
    gone (None). Returns a sentence about each that was removed, and about each action that cannot be changed.
    """
    if ob.animation_data is None or all(index == new for index, new in moves.items()):
        return ()
    gone = move_curves(ob.animation_data.drivers, moves)
    notes = []
    for holder in list_changed_holders(ob, moves):
        foreign = describe_foreign_action(ob, holder)
        notes += [foreign] if foreign else []
        gone |= set() if foreign else move_curves(compat.find_action_curves(holder), moves)
    handles = ", ".join(str(index + 1) for index in sorted(gone))
    return (*notes, *((f"The keys of handle {handles} were removed with it" if len(gone) == 1 else
                       f"The keys of the handles {handles} were removed with them",) if gone else ()))


def insert_auto_keys(ob: bpy.types.Object, scene: bpy.types.Scene, changed: list[tuple[int, str]]) -> None:
    """Inserts keys at the present frame for changed values of handles, given by place and name, as Blender's Auto
    Keying does: where it is on, and for those that have keys.
    """
    data = ob.animation_data
    if not scene.tool_settings.use_keyframe_insert_auto or data is None or data.action is None or data.action.library:
        return
    keyed = {curve.data_path for curve in compat.find_action_curves(data) or ()}
    for index, name in changed:
        if f"reflection_lines.handles.kept[{index}].{name}" in keyed:
            ob.reflection_lines.handles.kept[index].keyframe_insert(name)


def move_curves(curves: Curves, moves: dict[int, int | None]) -> set[int]:
    """Moves F-curves to new places of their handles; returns the places of those that were removed."""
    gone = set()
    for curve in list(curves):
        found = PATH.fullmatch(curve.data_path)
        index = int(found[1]) if found else None
        if index not in moves:
            continue
        if moves[index] is None:
            curves.remove(curve)
            gone.add(index)
        elif moves[index] != index:
            curve.data_path = f"reflection_lines.handles.kept[{moves[index]}]{found[2]}"
    return gone


def list_changed_holders(ob: bpy.types.Object, moves: dict[int, int | None]) -> list[Holder]:
    """Returns who uses actions of the object with keys that have to move, one for each action and slot."""
    holders = {}
    for holder in find_holders(ob):
        found = [PATH.fullmatch(curve.data_path) for curve in compat.find_action_curves(holder) or ()]
        if any(each and moves.get(int(each[1]), -1) not in (-1, int(each[1])) for each in found):
            holders.setdefault((holder.action.name_full, compat.find_slot_number(holder)), holder)
    return list(holders.values())


def find_holders(ob: bpy.types.Object) -> Iterator[Holder]:
    """Yields the object's animation data, and its strips in the nonlinear animation."""
    if ob.animation_data is not None:
        yield ob.animation_data
        for track in ob.animation_data.nla_tracks:
            yield from list_strips(track.strips)


def list_strips(strips: bpy.types.bpy_prop_collection) -> Iterator[bpy.types.NlaStrip]:
    """Yields strips, and those inside meta strips."""
    for strip in strips:
        yield strip
        yield from list_strips(strip.strips)


def describe_foreign_action(ob: bpy.types.Object, holder: Holder) -> str:
    """Says that keys stay where they are, since the action is not the object's alone; empty where it is."""
    action, slot = holder.action, compat.find_slot_number(holder)
    others = [other.name for other in bpy.data.objects if other != ob
              and any(each.action == action and compat.find_slot_number(each) == slot for each in find_holders(other))]
    linked = "is linked from another file" if action.library is not None else ""
    why = linked or (f"animates {others[0]} too" if others else "")
    return (f"The keys in {action.name} stay where they are and act on other handles now, since that action {why}: "
            "undo, and make it the object's own first") if why else ""


def set_frame(scene: bpy.types.Scene, frame: float) -> None:
    """Sets a frame with its part, and evaluates the scene."""
    whole = int(np.floor(frame))
    scene.frame_set(whole, subframe=min(frame - whole, 0.99999))
