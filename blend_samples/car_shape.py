"""The body of the car as one implicit surface, made from curves: metres, x to its left, y to its rear, z up.

`body` is negative inside, positive outside, 0 on the clean surface, and as smooth as its curves. numpy only.
"""
import numpy as np

from hood_shape import ramp

FRONT_AXLE, REAR_AXLE = -1.33, 1.30   # y
WHEEL = 0.335                         # radius
ARCH = 0.375                          # radius of the opening in wing and quarter
ARCH_HEIGHT = 0.345                   # z of its centre


class Curve:
    """A chain of straight lines with soft corners: (place, value, softness) of each point, endlessly smooth."""

    def __init__(self, *points: tuple[float, float, float]) -> None:
        places, values, self.softness = np.array(points).T
        self.start = places[0], values[0]
        slopes = np.diff(values) / np.diff(places)
        self.slope, self.turns, self.corners = slopes[0], np.diff(slopes), places[1:-1]

    def __call__(self, place: np.ndarray) -> np.ndarray:
        result = self.start[1] + self.slope * (place - self.start[0])
        for corner, turn, softness in zip(self.corners, self.turns, self.softness[1:-1], strict=True):
            result = result + turn * ramp(place - corner, softness)
        return result


# Seen from the side, in the plane of symmetry.
TOP = Curve((-2.30, 0.56, 0), (-2.06, 0.705, 0.06), (-1.50, 0.865, 0.16), (-0.75, 0.985, 0.2), (0.6, 1.015, 0.2),
            (1.70, 0.990, 0.10), (2.40, 0.925, 0))
ROOF = Curve((-1.10, 0.79, 0), (-0.80, 0.955, 0.07), (-0.02, 1.365, 0.085), (0.42, 1.432, 0.14), (1.02, 1.345, 0.16),
             (1.80, 0.985, 0.10), (2.2, 0.80, 0))
# How far both ends stand back, by the height.
NOSE = Curve((0.05, 0.20, 0), (0.24, 0.06, 0.025), (0.40, 0.00, 0.04), (0.60, 0.015, 0.05), (0.90, 0.18, 0))
TAIL = Curve((0.05, 0.16, 0), (0.30, 0.035, 0.03), (0.52, 0.0, 0.04), (0.72, 0.045, 0.03), (0.90, 0.06, 0.03),
             (1.1, 0.02, 0))
# Seen from above: half the width.
WAIST = Curve((-2.40, 0.72, 0), (-1.75, 0.825, 0.12), (-0.75, 0.862, 0.25), (0.75, 0.862, 0.25), (1.70, 0.83, 0.14),
              (2.40, 0.70, 0))
GLASS = Curve((-1.2, 0.62, 0), (-0.3, 0.735, 0.16), (0.5, 0.735, 0.22), (1.9, 0.56, 0))
# Height of the flank's character line.
SHOULDER = Curve((-2.2, 0.655, 0), (-1.2, 0.70, 0.3), (0.6, 0.755, 0.3), (2.2, 0.80, 0))
# How far the flank stands in, by the height above the character line.
FLANK, SOFT_FLANK = (Curve((-0.62, 0.088, 0), (-0.50, 0.028, 0.02), (-0.40, 0.006, 0.03), (-0.20, 0.022, 0.035),
                           (0.0, 0.0, softness), (0.25, 0.075, 0)) for softness in (0.012, 0.045))


def smooth_maximum(a: np.ndarray, b: np.ndarray, width: float) -> np.ndarray:
    return width * np.logaddexp(a / width, b / width)


def smooth_minimum(a: np.ndarray, b: np.ndarray, width: float) -> np.ndarray:
    return -smooth_maximum(-a, -b, width)


def bell(place: np.ndarray, width: float) -> np.ndarray:
    return np.exp(-(place / width)**2)


def top(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Height of bonnet and deck: crowned, with a raised middle between two lines that open towards the windscreen."""
    fade = 1.0 / (1.0 + np.exp((y + 0.15) / 0.10))
    line = 0.46 + 0.10 * (y + 1.4)
    beside = sum(0.085 * ramp(side * x - line, 0.014) - 0.075 * ramp(side * x - line - 0.13, 0.045) for side in (-1, 1))
    return TOP(y + 0.10 * x**2) - 0.075 * x**2 - 0.055 * x**4 - fade * beside


def flank(y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """x of the side, with haunches over the wheels."""
    front, rear = bell(y - FRONT_AXLE, 0.50), bell(y - REAR_AXLE, 0.55)
    haunch = (0.034 * front + 0.046 * rear) * bell(z - 0.60, 0.26)
    soft, above = np.minimum(front + rear, 1.0), z - SHOULDER(y)   # the character line fades over the wheels
    return WAIST(y) + haunch - soft * SOFT_FLANK(above) - (1.0 - soft) * FLANK(above)


def tub(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The body below the windows."""
    nose = -2.215 + 0.30 * (x / 0.8)**2 + 0.10 * (x / 0.8)**4 + NOSE(z) - y
    tail = y - (2.20 - 0.20 * (x / 0.8)**2 - 0.10 * (x / 0.8)**4 - TAIL(z))
    sides = smooth_maximum(smooth_maximum(np.abs(x) - flank(y, z), nose, 0.045), tail, 0.035)
    return smooth_maximum(sides, z - top(x, y), 0.022)


def roof(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Windscreen, roof and rear window; both windows stand back towards the sides."""
    back = y + 0.22 * x**2 * np.tanh((y - 0.4) / 0.6)
    return 0.90 * (z - ROOF(back) + 0.085 * x**2 + 0.05 * x**4)


def side_window(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    above = ramp(z - 0.90, 0.015)
    return 0.92 * (np.abs(x) - GLASS(y) - 0.02 + 0.40 * above + 0.30 * above**2)


def cabin(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    walls = smooth_maximum(roof(x, y, z), side_window(x, y, z), 0.024)
    return np.maximum(walls, np.maximum(y - 1.95, -1.2 - y))   # both ends lie deep inside the tub


def body(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    return smooth_minimum(tub(x, y, z), cabin(x, y, z), 0.012)
