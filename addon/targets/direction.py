"""The target of lines of another direction and density."""
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

import numpy as np

from .. import native
from ..native_call import call
from .falloff import Falloff, compute_influence, compute_weight, project_to_plane


@dataclass(frozen=True)
class Direction:
    """The wanted direction and density. Straight lines run in a direction of world space, or where that is zero in the
    mean direction of the region's; without a direction lines keep their course, turned by the angle.
    """
    direction: np.ndarray | None = None  # 3
    angle: float = 0.0         # radians, counter-clockwise as the viewer sees it; of lines that keep their course
    density: float = 1.0       # a factor: of the mean, or of each place's own where lines keep their course
    density_end: float = 1.0   # at the far end of the axis
    axis: str = 'NONE'         # along which the density varies: 'ALONG' or 'ACROSS' the lines
    strength: float = 1.0
    falloff: Falloff | None = None
    find_mean: Callable[[], Awaitable[np.ndarray]] | None = None  # of straight lines over several panels: the mean
                                                                  # gradient of theta, 3; None: that of the region


async def build_direction_target(optimizer: "native.ShapeOptimizer", settings: Direction) -> "native.Target":
    """Builds a target of that direction and linearly varying density, blended with the present lines by the influence.
    """
    influence = await compute_influence(optimizer, settings.falloff, settings.strength)
    straight = settings.direction is not None
    direction = project_to_plane(optimizer, settings.direction) if straight else np.zeros(2)
    axis = compute_density_axis(optimizer, direction, settings.axis)
    wanted = {"density": settings.density, "density_end": settings.density_end if axis.any() else -1.0, "axis": axis,
              "influence": influence, "weight": compute_weight(influence)}
    if straight and settings.find_mean is not None:
        mean = project_to_plane(optimizer, await settings.find_mean())
        scale = {name: wanted[name] * float(np.linalg.norm(mean)) for name in ("density", "density_end")}
        along = direction if direction.any() else np.array([mean[1], -mean[0]])
        return await call(native.reflines.uniform, optimizer, direction=along, relative=False, **(wanted | scale))
    if straight:
        return await call(native.reflines.uniform, optimizer, direction=direction, relative=True, **wanted)
    return await call(native.reflines.turn, optimizer, angle=settings.angle, **wanted)


def compute_density_axis(optimizer: "native.ShapeOptimizer", direction: np.ndarray, kind: str) -> np.ndarray:
    """Returns the image-plane axis along which the density varies, zero where it does not.

    Across the lines means the direction in which theta grows.
    """
    if kind == 'NONE':
        return np.zeros(2)
    mean = optimizer.field()[optimizer.active].mean(axis=0)
    along = direction if direction.any() else np.array([mean[1], -mean[0]])
    if kind == 'ALONG':
        return along
    across = np.array([-along[1], along[0]])
    return across if across @ mean > 0.0 else -across
