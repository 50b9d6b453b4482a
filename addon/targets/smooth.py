"""The target of smooth lines: the present ones, low-pass filtered."""
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..model.solution import JointTargets
from ..native_call import call


@dataclass(frozen=True)
class Smooth:
    """The settings of the low-pass filter."""
    length: float              # detail finer than this goes, world units
    strength: float = 1.0
    directional: bool = False  # only along the lines: they become straight, their spacing stays
    family: int = 0            # of lines: 0 those of the light, 1 those that cross them
    weight: float = 1.0        # in the energy


async def build_smooth_target(optimizer: "native.ShapeOptimizer", settings: Smooth) -> "native.Target":
    """Builds the target of the present lines without detail finer than the length."""
    weight = np.full(len(optimizer.area), settings.weight) if settings.weight != 1.0 else None
    return await call(native.reflines.smooth, optimizer, length=settings.length, strength=settings.strength,
                      directional=settings.directional, family=settings.family, weight=weight)


async def build_smooth_targets(optimizer: "native.ShapeOptimizer", settings: Smooth,
                               weights: Sequence[float]) -> JointTargets:
    """Builds likewise the targets of all lights of a set, with the weight of each; what is measured is the root mean
    square of what they lack.
    """
    targets = [await build_smooth_target(optimizer, replace(settings, family=family, weight=weight))
               for family, weight in enumerate(weights)]

    async def measure(solved: "native.ShapeOptimizer") -> float:
        lacking = [await call(native.reflines.measure_residual, solved, target) for target in targets]
        return float(np.sqrt(np.mean(np.square(lacking))))

    return JointTargets(targets, measure)
