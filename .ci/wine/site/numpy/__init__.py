"""A stand-in for numpy in a Python of Windows: arrays of numbers, and of numpy's C interface what pybind11 calls.

Arrays are made here and converted by the module under test; nothing computes with them.
"""
import sys
from collections.abc import Iterator

from ._core.multiarray import array, ndarray, set_conversion

__all__ = ["array", "ndarray"]
__version__ = "1.26.4" if sys.version_info < (3, 12) else "2.2.4"  # whose layouts multiarray.c has
LETTERS = {bool: "?", int: "q", float: "d"}


def shape_of(value: object) -> tuple[int, ...]:
    """The shape of a sequence of sequences, by their first elements."""
    if isinstance(value, ndarray):
        return memoryview(value).shape
    if isinstance(value, list | tuple):
        return (len(value), *(shape_of(value[0]) if value else ()))
    return ()


def numbers_of(value: object, shape: tuple[int, ...]) -> Iterator[bool | int | float]:
    """The numbers in a sequence of sequences of a shape, in C order."""
    if shape_of(value)[:1] != shape[:1]:
        raise ValueError("the sequences differ in length")
    if not shape:
        yield value
    elif isinstance(value, ndarray):
        view = memoryview(value)
        yield from memoryview(view.tobytes()).cast(view.format)
    else:
        for part in value:
            yield from numbers_of(part, shape[1:])


def array_of(value: object) -> ndarray:
    """Makes an array of a number or of a sequence of them, of the narrowest type of Python's that holds all."""
    shape = shape_of(value)
    numbers = list(numbers_of(value, shape))
    kinds = {type(number) for number in numbers} or {float}
    if not kinds <= set(LETTERS):
        raise TypeError("not an array of numbers")
    kind = max(kinds, key=list(LETTERS).index)
    buffer = memoryview(bytearray(8 * len(numbers) if kind is not bool else len(numbers))).cast(LETTERS[kind])
    for k, number in enumerate(numbers):
        buffer[k] = number
    return array(buffer.tobytes(), LETTERS[kind], shape)


set_conversion(array_of)
