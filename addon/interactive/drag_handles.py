"""Drag handles, by which mouse, wheel and typed digits set a tool's values. No Blender.

A value depends on the mouse's position, not on its path, so a closed path ends where it began.
"""
from collections.abc import Sequence
from dataclasses import dataclass

PRECISE_FACTOR = 0.1  # factor of the mouse's move while Shift is held
NOTCH_PIXELS = 20.0  # move of the mouse that a notch of the wheel equals


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

    def __init__(self, handles: Sequence[Handle], starts: Sequence[float], units: Sequence[float]) -> None:
        """Starts with the properties' values; `units` are the factors by which typed numbers are multiplied."""
        self.handles, self.starts, self.units = tuple(handles), tuple(starts), tuple(units)
        self.held = 0
        self.pixels = [0.0] * len(self.handles)
        self.typed = [""] * len(self.handles)
        self.last: int | None = None

    def move(self, x: int, *, precise: bool) -> None:
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
        """Appends a digit or point to the typed text; '-' toggles its sign."""
        text = self.typed[self.held]
        if character == '-':
            self.typed[self.held] = text[1:] if text.startswith('-') else '-' + text
        elif character != '.' or '.' not in text:
            self.typed[self.held] = text + character

    def erase(self) -> None:
        self.typed[self.held] = self.typed[self.held][:-1]

    def is_touched(self, index: int) -> bool:
        """Returns whether the handle was moved or a number was typed for it."""
        return self.pixels[index] != 0.0 or self.parse_number(index) is not None

    def parse_number(self, index: int) -> float | None:
        """Returns the typed number in the property's unit, None where the text is no number yet."""
        digits = self.typed[index].lstrip('-').replace('.', "", 1)
        return float(self.typed[index]) * self.units[index] if digits.isdigit() else None

    def value(self, index: int) -> float:
        handle, number = self.handles[index], self.parse_number(index)
        if number is not None:
            return min(max(number, handle.low), handle.high)
        return handle.value_at(self.starts[index], self.pixels[index])

    def values(self) -> tuple[float, ...]:
        return tuple(self.value(index) for index in range(len(self.handles)))
