"""Where the shut lines and edges of the car run: runs of points on the left half of the body. numpy only."""
from collections.abc import Callable
from functools import cache

import numpy as np

import car_shape as car
from car_panels import ABOVE, AROUND, BESIDE, run, stack, straight
from hood_shape import ramp, window

SILL, ENDS = 0.245, 0.20             # z of the lower edges of doors and wings, and of nose and tail
NOSE_FOOT, TAIL_FOOT = 152.0, 27.0   # where wings end at the arches: degrees, from the rear over the top
DOOR_TOP, DOOR_END = -0.61, 0.66     # y of the door's upper corners
BELT = car.Curve((-1.2, 0.655, 0), (-0.3, 0.768, 0.16), (0.5, 0.768, 0.22), (1.62, 0.625, 0.10), (2.3, 0.605, 0))
Edge = Callable[[np.ndarray], np.ndarray]


# --- Edges seen from above: y of those that run across, x of those that run along

def bonnet_front(x: np.ndarray) -> np.ndarray:
    return -2.075 + 0.40 * x**2


def bonnet_rear(x: np.ndarray) -> np.ndarray:
    return -0.865 + 0.21 * x**2


def bonnet_side(y: np.ndarray) -> np.ndarray:
    return 0.742 + 0.085 * (y + 0.75) - 0.02 * (y + 0.75)**2


def header(x: np.ndarray) -> np.ndarray:
    return 0.12 * x**2


def roof_end(x: np.ndarray) -> np.ndarray:
    return 1.04 - 0.06 * x**2


def deck_front(x: np.ndarray) -> np.ndarray:
    return 1.745 - 0.22 * x**2


def deck_rear(x: np.ndarray) -> np.ndarray:
    return 2.105 - 0.31 * x**2


def meet(along: Edge, across_it: Edge, guess: float) -> float:
    """y where an edge along the car meets one across it."""
    y = np.array([guess])
    for _ in range(25):
        y = 0.5 * (y + across_it(along(y)))
    return float(y[0])


NOSE_CORNER, COWL_CORNER = meet(bonnet_side, bonnet_front, -1.9), meet(bonnet_side, bonnet_rear, -0.75)
DECK_CORNER, TAIL_CORNER = meet(BELT, deck_front, 1.65), meet(BELT, deck_rear, 2.0)


def along(start: float, end: float, x_of_y: Edge) -> np.ndarray:
    return run(ABOVE, start, end, lambda y: (x_of_y(y), y))


def across(start: float, end: float, y_of_x: Edge) -> np.ndarray:
    return run(ABOVE, start, end, lambda x: (x, y_of_x(x)))


def middle(start: float, end: float) -> np.ndarray:
    """In the plane of symmetry."""
    return along(start, end, lambda y: 0.0 * y)


# --- Edges of the side windows and of their frame: turns about the body's axis (chart AROUND)

def rail(y: np.ndarray) -> np.ndarray:
    """Where roof and side window meet."""
    low, high = np.full_like(y, 0.15), np.full_like(y, 1.5)
    for _ in range(26):
        half = 0.5 * (low + high)
        point = np.moveaxis(AROUND.cast(stack(y, half), car.cabin), -1, 0)
        beside = car.side_window(*point) > car.roof(*point)
        low, high = np.where(beside, half, low), np.where(beside, high, half)
    return low


def belt(y: np.ndarray) -> np.ndarray:
    """The line on which the side windows stand."""
    return AROUND.place(ABOVE.cast(stack(BELT(y), y)))[..., 1]


def window_top(y: np.ndarray) -> np.ndarray:
    """The upper edge of the side windows, which comes down to the belt line behind them."""
    low = belt(y)
    return low + ramp(rail(y) - 0.055 - low, 0.012) * window(1.30 - y, 0.55)


def frame_inside(y: np.ndarray) -> np.ndarray:
    """Points of the frame's inner edge, beside windscreen, roof and rear window."""
    return AROUND.cast(stack(y, rail(y) + 0.055))


def frame_crossing(edge: Edge, guess: float) -> float:
    """y where the frame's inner edge meets an edge across the car."""
    return meet(lambda y: frame_inside(y)[:, 0], edge, guess)


# --- Runs that two panels share

@cache
def bonnet_edge() -> np.ndarray:
    return along(NOSE_CORNER, COWL_CORNER, bonnet_side)


@cache
def wing_top() -> np.ndarray:
    """From the bonnet's corner to the door's."""
    def x_of_y(y: np.ndarray) -> np.ndarray:
        share = window(y - COWL_CORNER, DOOR_TOP - COWL_CORNER)
        return (1.0 - share) * bonnet_side(y) + share * BELT(y)
    return along(COWL_CORNER, DOOR_TOP, x_of_y)


@cache
def belt_line() -> np.ndarray:
    return along(DOOR_TOP, DOOR_END, BELT)


@cache
def shoulder() -> np.ndarray:
    """The quarter's upper edge."""
    return along(DOOR_END, TAIL_CORNER, BELT)


def door_edge(start: np.ndarray, shift: float) -> np.ndarray:
    """From a point on the belt line down to the sill, bowed."""
    foot = BESIDE.cast(stack(start[1] + shift, SILL))
    high, low = AROUND.place(np.stack([start, foot]))[:, 1]
    return run(AROUND, 0.0, 1.0, lambda share: (start[1] + shift * np.sin(0.5 * np.pi * share),
                                                high + share * (low - high)))


@cache
def door_front() -> np.ndarray:
    return door_edge(wing_top()[-1], -0.085)


@cache
def door_rear() -> np.ndarray:
    return door_edge(belt_line()[-1], 0.06)


def arch(axle: float, start: float, end: float) -> np.ndarray:
    """The edge of a wheel arch between two angles, degrees from the rear over the top."""
    return run(BESIDE, np.radians(start), np.radians(end), lambda turn: (
        axle + car.ARCH * np.cos(turn), car.ARCH_HEIGHT + car.ARCH * np.sin(turn)))


def foot(z: float) -> float:
    """Degrees below the axle at which an arch ends at a height."""
    return float(np.degrees(np.arcsin((car.ARCH_HEIGHT - z) / car.ARCH)))


@cache
def wing_arch() -> np.ndarray:
    return arch(car.FRONT_AXLE, -foot(SILL), NOSE_FOOT)


@cache
def quarter_arch() -> np.ndarray:
    return arch(car.REAR_AXLE, TAIL_FOOT, 180.0 + foot(SILL))


@cache
def nose_line() -> np.ndarray:
    """From the arch to the bonnet's corner."""
    return straight(AROUND, wing_arch()[-1], bonnet_edge()[0])


@cache
def tail_line() -> np.ndarray:
    return straight(AROUND, quarter_arch()[0], shoulder()[-1])


def sill(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    return run(BESIDE, start[1], end[1], lambda y: (y, SILL))
