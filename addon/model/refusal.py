"""The exception of requests that cannot be met: nothing has been changed, and operators report its sentence."""
from collections.abc import Callable
from functools import wraps
from typing import Any


class Refusal(Exception):
    """One sentence for the user: what, how many, what to do."""


def report_refusals(execute: Callable[..., set[str]]) -> Callable[..., set[str]]:
    """Makes the method of an operator report a refusal, or why a file cannot be written, and end as cancelled."""
    @wraps(execute)
    def reporting(self: Any, context: Any, *more: Any) -> set[str]:
        try:
            return execute(self, context, *more)
        except (Refusal, OSError) as error:
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}

    return reporting
