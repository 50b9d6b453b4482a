"""What goes through the pipe between the tests and the Python of Windows: pickled messages, each after its length.

Numbers, texts and containers go as they are; arrays as Array, objects of the module as Object, functions of the module
and methods of its objects as Function.
"""
import pickle
import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import BinaryIO

LENGTH = struct.Struct("<q")


@dataclass(frozen=True)
class Array:
    """The bytes of an array, in C order or in Fortran's, with its type in numpy's letters: "<f8"."""
    data: bytes
    kind: str
    shape: tuple[int, ...]
    fortran: bool = False
    writeable: bool = True


@dataclass(frozen=True)
class Object:
    """An object that the other side keeps under a number."""
    number: int
    kind: str


@dataclass(frozen=True)
class Function:
    """An attribute of the module, or of an object of it."""
    owner: Object | None
    name: str


@dataclass(frozen=True)
class Error:
    """An exception: its class's name, and what was said."""
    kind: str
    text: str


def replace(value: object, one: Callable[[object], object]) -> object:
    """A copy of a value in which `one` has replaced whatever is no container."""
    if type(value) in (list, tuple, set):
        return type(value)(replace(part, one) for part in value)
    if type(value) is dict:
        return {key: replace(part, one) for key, part in value.items()}
    return one(value)


def send(pipe: BinaryIO, message: object) -> None:
    data = pickle.dumps(message)
    pipe.write(LENGTH.pack(len(data)) + data)
    pipe.flush()


def receive(pipe: BinaryIO) -> object:
    """The next message; None at the pipe's end."""
    head = pipe.read(LENGTH.size)
    return pickle.loads(pipe.read(LENGTH.unpack(head)[0])) if len(head) == LENGTH.size else None
