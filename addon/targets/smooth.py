"""Smooth lines: the present ones without their fine detail."""
from dataclasses import dataclass

from .. import native


@dataclass(frozen=True)
class Smooth:
    length: float              # detail finer than this goes, world units
    strength: float = 1.0
    directional: bool = False  # only along the lines: they become straight, their spacing stays


def target(optimizer: object, settings: Smooth) -> object:
    return native.reflines.smooth(optimizer, length=settings.length, strength=settings.strength,
                                  directional=settings.directional)
