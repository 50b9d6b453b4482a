"""The mean course of the lines of several panels, which tools that make lines straight give to all of them."""
from collections.abc import Awaitable, Callable, Sequence

import numpy as np

from .. import native
from ..model.patch import Patch
from ..model.view import View
from ..native_call import call
from . import live_optimizer


def give_gradient(panels: Sequence[tuple[Patch, View]], border: str) -> Callable[[], Awaitable[np.ndarray]]:
    """Returns what gives the mean gradient of theta over panels, computed when it is first asked for: the mean, by
    area, of the medians over each panel, radians a length, 3, world space.
    """
    found: list[np.ndarray] = []

    async def find_gradient() -> np.ndarray:
        if not found:
            medians, areas = [], [patch.measure_area() for patch, _ in panels]
            for patch, seen in panels:
                with live_optimizer.convert_native_errors(patch):
                    optimizer = (await live_optimizer.build_optimizer(patch, seen, border)).optimizer
                    medians.append(optimizer.frame[:2].T @ await call(native.reflines.median_gradient, optimizer))
            found.append(np.average(medians, axis=0, weights=areas))
        return found[0]

    return find_gradient
