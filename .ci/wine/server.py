"""Runs in the Python of Windows: loads the module, and calls it as the tests ask through the pipe (messages.py).

Each thread of the tests has a thread of its own here. Objects live until the tests let go of them.
"""
import collections
import operator
import os
import queue
import sys
import threading
from typing import BinaryIO

import numpy
import reflines
from messages import Array, Error, Function, Object, receive, replace, send

LETTERS = {"|b1": "?", "|i1": "b", "|u1": "B", "<i2": "h", "<u2": "H", "<i4": "l", "<u4": "L", "<i8": "q", "<u8": "Q",
           "<f4": "f", "<f8": "d"}
KINDS = {letter: kind for kind, letter in LETTERS.items()} | {"i": "<i4", "I": "<u4"}
PLAIN = (type(None), bool, int, float, complex, str, bytes)


class Server:
    def __init__(self, answers: BinaryIO) -> None:
        self.answers = answers
        self.lock = threading.Lock()
        self.objects: dict[int, object] = {}  # by their ids
        self.uses: collections.Counter[int] = collections.Counter()  # how often each was told, less what was released
        self.queues: dict[int, queue.SimpleQueue] = {}

    def given(self, value: object) -> object:
        """What a part of a message means here."""
        if isinstance(value, Array):
            return numpy.array(value.data, LETTERS[value.kind], value.shape, value.fortran, value.writeable)
        if isinstance(value, Object):
            return self.objects[value.number]
        if isinstance(value, Function):
            return operator.attrgetter(value.name)(self.given(value.owner) if value.owner else reflines)
        return value

    def told(self, value: object) -> object:
        """How a part of a result is called in a message."""
        if isinstance(value, PLAIN):
            return value
        if isinstance(value, numpy.ndarray):
            view = memoryview(value)
            order = "C" if view.c_contiguous else "F"
            return Array(view.tobytes(order), KINDS[view.format], view.shape, order == "F", value.writeable)
        with self.lock:
            self.objects[id(value)] = value
            self.uses[id(value)] += 1
        return Object(id(value), type(value).__name__)

    def release(self, number: int) -> None:
        with self.lock:
            self.uses[number] -= 1
            value = self.objects.pop(number) if self.uses[number] == 0 else None
        del value  # without the lock: a task waits for its end

    def act(self, verb: str, *parts: object) -> object:
        """Carries out one request."""
        if verb == "call":
            function, arguments, named = (replace(part, self.given) for part in parts)
            return function(*arguments, **named)
        if verb == "get":
            return self.given(parts[0])
        if verb == "set":
            return setattr(self.given(parts[0]), parts[1], replace(parts[2], self.given))
        return self.release(parts[0].number)

    def answer(self, number: int, request: tuple) -> None:
        try:
            result = replace(self.act(*request), self.told)
        except BaseException as error:  # noqa: BLE001  (whatever it is, the tests are to see it)
            result = Error(type(error).__name__, str(error))
        with self.lock:
            send(self.answers, (number, result))

    def work(self, requests: queue.SimpleQueue) -> None:
        while True:
            self.answer(*requests.get())

    def take(self, thread: int, number: int, request: tuple) -> None:
        if thread not in self.queues:
            self.queues[thread] = queue.SimpleQueue()
            threading.Thread(target=self.work, args=(self.queues[thread],), daemon=True).start()
        self.queues[thread].put((number, request))


def describe() -> dict[str, object]:
    """The module's classes, with their attributes and whether each is a property; its functions; its version."""
    kinds = {name: kind for name, kind in vars(reflines).items() if isinstance(kind, type)}
    classes = {name: {key: isinstance(getattr(one, key), property) for key in dir(one) if not key.startswith("__")}
               for name, one in kinds.items() if not issubclass(one, BaseException)}
    bases = {name: one.__base__.__name__ for name, one in kinds.items() if issubclass(one, BaseException)}
    functions = [name for name, one in vars(reflines).items() if callable(one) and name not in kinds]
    return {"classes": classes, "bases": bases, "functions": functions, "version": reflines.__version__,
            "loaded": f"{reflines.__file__} by Python {sys.version} for {sys.platform}"}


def main() -> None:
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    server = Server(answers)
    send(answers, describe())
    while (message := receive(sys.stdin.buffer)) is not None:
        server.take(*message)
    os._exit(0)  # threads of the tests' may still wait


if __name__ == "__main__":
    main()
