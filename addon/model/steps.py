"""Work in short steps, between which Blender goes on: a generator that yields after each, and returns the result."""
from collections.abc import Generator
from typing import TypeVar

from .. import native

WAIT = 0.02  # seconds that a step waits for native work

Result = TypeVar("Result")
Steps = Generator[None, None, Result]


def finish(steps: Steps[Result]) -> Result:
    """Does all steps at once."""
    try:
        while True:
            next(steps)
    except StopIteration as end:
        return end.value


def wait_for(task: "native.Task[Result]") -> Steps[Result]:
    """Waits for a native call in the background; returns its result, or raises its error."""
    while not task.wait(WAIT):
        yield
    return task.result()
