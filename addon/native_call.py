"""Awaited calls of native functions, so that the same code runs at once and in the background of a window.

Code that makes long native calls is written as coroutines, which await them with `call`. `run_now` does each call as it
comes. background_work.py does them on a thread that runs no Python, while all Python stays on Blender's.
"""
from collections.abc import Callable, Coroutine, Generator
from functools import partial
from types import coroutine
from typing import Any, ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
Calling = Coroutine[partial, Callable[[], Any] | None, Result]  # a coroutine that awaits native calls


@coroutine
def call(function: Callable[Arguments, Result], *arguments: Arguments.args,
         **named: Arguments.kwargs) -> Generator[partial, Callable[[], Result], Result]:
    """Returns the result of a native function, or raises its error, when awaited. The call goes to what runs the
    coroutine, which sends a function that returns the result or raises the error.
    """
    get_result = yield partial(function, *arguments, **named)
    return get_result()


def run_now(work: Calling[Result]) -> Result:
    """Runs a coroutine to its end, each call as it comes."""
    try:
        wanted = work.send(None)
        while True:
            wanted = work.send(wanted)
    except StopIteration as end:
        return end.value
