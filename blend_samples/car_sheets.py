"""The painted panels of the left half of the car, between their shut lines. numpy only."""
import numpy as np

import car_lines as lines
import car_shape as car
from car_panels import ABOVE, AHEAD, AROUND, ASTERN, GAP, Chart, Path, Sheet, path, run, stack


def around_wheel(axle: float, arch: np.ndarray, *outer: np.ndarray) -> dict[str, Path | float]:
    """The inner and the outer edge of a panel around a wheel: both turn about the wheel at the same pace. The outer one
    has its corner at the end of its first run.
    """
    points = np.concatenate(outer)
    turn = np.unwrap(np.arctan2(points[:, 2] - car.ARCH_HEIGHT, points[:, 1] - axle))
    share = (turn - turn[0]) / (turn[-1] - turn[0])
    order, places = np.argsort(share), AROUND.place(points)

    def high(at: np.ndarray) -> np.ndarray:
        return stack(*(np.interp(at, share[order], places[order, k]) for k in range(2)))
    return {"low": path(AROUND, arch), "bend": float(share[len(outer[0]) - 1]), "high": high}


def bonnet() -> Sheet:
    front, rear = lines.bonnet_side(lines.NOSE_CORNER), lines.bonnet_side(lines.COWL_CORNER)
    return Sheet("Bonnet", ABOVE, low=path(ABOVE, lines.across(0.0, front, lines.bonnet_front)),
                 high=path(ABOVE, lines.across(0.0, rear, lines.bonnet_rear)),
                 left=path(ABOVE, lines.middle(lines.bonnet_front(0.0), lines.bonnet_rear(0.0))),
                 right=path(ABOVE, lines.bonnet_edge()), size=0.0125, gaps=(GAP, GAP, 0.0, GAP))


def wing() -> Sheet:
    arch, door = lines.wing_arch(), lines.door_front()
    return Sheet("Wing", AROUND, left=path(AROUND, lines.sill(arch[0], door[-1])),
                 right=path(AROUND, lines.nose_line()), size=0.036, gaps=(0.0, GAP, 0.0, GAP),
                 **around_wheel(car.FRONT_AXLE, arch, door[::-1], lines.wing_top()[::-1], lines.bonnet_edge()[::-1]))


def door() -> Sheet:
    front, rear = lines.door_front(), lines.door_rear()
    return Sheet("Door", AROUND, low=path(AROUND, lines.sill(front[-1], rear[-1])),
                 high=path(AROUND, lines.belt_line()), left=path(AROUND, front[::-1]), right=path(AROUND, rear[::-1]),
                 size=0.0135, gaps=(0.0, 0.0, GAP, GAP))


def quarter() -> Sheet:
    arch, door_rear = lines.quarter_arch(), lines.door_rear()
    return Sheet("Quarter", AROUND, left=path(AROUND, lines.tail_line()),
                 right=path(AROUND, lines.sill(arch[-1], door_rear[-1])), size=0.036, gaps=(0.0, 0.0, GAP, GAP),
                 **around_wheel(car.REAR_AXLE, arch, lines.shoulder()[::-1], door_rear))


def end(name: str, chart: Chart, axle: float, angles: tuple[float, float], top: np.ndarray, side: np.ndarray) -> Sheet:
    """Nose or tail: from the plane of symmetry to the wheel arch."""
    arch = lines.arch(axle, *angles)
    low = run(chart, 0.0, chart.place(arch[-1])[0], lambda turn: (turn, lines.ENDS))
    centre = run(chart, lines.ENDS, top[0][2], lambda z: (0.0 * z, z))
    return Sheet(name, chart, low=path(chart, low), high=path(chart, top), left=path(chart, centre),
                 right=path(chart, arch[::-1], side), size=0.038, gaps=(0.0, GAP, 0.0, GAP))


def nose() -> Sheet:
    top = lines.across(0.0, lines.bonnet_side(lines.NOSE_CORNER), lines.bonnet_front)
    return end("Nose", AHEAD, car.FRONT_AXLE, (lines.NOSE_FOOT, 180.0 + lines.foot(lines.ENDS)), top, lines.nose_line())


def deck_edge() -> np.ndarray:
    return lines.across(0.0, lines.BELT(lines.TAIL_CORNER), lines.deck_rear)


def tail() -> Sheet:
    angles = (lines.TAIL_FOOT, -lines.foot(lines.ENDS))
    return end("Tail", ASTERN, car.REAR_AXLE, angles, deck_edge(), lines.tail_line())


def boot() -> Sheet:
    return Sheet("Boot", ABOVE, low=path(ABOVE, lines.across(0.0, lines.BELT(lines.DECK_CORNER), lines.deck_front)),
                 high=path(ABOVE, deck_edge()),
                 left=path(ABOVE, lines.middle(lines.deck_front(0.0), lines.deck_rear(0.0))),
                 right=path(ABOVE, lines.along(lines.DECK_CORNER, lines.TAIL_CORNER, lines.BELT)), size=0.036,
                 gaps=(GAP, GAP, 0.0, GAP))


def roof() -> Sheet:
    start, stop = lines.frame_crossing(lines.header, 0.03), lines.frame_crossing(lines.roof_end, 1.0)
    side = lines.frame_inside(np.linspace(start, stop, 161))
    return Sheet("Roof", ABOVE, low=path(ABOVE, lines.across(0.0, side[0, 0], lines.header)),
                 high=path(ABOVE, lines.across(0.0, side[-1, 0], lines.roof_end)),
                 left=path(ABOVE, lines.middle(lines.header(0.0), lines.roof_end(0.0))), right=path(ABOVE, side),
                 size=0.045, gaps=(0.0, 0.0, 0.0, GAP))


def frame() -> Sheet:
    """Pillars and cant rail: around the side windows."""
    start, stop = (lines.frame_crossing(edge, guess) for edge, guess in
                   ((lines.bonnet_rear, -0.78), (lines.deck_front, 1.66)))
    inside = lines.frame_inside(np.linspace(start, stop, 241))
    y = np.linspace(lines.DOOR_TOP, lines.DECK_CORNER, 161)
    outside = AROUND.cast(stack(y, lines.window_top(y)))
    cowl = lines.across(lines.bonnet_side(lines.COWL_CORNER), inside[0, 0], lines.bonnet_rear)
    foot = lines.across(lines.BELT(lines.DECK_CORNER), inside[-1, 0], lines.deck_front)
    return Sheet("Frame", AROUND, low=path(AROUND, lines.wing_top(), outside), high=path(AROUND, inside),
                 left=path(AROUND, cowl), right=path(AROUND, foot), size=0.036, gaps=(0.0, 0.0, GAP, GAP))


def dense_sheets() -> list[Sheet]:
    """Those with flaws."""
    return [bonnet(), door()]


def cage_sheets() -> list[Sheet]:
    return [wing(), quarter(), nose(), tail(), boot(), roof(), frame()]
