"""The fall-off of a tool's influence around a centre."""
from dataclasses import dataclass

import numpy as np

from .. import native
from ..native_call import call

STEPS = 256
EMPHASIS = 10.0  # how many times more lines count where a tool acts fully than where it does not


@dataclass(frozen=True)
class Falloff:
    """The influence as a function of the distance from the centre.

    `curve` holds values in [0, 1] at equal steps from the centre to the radius; its last value holds beyond.
    """
    centre: np.ndarray  # 3, world space
    radius: float
    curve: np.ndarray


def tabulate_preset(shape: str) -> np.ndarray:
    """Tabulates the curve of one of tool_properties.SHAPES; `t` goes from 1 at the centre to 0 at the radius."""
    t = np.linspace(1.0, 0.0, STEPS + 1)
    shapes = {'SMOOTH': t * t * (3.0 - 2.0 * t), 'LINEAR': t, 'SPHERE': np.sqrt(t * (2.0 - t)), 'SHARP': t * t}
    return shapes[shape]


async def compute_influence(optimizer: "native.ShapeOptimizer", falloff: Falloff | None,
                            strength: float = 1.0) -> np.ndarray:
    """Returns the influence of a tool on each triangle: #F in [0, strength]; constant without a fall-off."""
    if falloff is None:
        return np.full(len(optimizer.centers), strength)
    return strength * await call(
        native.reflines.falloff, optimizer, centre=project_to_plane(optimizer, falloff.centre), radius=falloff.radius,
        curve=np.clip(falloff.curve, 0.0, 1.0))


def compute_weight(influence: np.ndarray) -> np.ndarray:
    """Returns the weight of each triangle: #F, EMPHASIS where the influence is 1, and 1 where it is 0 (the paper's c).
    """
    return 1.0 + (EMPHASIS - 1.0) * influence


def project_to_plane(optimizer: "native.ShapeOptimizer", vector: np.ndarray) -> np.ndarray:
    """Returns the image-plane coordinates (2) of a point or direction in world space."""
    return optimizer.frame[:2] @ vector
