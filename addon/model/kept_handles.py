"""Handles as an object keeps them: a text with what of each is fixed, and beside it the values that can be keyed.

The text holds a handle's number, start, pinned points, and the bends of its curve, which are relative to its place. The
place, the radius and whether it is muted stand only in properties, in the same order. Files of before hold all of it in
the text, as line_handle.encode_handles writes it.
"""
import json
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from . import line_handle
from .line_handle import Handles, LineHandle

Values = tuple[Sequence[float], float, bool]  # place, radius, muted


def encode_fixed(handles: Handles) -> str:
    """Encodes as JSON what of each handle is fixed."""
    return json.dumps([{"number": each.number, "start": each.start, "pinned": each.pinned,
                        "bends": np.subtract(each.curve, each.end).tolist() if each.curve else []}
                       for each in handles]) if handles else ""


def place_handles(text: str, values: Sequence[Values]) -> Handles:
    """Returns the handles of a text at their values; refuses what a file may hold of another origin."""
    return line_handle.decode_each(text, place_handle, values)


def place_handle(fixed: dict, values: Values) -> LineHandle:
    """Returns a handle at its values. A pin has no place of its own, and a curve is moved with it as a whole."""
    place, radius, muted = values
    start, end = line_handle.decode_point(fixed["start"]), line_handle.decode_point(list(place))
    pinned, curve = line_handle.decode_points(fixed["pinned"]), bend_curve(fixed["bends"], end)
    return LineHandle(start, start if pinned else end, line_handle.decode_number(radius), pinned, bool(muted), curve,
                      line_handle.decode_own_number(fixed["number"]))


def bend_curve(bends: list, place: Sequence[float]) -> tuple[tuple[float, float, float], ...]:
    """Returns the points of a curve at its place. Bends are not rounded, so that points keep their bits there."""
    if not isinstance(bends, list) or len(bends) > line_handle.MOST_POINTS or len(bends) == 1:
        raise ValueError("no curve")
    exact = [[line_handle.decode_double(number) for number in bend] for bend in bends]
    if any(len(bend) != 3 for bend in exact):
        raise ValueError("no points")
    return tuple(map(tuple, np.add(exact, place).tolist())) if exact else ()


def read_numbers(text: str, count: int) -> tuple[int, ...]:
    """Returns the numbers of the kept handles; none that a handle has where the text cannot be read."""
    try:
        numbers = tuple(line_handle.decode_own_number(each["number"]) for each in json.loads(text))
    except (ValueError, TypeError, KeyError, RecursionError):
        numbers = ()
    return numbers if len(numbers) == count else (-1,) * count


def number_handles(handles: Handles, kept: Iterable[int]) -> Handles:
    """Returns the handles with a number of its own for each that has none, beside the kept ones."""
    used, numbers = set(), []
    highest = max((0, *kept, *(each.number for each in handles)))
    for each in handles:
        fresh = each.number == 0 or each.number in used
        highest += fresh
        numbers.append(highest if fresh else each.number)
        used.add(numbers[-1])
    return tuple(replace(each, number=number) for each, number in zip(handles, numbers, strict=True))


def find_moves(before: Sequence[int], after: Sequence[int]) -> dict[int, int | None]:
    """Finds where the handles went, by their places in the order before and after; None: they are gone."""
    places = {number: index for index, number in enumerate(after)}
    return {index: places.get(number) for index, number in enumerate(before)}
