"""The operators that run in the window and have something to take back. Disabling the add-on ends them while they are
there: Blender drops the operators of a class that is unregistered without calling them.
"""
from contextlib import suppress

import bpy


class RunningOperator:
    """The base of operators that run."""
    timer: bpy.types.Timer | None

    def take_back(self, context: bpy.types.Context) -> None:
        """Takes back what the operator does, and ends it."""
        raise NotImplementedError

    def cancel(self, context: bpy.types.Context) -> None:
        """Does so when Blender exits or opens another file."""
        self.take_back(context)


_running: list[RunningOperator] = []


def begin(operator: RunningOperator, context: bpy.types.Context, interval: float = 0.0) -> set[str]:
    """Lets an operator run with the window's events and, with an interval in seconds, those of a timer."""
    manager = context.window_manager
    operator.timer = manager.event_timer_add(interval, window=context.window) if interval else None
    manager.modal_handler_add(operator)
    _running.append(operator)
    return {'RUNNING_MODAL'}


def end(operator: RunningOperator, context: bpy.types.Context) -> None:
    """Ends what `begin` began, and takes the operator's text from the status bar."""
    note_end(operator)
    if operator.timer is not None:
        context.window_manager.event_timer_remove(operator.timer)
    context.workspace.status_text_set(None)


def note_end(operator: RunningOperator) -> None:
    _running[:] = [other for other in _running if other is not operator]


def take_back(kind: type) -> None:
    """Takes back what operators of a class do, before that is unregistered."""
    for operator in [each for each in _running if type(each) is kind]:  # the only question to a dropped one
        note_end(operator)
        with suppress(ReferenceError):  # Blender has dropped it after an error
            operator.take_back(bpy.context)
