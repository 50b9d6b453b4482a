"""Where a tool acts: fully around a centre, less and less away from it."""
from dataclasses import dataclass

import numpy as np

from .. import native

STEPS = 256

@dataclass(frozen=True)
class Falloff:
    """`curve`, values in [0, 1], is tabulated at equal steps from the centre to the radius; its end goes on beyond."""
    centre: np.ndarray  # 3, world space
    radius: float
    curve: np.ndarray


def preset(shape: str) -> np.ndarray:
    """The curve of one of tool_settings.SHAPES, tabulated; `t` goes from 1 at the centre to 0 at the radius."""
    t = np.linspace(1.0, 0.0, STEPS + 1)
    shapes = {'SMOOTH': t * t * (3.0 - 2.0 * t), 'LINEAR': t, 'SPHERE': np.sqrt(t * (2.0 - t)), 'SHARP': t * t}
    return shapes[shape]


def influence(optimizer: object, falloff: Falloff | None, strength: float = 1.0) -> np.ndarray:
    """#F in [0, 1]: how much of a tool's wish counts in each triangle; the same everywhere without a fall-off."""
    if falloff is None:
        return np.full(len(optimizer.centers), strength)
    return strength * native.reflines.falloff(optimizer, centre=in_plane(optimizer, falloff.centre),
                                              radius=falloff.radius, curve=np.clip(falloff.curve, 0.0, 1.0))


def emphasis(share: np.ndarray, factor: float) -> np.ndarray:
    """#F weights: `factor` (>= 1) where the influence is full, 1 where there is none (paper: c >= 1)."""
    return 1.0 + (factor - 1.0) * share


def in_plane(optimizer: object, vector: np.ndarray) -> np.ndarray:
    """Image-plane coordinates (2) of a point or direction of world space."""
    return optimizer.frame[:2] @ vector
