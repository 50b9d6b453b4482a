"""Drag handles, by which mouse, wheel and typed text set a tool's values. No Blender.

A value depends on the mouse's position, not on its path, so a closed path ends where it began.
"""
import string
from collections.abc import Callable, Sequence
from dataclasses import dataclass

PRECISE_FACTOR = 0.1  # factor of the mouse's move while Shift is held
NOTCH_PIXELS = 20.0  # move of the mouse that a notch of the wheel equals
OPERATORS = "+*/("   # they begin an expression, as '=' does
CHARACTERS = frozenset(string.ascii_letters + string.digits + OPERATORS + ".)-=%'\" \u00b0\u00b5")
FIRST = frozenset(string.digits + OPERATORS + ".-=")  # a text begins with one of these: letters alone are keys


@dataclass(frozen=True)
class Handle:
    """A property that can be dragged."""
    name: str             # name of the property
    label: str
    per_pixel: float      # value a pixel; with `doubles` the power of two a pixel
    low: float
    high: float
    doubles: bool = False
    unit: str = 'NONE'    # 'LENGTH', 'ANGLE' or 'PERCENT': how it is shown and typed
    wheel: bool = False   # whether the wheel changes it

    def value_at(self, start: float, pixels: float) -> float:
        """Returns the value after a move of so many pixels, within the limits."""
        value = start * 2.0**(self.per_pixel * pixels) if self.doubles else start + self.per_pixel * pixels
        return min(max(value, self.low), self.high)


class DragValues:
    """The values of one drag: the held handle, and the moves and typed texts of all handles."""

    def __init__(self, handles: Sequence[Handle], starts: Sequence[float],
                 parse: Callable[[Handle, str], float | None]) -> None:
        """Starts with the properties' values; `parse` returns the number that is typed for a handle, None where the
        text is none yet.
        """
        self.handles, self.starts, self.parse = tuple(handles), tuple(starts), parse
        self.held = 0
        self.pixels = [0.0] * len(self.handles)
        self.typed = [""] * len(self.handles)
        self.numbers: list[float | None] = [None] * len(self.handles)  # what is typed, where that is a number
        self.last: float | None = None

    def move(self, x: float, *, precise: bool) -> None:
        if self.last is not None:
            self.pixels[self.held] += (x - self.last) * (PRECISE_FACTOR if precise else 1.0)
        self.last = x

    def find_wheel_handle(self) -> Handle | None:
        """Returns the handle that the wheel changes, None where there is none."""
        return next((handle for handle in self.handles if handle.wheel), None)

    def wheel(self, notches: int, *, precise: bool) -> None:
        index = self.handles.index(self.find_wheel_handle())
        self.pixels[index] += NOTCH_PIXELS * notches * (PRECISE_FACTOR if precise else 1.0)

    def hold_next(self) -> None:
        self.held = (self.held + 1) % len(self.handles)

    def type(self, character: str) -> None:
        """Appends a character to the typed text, where it can stand there. '=' begins an expression; outside of one '-'
        toggles the sign.
        """
        text, allowed = self.typed[self.held], CHARACTERS if self.typed[self.held] else FIRST
        if character not in allowed or character == '=' and text or character == '.' and text.endswith('.'):
            return
        if character == '-' and not is_expression(text):
            self.set_text(text[1:] if text.startswith('-') else '-' + text)
        else:
            self.set_text(text + character)

    def erase(self) -> None:
        self.set_text(self.typed[self.held][:-1])

    def set_text(self, text: str) -> None:
        self.typed[self.held] = text
        self.numbers[self.held] = self.parse(self.handles[self.held], text.removeprefix('='))

    def is_touched(self, index: int) -> bool:
        """Returns whether the handle was moved or a number was typed for it."""
        return self.pixels[index] != 0.0 or self.numbers[index] is not None

    def value(self, index: int) -> float:
        handle, number = self.handles[index], self.numbers[index]
        if number is not None:
            return min(max(number, handle.low), handle.high)
        return handle.value_at(self.starts[index], self.pixels[index])

    def values(self) -> tuple[float, ...]:
        return tuple(self.value(index) for index in range(len(self.handles)))


def is_expression(text: str) -> bool:
    """Returns whether a typed text is more than a number."""
    return text.startswith('=') or any(character in OPERATORS for character in text)
