"""What is wrong with the car's bonnet and doors: dents, and ripples of the bonnet. numpy only."""
import numpy as np

import hood_shape
from hood_shape import window

# Place, radius, depth, metres: x, y on the bonnet, y, z on the door.
BONNET_DENTS = np.array([(0.15, -1.40, 0.105, 0.0018), (0.25, -1.63, 0.080, 0.0012), (0.22, -1.12, 0.110, 0.0018)])
DOOR_DENTS = np.array([(0.25, 0.56, 0.115, 0.0020), (-0.30, 0.50, 0.100, 0.0014)])


def dents(a: np.ndarray, b: np.ndarray, table: np.ndarray) -> np.ndarray:
    result = np.zeros_like(a)
    for at, beside, radius, depth in table:
        result += depth * np.clip(1.0 - ((a - at)**2 + (b - beside)**2) / radius**2, 0.0, None)**3
    return result


def ripples(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Half of those of the single bonnet, in the middle of this one."""
    inside = window(0.36 - x, 0.1) * window(y + 1.80, 0.15) * window(-0.95 - y, 0.1)
    return 0.5 * inside * hood_shape.ripples(x, y)


def flaws(name: str, points: np.ndarray) -> np.ndarray:
    """How far the points of a panel lie too far out."""
    x, y, z = np.moveaxis(points, -1, 0)
    if name == "Bonnet":
        return ripples(x, y) - dents(x, y, BONNET_DENTS)
    return -dents(y, z, DOOR_DENTS) if name == "Door" else np.zeros_like(x)
