"""Describes the handles of a session for the header and the status bar."""
import bpy

from .. import native
from ..blender import units
from ..model.line_handle import Handles

PULL_TEXT = "Drag: pull a line   Alt click, P: pin it   D: draw one"
START_TEXT = "Drag: draw the line at its start   N: the nearest line   D: pull one"
NEAREST_TEXT = "Drag: draw the nearest line   N: the line at its start   D: pull one"
KEYS_TEXT = ("S: straighten   E: follow edge   X: delete   M: mute   Wheel, F, 0-9: radius   Shift: finer   "
             "Ctrl: back   Ctrl Z: undo   Enter: apply   Esc: cancel")


def describe_keys(*, draws: bool, nearest: bool) -> str:
    """Says what a press does, and the keys that change that."""
    press = PULL_TEXT if not draws else NEAREST_TEXT if nearest else START_TEXT
    return f"{press}   {KEYS_TEXT}"


def describe_other(name: str, other: str) -> str:
    """Says how the lines of another panel than that of a session are pulled."""
    return f"Handles belong to one object, here {name}: press Enter, make {other} active, and pull its lines"


def describe_handle(scene: bpy.types.Scene, handles: Handles, index: int, reached: "list[native.HandleResidual]",
                    typed: str) -> str:
    """Says how far the line of a handle is from it, and its radius. `reached` are those of the handles that are not
    muted, `typed` what is typed of the radius.
    """
    own, number = handles[index], index + 1
    if own.is_pin or own.muted:
        return f"{'Pin' if own.is_pin else 'Handle'} {number}{', muted' if own.muted else ''}"
    radius = f"Radius: {f'[{typed}|] = ' if typed else ''}{units.format_length(own.radius, scene)}"
    place = sum(not each.muted for each in handles[:index])
    if place >= len(reached):
        return radius
    length = units.format_length(reached[place].distance, scene, precision=2)
    return f"Line {reached[place].fraction:.1%} of the spacing beside handle {number} ({length})   {radius}"
