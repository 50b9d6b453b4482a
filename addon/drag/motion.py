"""How the mouse, the wheel and typed digits set a tool's values. Pure: no Blender, so that it can be reasoned about.

A value depends on where the mouse is, not on the way it took, so a closed path ends where it began.
"""
from collections.abc import Sequence
from dataclasses import dataclass

PRECISE = 0.1   # of the way, with Shift held
NOTCH = 20.0    # pixels that a notch of the wheel stands for


@dataclass(frozen=True)
class Handle:
    """A property that can be dragged."""
    name: str             # of the property
    label: str
    per_pixel: float      # what a pixel adds; of `doubles`, how many times it doubles the value
    low: float
    high: float
    doubles: bool = False
    unit: str = 'NONE'    # 'LENGTH', 'ANGLE' or 'PERCENT': how it is shown and typed
    wheel: bool = False   # the wheel turns it

    def at(self, start: float, pixels: float) -> float:
        value = start * 2.0**(self.per_pixel * pixels) if self.doubles else start + self.per_pixel * pixels
        return min(max(value, self.low), self.high)


class Motion:
    """One drag: which handle is held, how far each was moved, and what was typed for it."""

    def __init__(self, handles: Sequence[Handle], starts: Sequence[float], units: Sequence[float]) -> None:
        """`units`: what a typed 1 means for each handle."""
        self.handles, self.starts, self.units = tuple(handles), tuple(starts), tuple(units)
        self.held = 0
        self.pixels = [0.0] * len(self.handles)
        self.typed = [""] * len(self.handles)
        self.last: int | None = None

    def move(self, x: int, *, precise: bool) -> None:
        if self.last is not None:
            self.pixels[self.held] += (x - self.last) * (PRECISE if precise else 1.0)
        self.last = x

    def on_wheel(self) -> Handle | None:
        return next((handle for handle in self.handles if handle.wheel), None)

    def wheel(self, notches: int, *, precise: bool) -> None:
        self.pixels[self.handles.index(self.on_wheel())] += NOTCH * notches * (PRECISE if precise else 1.0)

    def hold_next(self) -> None:
        self.held = (self.held + 1) % len(self.handles)

    def type(self, character: str) -> None:
        """A digit, a point, or the sign, which a second '-' takes away."""
        text = self.typed[self.held]
        if character == '-':
            self.typed[self.held] = text[1:] if text.startswith('-') else '-' + text
        elif character != '.' or '.' not in text:
            self.typed[self.held] = text + character

    def erase(self) -> None:
        self.typed[self.held] = self.typed[self.held][:-1]

    def touched(self, index: int) -> bool:
        return self.pixels[index] != 0.0 or self.number(index) is not None

    def number(self, index: int) -> float | None:
        """What was typed, None while that is no number."""
        digits = self.typed[index].lstrip('-').replace('.', "", 1)
        return float(self.typed[index]) * self.units[index] if digits.isdigit() else None

    def value(self, index: int) -> float:
        handle, number = self.handles[index], self.number(index)
        if number is not None:
            return min(max(number, handle.low), handle.high)
        return handle.at(self.starts[index], self.pixels[index])

    def values(self) -> tuple[float, ...]:
        return tuple(self.value(index) for index in range(len(self.handles)))
