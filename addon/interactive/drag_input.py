"""The input of a drag by keys, wheel and clicks, and the text of its values, for dragged tools and Sweep Light.

Moves of the mouse are the operator's own. What a key changes is in drag_handles.py.
"""
import bpy
import numpy as np

from ..blender import units
from .drag_handles import DragValues, Handle

DIGITS = {name: str(digit) for digit, word in enumerate(
    ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE"))
    for name in (word, f"NUMPAD_{digit}")}
CHARACTERS = DIGITS | {'PERIOD': '.', 'NUMPAD_PERIOD': '.', 'COMMA': '.', 'MINUS': '-', 'NUMPAD_MINUS': '-'}
NOTCHES = {'WHEELUPMOUSE': 1, 'WHEELDOWNMOUSE': -1}
KEEP_KEYS, CANCEL_KEYS = {'LEFTMOUSE', 'RET', 'NUMPAD_ENTER'}, {'ESC', 'RIGHTMOUSE'}
NAVIGATION = {'MIDDLEMOUSE', 'TRACKPADPAN', 'TRACKPADZOOM', 'NDOF_MOTION'}
KEYS_TEXT = "Click, Enter: keep   Esc: cancel   Shift: finer   0-9, =: type"


def read_values(handles: tuple[Handle, ...], starts: tuple[float, ...], scene: bpy.types.Scene) -> DragValues:
    """Returns the values of a new drag; typed texts are read in the scene's units."""
    return DragValues(handles, starts, lambda handle, text: units.parse_number(text, handle.unit, scene))


def cancels(event: bpy.types.Event) -> bool:
    """Returns whether an event takes the drag back."""
    return event.type in CANCEL_KEYS and event.value == 'PRESS'


def keeps(event: bpy.types.Event, values: DragValues, *, held: bool) -> bool:
    """Returns whether an event keeps the values: Enter or a click. Where the mouse button is `held` since the drag
    began, on a gizmo, letting go of it keeps them too, unless the mouse has not moved.
    """
    if event.value == 'PRESS':
        return event.type in KEEP_KEYS
    return held and event.type == 'LEFTMOUSE' and event.value == 'RELEASE' and any(values.pixels)


def navigates(event: bpy.types.Event, values: DragValues) -> bool:
    """Returns whether an event turns or zooms the 3D view; the wheel does where it changes no value."""
    return event.type in NAVIGATION or event.type in NOTCHES and values.find_wheel_handle() is None


def change_values(values: DragValues, event: bpy.types.Event) -> None:
    """Changes the values by a notch of the wheel or a key."""
    if event.type in NOTCHES:
        values.wheel(NOTCHES[event.type], precise=event.shift)
    elif event.value == 'PRESS':
        type_key(values, event)


def type_key(values: DragValues, event: bpy.types.Event) -> None:
    """Takes a key of the typed text, or one that works on it."""
    if event.type == 'TAB':
        values.hold_next()
    elif event.type == 'BACK_SPACE':
        values.erase()
    elif not (event.ctrl or event.alt or event.oskey):
        values.type(read_character(event))


def read_character(event: bpy.types.Event) -> str:
    """Returns what a key types: by the layout of the keyboard, where Blender tells that, with a point for a comma."""
    typed = event.unicode if event.unicode.isprintable() else ""
    return (typed or CHARACTERS.get(event.type, "")).replace(',', '.')


def describe_keys(values: DragValues) -> str:
    """Describes the keys of a drag for the status bar."""
    more = "   Tab: next value" if len(values.handles) > 1 else ""
    turned = values.find_wheel_handle()
    wheel = f"   Wheel: {turned.label.lower()}" if turned else ""
    return f"{KEYS_TEXT}{more}{wheel}   MMB: view"


def describe_values(values: DragValues, scene: bpy.types.Scene) -> str:
    """Describes all values for the header."""
    return "   ".join(describe_value(values, index, scene) for index in range(len(values.handles)))


def describe_value(values: DragValues, index: int, scene: bpy.types.Scene) -> str:
    """Describes one value: with the typed text, as Blender's own tools show it, and marked where it is held."""
    handle, typed = values.handles[index], values.typed[index]
    held = index == values.held and len(values.handles) > 1
    shown = format_value(handle, values.value(index), scene)
    if typed:  # with the value that the limits leave
        shown = f"[{typed}|] = {shown if values.numbers[index] is not None else '?'}"
    return f"{'> ' if held else ''}{handle.label}: {shown}"


def format_value(handle: Handle, value: float, scene: bpy.types.Scene) -> str:
    """Formats a handle's value in the scene's units."""
    if handle.unit == 'ANGLE':
        degrees = scene.unit_settings.system_rotation == 'DEGREES'
        return f"{np.degrees(value):.2f}\u00b0" if degrees else f"{value:.4f}"
    if handle.unit == 'LENGTH':
        return units.format_length(value, scene)
    return f"{value:.1f} %" if handle.unit == 'PERCENT' else f"{value:.3f}"
