"""The target of smooth lines: the present ones, low-pass filtered."""
from dataclasses import dataclass

from .. import native


@dataclass(frozen=True)
class Smooth:
    """The settings of the low-pass filter."""
    length: float              # detail finer than this goes, world units
    strength: float = 1.0
    directional: bool = False  # only along the lines: they become straight, their spacing stays


def build_smooth_target(optimizer: "native.ShapeOptimizer", settings: Smooth) -> "native.Target":
    """Builds the target of the present lines without detail finer than the length."""
    return native.reflines.smooth(optimizer, length=settings.length, strength=settings.strength,
                                  directional=settings.directional)
