"""Handles on lines, as the artist places them on one object, and as text that is kept with it."""
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .refusal import Refusal

LARGEST = 1e15  # coordinate or radius: products of them stay finite
MOST_HANDLES = 100
MOST_POINTS = 64  # of a pinned line
MOST_NUMBER = 2**31
UNREADABLE = "The stored handles cannot be used: delete them in the sidebar, and pull the lines again"


@dataclass(frozen=True)
class LineHandle:
    """A pull: the line through `start` is to pass through `end`. With `pinned` points it is a pin of the line along
    them instead, and `start` is where that was taken. With `curve` points the line is to run along the curve through
    them, and `end` is the middle one.
    """
    start: tuple[float, float, float]  # object space; heights along the view do not matter
    end: tuple[float, float, float]    # likewise
    radius: float                      # world units
    pinned: tuple[tuple[float, float, float], ...] = ()
    muted: bool = False
    curve: tuple[tuple[float, float, float], ...] = ()  # none, or two and more
    number: int = 0  # its own among those of its object, as long as it is kept; 0: none yet

    @property
    def dots(self) -> tuple[tuple[float, float, float], ...]:
        """The points that the mouse can take."""
        return self.curve or (self.end,)

    def move_dot(self, number: int, to: tuple[float, float, float]) -> "LineHandle":
        """Returns the handle with one of its dots elsewhere."""
        return self.lay((*self.curve[:number], to, *self.curve[number + 1:])) if self.curve else replace(self, end=to)

    def lay(self, curve: tuple[tuple[float, float, float], ...]) -> "LineHandle":
        """Returns the handle with its line along a curve."""
        return replace(self, curve=curve, end=curve[len(curve) // 2])

    @property
    def is_pin(self) -> bool:
        return bool(self.pinned)


Handles = tuple[LineHandle, ...]


def encode_handles(handles: Handles) -> str:
    """Encodes handles as JSON, all of each; the numbers keep their bits."""
    return json.dumps([{"start": each.start, "end": each.end, "radius": each.radius, "pinned": each.pinned,
                        "muted": each.muted, "curve": each.curve, "number": each.number} for each in handles]
                      ) if handles else ""


def decode_handles(text: str) -> Handles:
    """Decodes handles; refuses a text of another origin, which a file may hold."""
    return decode_each(text, decode_handle) if text else ()


def decode_each(text: str, decode: Callable[..., LineHandle], *values: Sequence[tuple]) -> Handles:
    """Decodes each handle of a list as JSON, with the values at its place in the order; refuses likewise."""
    try:
        stored = json.loads(text)
        if not isinstance(stored, list) or len(stored) > MOST_HANDLES:
            raise ValueError("no list of handles")
        return tuple(decode(*each) for each in zip(stored, *values, strict=True))
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError, OverflowError) as error:
        raise Refusal(UNREADABLE) from error


def decode_handle(stored: dict) -> LineHandle:
    curve = stored.get("curve", [])  # files of before have none
    if isinstance(curve, list) and len(curve) == 1:
        raise ValueError("no curve")
    return LineHandle(decode_point(stored["start"]), decode_point(stored["end"]), decode_number(stored["radius"]),
                      decode_points(stored["pinned"]), stored["muted"] is True,
                      decode_points(curve), decode_own_number(stored.get("number", 0)))


def decode_points(stored: list) -> tuple[tuple[float, float, float], ...]:
    if not isinstance(stored, list) or len(stored) > MOST_POINTS:
        raise ValueError("no points")
    return tuple(decode_point(point) for point in stored)


def decode_own_number(stored: int) -> int:
    """Returns the number of a handle among those of its object."""
    if isinstance(stored, bool) or not isinstance(stored, int) or not 0 <= stored <= MOST_NUMBER:
        raise ValueError("no number of a handle")
    return stored


def decode_point(stored: list) -> tuple[float, float, float]:
    x, y, z = stored
    return decode_number(x), decode_number(y), decode_number(z)


def decode_number(stored: float) -> float:
    """Returns a finite number in single precision, as animated values and meshes have it: a handle that is kept with an
    object is solved to the same bits as the text that it came from.
    """
    return float(np.float32(decode_double(stored)))


def decode_double(stored: float) -> float:
    """Returns a finite number."""
    if isinstance(stored, bool) or not isinstance(stored, int | float) or not abs(stored) < LARGEST:
        raise ValueError("no number")
    return float(stored)


def mirror_handles(handles: Handles, sign: np.ndarray) -> Handles:
    """Returns the handles followed by their mirror images, for a region that moves symmetrically. A pull whose image
    lies within a twentieth of its radius has none: both would pull one line.
    """
    images = (LineHandle(mirror_point(each.start, sign), mirror_point(each.end, sign), each.radius,
                         tuple(mirror_point(point, sign) for point in each.pinned), each.muted,
                         tuple(mirror_point(point, sign) for point in each.curve)) for each in handles)
    return handles + tuple(image for own, image in zip(handles, images, strict=True)
                           if own.is_pin or np.linalg.norm(np.subtract(own.end, image.end)) > 0.05 * own.radius)


def mirror_point(point: tuple[float, float, float], sign: np.ndarray) -> tuple[float, float, float]:
    return tuple((np.array(point) * sign).tolist())
