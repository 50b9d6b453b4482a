"""Rows of a line that the mouse pulls: a step, and the first one after a press, without Blender."""
import statistics
import time

import numpy as np
import reflines

from bench.row import Row

CELLS = {"10k": 100, "100k": 316}  # a side
VIEW, LINE = np.array([0.0, 0.0, 1.0]), np.array([0.3, 0.954, 0.0])
STEPS = 40
ALL_LINES = 40  # light lines around the panel


def make_panel(cells: int) -> tuple[np.ndarray, np.ndarray]:
    sides = np.linspace(-0.75, 0.75, cells + 1), np.linspace(-0.6, 0.6, cells + 1)
    x, y = (each.ravel() for each in np.meshgrid(*sides))
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    F = np.concatenate([np.column_stack([first, first + 1, first + cells + 2]),
                        np.column_stack([first, first + cells + 2, first + cells + 1])])
    return np.column_stack([x, y, -0.12 * x**2 - 0.08 * y**2 + 0.02 * x**2 * y - 0.03 * x**4]), F


def measure_steps(cells: int) -> tuple[list[float], float]:
    """Returns the milliseconds of each step, the press first, and the largest share of the lines' spacing by which the
    line passed beside the mouse. A step is what the add-on's thread does: handle, heights, reach, positions, lines."""
    V, F = make_panel(cells)
    start, other = (reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=[LINE, np.cross(VIEW, LINE)])
                    for _ in range(2))
    lines = reflines.LineHandles(start)
    follower = reflines.HandleFollower(start, lines)
    reflines.vertex_theta(other)
    across = start.field().mean(axis=0)
    middle, across = start.xy.mean(axis=0), across / np.linalg.norm(across)
    value, radius = lines.read_theta(middle[None])[0], np.linalg.norm(np.ptp(start.xy, axis=0)) / 3.0
    times, missed = [], 0.0
    for way in np.linspace(0.01, 0.06, STEPS):
        begin = time.perf_counter()
        handle = reflines.Handle((middle + way * across)[None], value=value, radius=radius, centre=middle[None])
        assert follower.follow([handle], other)
        reach, = lines.measure([handle], other, line_step=2.0 * np.pi / ALL_LINES)
        assert len(other.positions) == len(reflines.vertex_theta(other))
        times.append(1e3 * (time.perf_counter() - begin))
        missed = max(missed, reach.fraction)
    return times, missed


def rows() -> list[Row]:
    result = []
    for size, cells in CELLS.items():
        times, missed = measure_steps(cells)
        result += [Row(f"handle_step_ms_{size}", statistics.median(times[1:]), "ms",
                       f"a step of Pull Line, median of {STEPS - 1}; the slowest {max(times[1:]):.0f} ms; the line "
                       f"passes {missed:.2%} of the spacing beside the mouse at most"),
                   Row(f"handle_first_ms_{size}", times[0], "ms", "from the press to the first moved line")]
    return result


if __name__ == "__main__":
    for row in rows():
        print(f"{row.name:24} {row.value:8.1f} {row.unit:4} {row.note}")
