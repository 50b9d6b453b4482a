"""The present lines, turned."""
from dataclasses import dataclass

from .. import native
from .falloff import Falloff, emphasis, influence


@dataclass(frozen=True)
class Untwist:
    angle: float  # radians, counter-clockwise as the viewer sees it, where the influence is full
    falloff: Falloff | None = None
    emphasis: float = 1.0


def target(optimizer: object, settings: Untwist) -> object:
    share = influence(optimizer, settings.falloff)
    return native.reflines.turn(optimizer, angle=settings.angle, influence=share,
                                weight=emphasis(share, settings.emphasis))
