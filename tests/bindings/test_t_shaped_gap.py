"""One surface that a T-shaped gap cuts into three panels with different meshes, pressed as one problem."""
import numpy as np
import pytest
import reflines
from test_follow_border import DIRECTIONS, Array
from test_joint_smoother import change, press, sheet
from test_shut_lines import Mesh, join


SIZE = np.sqrt(2.0)  # of the whole surface


def cut_in_three(gap: float) -> list[Mesh]:
    g = 0.5 * gap
    return [sheet((-0.5, -0.5), (-g, 0.5), "regular", 40), sheet((g, -0.5), (0.5, -g), "irregular", 40),
            sheet((g, g), (0.5, 0.5), "4-8", 28)]


def dents(V: Array) -> Array:
    """Heights of a dent across each arm of the T but the lowest, beside which there is a ripple."""
    x, y = V[:, 0], V[:, 1]
    ripple = 1e-4 * np.sin(2.0 * np.pi * (x + 0.4 * y) / 0.09) * np.exp(-(x / 0.2) ** 4 - ((y + 0.25) / 0.15) ** 4)
    return ripple - 0.002 * sum(np.exp(-((x - a)**2 + (y - b)**2) / 0.05**2) for a, b in ((0.0, 0.25), (0.25, 0.0)))


def measure(meshes: list[Mesh], before: list[Array]) -> list:
    """The shut lines of each panel towards the others, as they all were and are; lines in both lights."""
    found = []
    for k, (V, F) in enumerate(meshes):
        beside, G = join(*(mesh for j, mesh in enumerate(meshes) if j != k))
        found.append([reflines.check_shut_lines(own, own, F, np.ones(len(F), dtype=bool), there, G, **DIRECTIONS)
                      for own, there in ((before[k], np.concatenate([W for j, W in enumerate(before) if j != k])),
                                         (V, beside))])
    return found


@pytest.mark.parametrize("gap", [0.001, 0.004, 0.008])
def test_lines_run_on_over_each_arm_and_the_gaps_keep_their_width(gap: float) -> None:
    meshes = cut_in_three(gap)
    flawed = [(change(V, dents(V)), F) for V, F in meshes]
    results = press(*flawed)
    assert all(told.applied and not any(note.kind == "joining_worsens" for note in told.notes) for _, told in results)
    healed = [(V, F) for (V, _), (_, F) in zip(results, flawed, strict=True)]
    for before, after in measure(healed, [V for V, _ in flawed]):
        assert len(after.edges) == len(before.edges) >= 40
        assert before.after.kink.max() > 0.29 and before.after.line_offset.max() > 10.0
        assert after.after.kink.max() < 0.1 and after.after.line_offset.max() < (4.0 if gap > 0.005 else 2.0)
        assert np.abs(after.after.gap - before.after.gap).max() < 1e-6 * SIZE


def test_both_rims_follow_where_three_panels_meet() -> None:
    """At a corner the neighbour that is as near as another but does not lie outwards is passed over."""
    meshes = cut_in_three(0.004)
    for k, (V, F) in enumerate(meshes[1:], 1):
        beside, G = join(*(mesh for j, mesh in enumerate(meshes) if j != k))
        corner = np.argmin(np.hypot(V[:, 0], V[:, 1]))
        assert reflines.continue_over_gap(V, F, beside, G, margin=0.17).followed[corner]
