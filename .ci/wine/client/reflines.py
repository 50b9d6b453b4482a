"""Stands for the module in the tests: hands every call to the module in a Python of Windows, which server.py runs.

The tests keep their own numpy and pytest, so that what is tested under Wine is the module alone. An argument that the
stand-in for numpy there cannot hold skips the test. Classes, functions and errors are those that the module there has.
"""
import atexit
import builtins
import collections
import itertools
import os
import subprocess
import threading
import weakref
from concurrent.futures import Future

import numpy as np
import pytest
from messages import Array, Error, Function, Object, receive, replace, send

KINDS = {"|b1", "|i1", "|u1", "<i2", "<u2", "<i4", "<u4", "<i8", "<u8", "<f4", "<f8"}
PLAIN = (type(None), bool, int, float, complex, str, bytes)


class Pipe:
    """Requests to the server and its answers, from any thread."""

    def __init__(self) -> None:
        command = ["wine", os.environ["REFLINES_WINDOWS_PYTHON"], "-E", "-P", "-m", "server"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.lock = threading.Lock()
        self.numbers = itertools.count()
        self.waiting: dict[int, Future] = {}
        self.released: collections.deque[Object] = collections.deque()
        self.described = receive(self.process.stdout)
        threading.Thread(target=self.read, daemon=True).start()
        atexit.register(self.process.stdin.close)

    def read(self) -> None:
        while (message := receive(self.process.stdout)) is not None:
            self.waiting.pop(message[0]).set_result(message[1])
        for future in list(self.waiting.values()):
            future.set_exception(RuntimeError("the Python of Windows has ended"))

    def post(self, *request: object) -> Future:
        future = Future()
        with self.lock:
            number = next(self.numbers)
            self.waiting[number] = future
            send(self.process.stdin, (threading.get_ident(), number, request))
        return future

    def ask(self, *request: object, raw: bool = False) -> object:
        """Carries out a request there; returns its result, or what the message says of it, or raises its error."""
        while self.released:
            self.post("release", self.released.popleft())
        result = self.post(*request).result()
        if isinstance(result, Error):
            raise globals().get(result.kind, getattr(builtins, result.kind, RuntimeError))(result.text)
        return result if raw else replace(result, received)


class Remote:
    """An object of a class of the module; it lives there."""
    _object: Object

    def __init__(self, *arguments: object, **named: object) -> None:
        named_class = Function(None, type(self).__name__)
        self._object = PIPE.ask("call", named_class, replace(list(arguments), sent), replace(named, sent), raw=True)
        KNOWN[self._object.number] = self

    def __del__(self) -> None:
        if getattr(self, "_object", None):
            PIPE.released.append(self._object)


class RemoteFunction:
    """A function of the module, or a method of an object or of a class."""

    def __init__(self, owner: Remote | None, name: str) -> None:
        self.owner, self.name = owner, name

    def named(self) -> Function:
        return Function(self.owner and self.owner._object, self.name)

    def __call__(self, *arguments: object, **named: object) -> object:
        return PIPE.ask("call", self.named(), replace(list(arguments), sent), replace(named, sent))


class Method:
    """An attribute of a class that gives the method of an object, or of the class itself."""

    def __init__(self, kind: str, name: str) -> None:
        self.kind, self.name = kind, name

    def __get__(self, owner: Remote | None, kind: type) -> RemoteFunction:
        return RemoteFunction(owner, self.name) if owner else RemoteFunction(None, f"{self.kind}.{self.name}")


def sent(value: object) -> object:
    """How a part of an argument is called in a message."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, PLAIN):
        return value
    if isinstance(value, np.ndarray) and value.dtype.str in KINDS:
        fortran = value.flags.f_contiguous and not value.flags.c_contiguous
        return Array(value.tobytes("F" if fortran else "C"), value.dtype.str, value.shape, fortran)
    if isinstance(value, Remote):
        return value._object
    if isinstance(value, RemoteFunction):
        return value.named()
    if isinstance(value, type) and issubclass(value, Remote):
        return Function(None, value.__name__)
    what = f"arrays of {value.dtype}" if isinstance(value, np.ndarray) else type(value).__name__
    pytest.skip(f"the Python under Wine has no numpy, and its stand-in takes no {what}")


def received(value: object) -> object:
    """What a part of a result means here."""
    if isinstance(value, Object):
        if known := KNOWN.get(value.number):
            PIPE.released.append(value)  # each object here releases once
            return known
        result = KNOWN[value.number] = object.__new__(globals()[value.kind])
        result._object = value
        return result
    if isinstance(value, Array):
        order = "F" if value.fortran else "C"
        result = np.frombuffer(bytearray(value.data), value.kind).reshape(value.shape, order=order)
        result.flags.writeable = value.writeable
        return result
    return value


def make_property(name: str) -> property:
    return property(lambda owner: PIPE.ask("get", Function(owner._object, name)),
                    lambda owner, value: PIPE.ask("set", owner._object, name, replace(value, sent)))


def make_class(name: str, attributes: dict[str, bool]) -> type:
    """A class like that of the module; an attribute is a property or a method."""
    own = {key: make_property(key) if is_property else Method(name, key) for key, is_property in attributes.items()}
    return type(name, (Remote,), own)


KNOWN: weakref.WeakValueDictionary[int, Remote] = weakref.WeakValueDictionary()
PIPE = Pipe()
LOADED = PIPE.described["loaded"]
__version__ = PIPE.described["version"]
globals().update({name: make_class(name, own) for name, own in PIPE.described["classes"].items()})
globals().update({name: type(name, (getattr(builtins, base),), {}) for name, base in PIPE.described["bases"].items()})
globals().update({name: RemoteFunction(None, name) for name in PIPE.described["functions"]})
