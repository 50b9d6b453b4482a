"""The mean course of the lines of several panels, which tools that make lines straight give to all of them."""
from collections.abc import Sequence

import numpy as np

from .. import native
from ..model.patch import Patch
from ..model.view import View
from ..native_call import call
from . import live_optimizer


class CommonLines:
    """The mean gradient of theta over panels, computed when it is first asked for."""

    def __init__(self, panels: Sequence[tuple[Patch, View]], border: str) -> None:
        self.panels, self.border = tuple(panels), border
        self.gradient: np.ndarray | None = None  # 3, world space

    async def find_gradient(self) -> np.ndarray:
        """Returns the mean, by area, of the medians over each panel: radians a length, 3, world space."""
        if self.gradient is None:
            medians, areas = [], [patch.measure_area() for patch, _ in self.panels]
            for patch, seen in self.panels:
                with live_optimizer.convert_native_errors(patch):
                    optimizer = (await live_optimizer.build_optimizer(patch, seen, self.border)).optimizer
                    medians.append(optimizer.frame[:2].T @ await call(native.reflines.median_gradient, optimizer))
            self.gradient = np.average(medians, axis=0, weights=areas)
        return self.gradient
