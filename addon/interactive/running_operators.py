"""The operators that run in the window and have something to take back. Disabling the add-on ends them while they are
there: Blender drops the operators of a class that is unregistered without calling them.
"""
from contextlib import suppress
from typing import Protocol

import bpy


class RunningOperator(Protocol):
    """The interface of an operator that runs."""

    def take_back(self, context: bpy.types.Context) -> None: ...


_running: list[RunningOperator] = []


def note_begin(operator: RunningOperator) -> None:
    _running.append(operator)


def note_end(operator: RunningOperator) -> None:
    _running[:] = [other for other in _running if other is not operator]


def take_back(kind: type[RunningOperator]) -> None:
    """Takes back what operators of a class do, before that is unregistered."""
    for operator in [each for each in _running if type(each) is kind]:  # the only question to a dropped one
        note_end(operator)
        with suppress(ReferenceError):  # Blender has dropped it after an error
            operator.take_back(bpy.context)
