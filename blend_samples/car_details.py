"""Windows, lamps, openings and skirts: dark sheets that lie on the body or just below its panels. numpy only."""
from collections.abc import Callable

import numpy as np

import car_lines
import car_shape as car
from car_panels import AHEAD, AROUND, ASTERN, BESIDE, Chart, Sheet, stack

Edge = Callable[[np.ndarray], np.ndarray]


def between(name: str, chart: Chart, ends: tuple[float, float], edges: tuple[Edge, Edge], size: float, material: str,
            lift: float) -> Sheet:
    """A sheet between two edges, which are the second number of a chart over the first."""
    start, end = ends

    def edge(of: Edge) -> Callable:
        def places(share: np.ndarray) -> np.ndarray:
            first = start + share * (end - start)
            return stack(first, of(first))
        return places

    def side(first: float) -> Callable:
        low, high = (float(of(np.array([first]))[0]) for of in edges)
        return lambda share: stack(first, low + share * (high - low))
    return Sheet(name, chart, edge(edges[0]), edge(edges[1]), side(start), side(end), size, (0.0,) * 4,
                 material=material, lift=lift)


def level(height: float, rise: float = 0.0, start: float = 0.0) -> Edge:
    return lambda along: height + rise * (along - start)


def rounded(edge: Edge, ends: tuple[float, float], by: float) -> Edge:
    """An edge that comes in by so much towards its ends."""
    start, end = ends
    return lambda along: edge(along) + by * np.abs(2.0 * (along - start) / (end - start) - 1.0)**6


def windows() -> Sheet:
    below_belt = (lambda y: car_lines.belt(y) - 0.03, level(0.5 * np.pi))
    return between("Windows", AROUND, (-0.90, 1.80), below_belt, 0.05, "Glass", -0.005)


def details() -> list[Sheet]:
    lamp, inlet, tail, skirt = (0.40, 0.86), (-0.42, 0.42), (-0.66, 0.66), (car.FRONT_AXLE + 0.2, car.REAR_AXLE - 0.2)
    diffuser = (level(0.17), rounded(level(0.345), (-0.72, 0.72), -0.13))
    return [
        between("Head Lamp", AHEAD, lamp, (rounded(level(0.588, 0.06, 0.4), lamp, 0.012),
                                           rounded(level(0.630, 0.075, 0.4), lamp, -0.012)), 0.03, "Lamp", 0.0015),
        between("Inlet", AHEAD, (0.0, 0.42), (level(0.285), rounded(level(0.405), inlet, -0.06)), 0.04, "Black",
                0.0012),
        between("Side Inlet", AHEAD, (0.56, 0.80), (level(0.30), rounded(level(0.43), (0.4, 0.80), -0.08)), 0.03,
                "Black", 0.0012),
        between("Lip", AHEAD, (0.0, 1.05), (level(0.155), level(0.205)), 0.05, "Black", -0.006),
        between("Tail Lamp", ASTERN, (0.0, 0.66), (rounded(level(0.775), tail, 0.010),
                                                   rounded(level(0.825), tail, -0.005)), 0.03, "Red", 0.0015),
        between("Diffuser", ASTERN, (0.0, 0.72), diffuser, 0.05, "Black", 0.0015),
        between("Skirt", BESIDE, skirt, (level(0.165), level(0.25)), 0.06, "Black", -0.008),
        between("Handle", BESIDE, (0.42, 0.58), (rounded(level(0.722), (0.42, 0.58), 0.004),
                                                 rounded(level(0.742), (0.42, 0.58), -0.004)), 0.02, "Black", 0.003),
    ]
