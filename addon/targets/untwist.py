"""The target of the present lines, turned."""
from dataclasses import dataclass

from .. import native
from ..native_call import call
from .falloff import Falloff, compute_influence, compute_weight


@dataclass(frozen=True)
class Untwist:
    """The angle of the turn, and its fall-off."""
    angle: float  # radians, counter-clockwise as the viewer sees it, where the influence is full
    falloff: Falloff | None = None


async def build_untwist_target(optimizer: "native.ShapeOptimizer", settings: Untwist) -> "native.Target":
    """Builds the target of the present lines turned by the angle times the influence."""
    influence = await compute_influence(optimizer, settings.falloff)
    return await call(native.reflines.turn, optimizer, angle=settings.angle, influence=influence,
                      weight=compute_weight(influence))
