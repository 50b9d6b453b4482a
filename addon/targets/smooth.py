"""The target of smooth lines: the present ones, low-pass filtered."""
from dataclasses import dataclass

import numpy as np

from .. import native
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
