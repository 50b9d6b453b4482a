"""The rows of a press with a set of lights: flawed panels from five views in eight lights.

The set is that of *Walk Around*, two lights from each view. Lines are measured twice: by how even they are, as Inspect
does, and by how far theta, by a formula that shares no code with the solver, is from the clean panel's.

    PYTHONPATH=addon:tests:blend_samples python3 -m bench.light_set [PANEL...]    prints a line a panel, and the rows
"""
import sys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import reflines

from bench.flawed_panels import Array, FlawedPanel, list_panels
from bench.row import Row

LEAST_SEEN = 0.05    # share of a panel that a view has to see
GRAZING = 0.35       # cosine to the eye below which lines are not measured
THERE = 0.2          # of the largest errors: where the flaws are
ALONE = (0, 6)       # lights that are also pressed for alone, from each view: one of the set, and another


@dataclass(frozen=True)
class Outcome:
    """The largest ratios of a panel, over the eight lights (each from all views) and the five views (in all lights)."""
    name: str
    even: float        # unevenness after the press to that before
    theta: float       # likewise, how far theta is from the clean panel's where the flaws are
    whole: float       # likewise, over the whole panel
    over_alone: float  # theta where the flaws are, of a light from a view, to that after a press for it alone
    move: float        # largest move to the smallest of the presses for one light alone
    applied: bool


def compute_theta(V: Array, F: Array, eye: Array, line: Array) -> Array:
    """Returns theta at the triangles' normals (#F, radians): equation 1 of the paper."""
    n = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    mirrored = 2 * (n @ eye)[:, None] * n / np.maximum((n * n).sum(1), 1e-300)[:, None] - eye
    start = eye - (eye @ line) * line
    start /= np.linalg.norm(start)
    return np.arctan2(mirrored @ np.cross(line, start), mirrored @ start)


class Walk:
    """The walk around a panel: five views in eight lights, and where its flaws are."""

    def __init__(self, panel: FlawedPanel) -> None:
        self.panel = panel
        self.views, self.lines = reflines.walk_around(panel.view, panel.light)
        a, b, c = panel.clean[panel.F].transpose(1, 0, 2)
        cross = np.cross(b - a, c - a)
        self.area = np.linalg.norm(cross, axis=1)
        self.weight = self.area * (self.views @ cross.T > GRAZING * np.maximum(self.area, 1e-300))  # views x #F
        self.weight[self.weight.sum(axis=1) < LEAST_SEEN * self.area.sum()] = np.nan
        error = np.linalg.norm([self.measure_pair(panel.flawed, k, n) for k in range(5) for n in (0, 4)], axis=0)
        self.there = error > THERE * np.percentile(error[self.area > 0], 99)

    def make_set(self) -> "reflines.LightSet":
        return reflines.LightSet(np.tile(self.lines[[0, 4]], (5, 1)), np.repeat(self.views, 2, axis=0))

    def measure_pair(self, P: Array, view: int, light: int) -> Array:
        """Returns by how much theta differs from that of the clean panel (#F, radians)."""
        pair = self.views[view], self.lines[light]
        off = compute_theta(P, self.panel.F, *pair) - compute_theta(self.panel.clean, self.panel.F, *pair)
        return (off + np.pi) % (2 * np.pi) - np.pi

    def sum_pair(self, P: Array, view: int, light: int) -> Array:
        """Returns the same as degrees, root mean square, where the flaws are and over the whole panel (2); NaN from a
        view that does not see the panel.
        """
        off, seen = self.measure_pair(P, view, light), self.weight[view]
        return np.degrees([np.sqrt((off**2 * seen * there).sum() / (seen * there).sum()) for there in (self.there, 1)])

    def sum_theta(self, P: Array) -> Array:
        """Returns that for all pairs: 2 x views x lights."""
        return np.moveaxis(np.array([[self.sum_pair(P, k, n) for n in range(8)] for k in range(5)]), 2, 0)

    def measure_evenness(self, P: Array) -> Array:
        """Returns how far lines are from their course as Inspect tells it (views x lights, degrees)."""
        found = reflines.inspect_panel(P, self.panel.F, self.views, self.lines)
        return np.where((np.array(found.seen) < LEAST_SEEN)[:, None], np.nan, found.degrees)


def compare(after: Array, before: Array) -> float:
    """Returns the largest ratio of a light or a view, of numbers for all pairs (views x lights)."""
    sums = [[np.sqrt(np.nanmean(values**2, axis=axis)) for values in (after, before)] for axis in (0, 1)]
    return float(max(np.nanmax(one / other) for one, other in sums))


def judge_panel(panel: FlawedPanel, alone: Sequence[int] = ALONE) -> Outcome:
    """Presses a panel for the set, and for each of these lights alone from each view that sees the panel."""
    walk = Walk(panel)
    pressed, report = panel.press(walk.make_set())
    before, after = (walk.sum_theta(P) for P in (panel.flawed, pressed))
    ratios, moves = [], []
    for k, n in ((k, n) for k in range(5) for n in alone if not np.isnan(after[0, k, n])):
        own, told = panel.press(reflines.LightSet(walk.lines[[n]], walk.views[[k]]))
        ratios.append(after[0, k, n] / walk.sum_pair(own, k, n)[0])
        moves.append(told.largest_move)
    return Outcome(panel.name, compare(*map(walk.measure_evenness, (pressed, panel.flawed))),
                   compare(after[0], before[0]), compare(after[1], before[1]), max(ratios),
                   report.largest_move / max(min(moves), 1e-300), report.applied)


def make_rows(outcomes: Sequence[Outcome]) -> list[Row]:
    """Returns the worst of all panels for each measure, with the panel's name."""
    told = {"even": "unevenness after a press for the set to before, the worst of 8 lights and 5 views",
            "theta": "likewise, theta from the clean panel's where the flaws are",
            "whole": "likewise, over the whole panel",
            "over_alone": "theta where the flaws are, to that after a press for the light alone",
            "move": "largest move to the smallest of the presses for one light alone"}
    worst = {name: max(outcomes, key=lambda each: getattr(each, name)) for name in told}  # noqa: B023
    return [Row(f"light_set_{name}", getattr(worst[name], name), "",
                f"{note}; {len(outcomes)} panels, {worst[name].name}") for name, note in told.items()]


def rows(names: Sequence[str] = ()) -> list[Row]:
    outcomes = []
    for name, make in list_panels().items():
        if not names or name in names:
            outcomes.append(judge_panel(make()))
            print(outcomes[-1], flush=True)
    return make_rows(outcomes)


if __name__ == "__main__":
    for row in rows(sys.argv[1:]):
        print(f"{row.name:24} {row.value:8.3f} {row.unit:4} {row.note}")
