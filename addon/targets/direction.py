"""Lines of one direction and density."""
from dataclasses import dataclass

import numpy as np

from .. import native
from .falloff import Falloff, emphasis, in_plane, influence

TURN = 2.0 * np.pi


@dataclass(frozen=True)
class Direction:
    """`direction` is in world space; zero keeps that of the region's mean."""
    direction: np.ndarray      # 3
    density: float = 1.0       # a factor of the mean's, or lines a unit of length where `count` is given
    density_end: float = 1.0   # at the far end of the axis
    axis: str = 'NONE'         # along which the density varies: 'ALONG' or 'ACROSS' the lines
    count: int = 0             # line lights in a full turn; 0: densities are factors
    strength: float = 1.0
    falloff: Falloff | None = None
    emphasis: float = 1.0


def target(optimizer: object, settings: Direction) -> object:
    share = influence(optimizer, settings.falloff, settings.strength)
    gradient = TURN / settings.count if settings.count else 1.0  # |grad theta| of one line a unit
    direction = in_plane(optimizer, settings.direction)
    axis = density_axis(optimizer, direction, settings.axis)
    return native.reflines.uniform(
        optimizer, direction=direction, density=gradient * settings.density,
        relative=settings.count == 0, density_end=gradient * settings.density_end if axis.any() else -1.0, axis=axis,
        influence=share, weight=emphasis(share, settings.emphasis))


def density_axis(optimizer: object, direction: np.ndarray, kind: str) -> np.ndarray:
    """In the image plane; zero where the density does not vary. Across the lines is where theta grows."""
    if kind == 'NONE':
        return np.zeros(2)
    mean = optimizer.field()[optimizer.active].mean(axis=0)
    along = direction if direction.any() else np.array([mean[1], -mean[0]])
    if kind == 'ALONG':
        return along
    across = np.array([-along[1], along[0]])
    return across if across @ mean > 0.0 else -across
