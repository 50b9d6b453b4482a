"""A cancelled call raises within 0.3 s, in whatever stage it is; what was begun goes on in a thread that nobody awaits.

Each stage here takes half a second and more in one piece, so that a caller who waited for its end would be too late.
"""
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import reflines
import sample_cages
from sample_panels import LINE, VIEW, panel, rippled

SLOWER = float(os.environ.get("REFLINES_SLOWER", "1"))  # times that the module is slower, as under sanitizers
SOONEST = 0.3 * SLOWER  # seconds
ATTEMPTS = 3   # on a machine with other work

Work = Callable[[reflines.Progress], object]


def waited(stage: str, work: Work) -> float:
    """Seconds from a request that comes in the middle of a stage to its exception."""
    progress, asked = reflines.Progress(), []

    def ask() -> None:
        while progress.stage != stage:
            time.sleep(0.002)
        time.sleep(0.03)
        asked.append(time.monotonic())
        progress.cancel()

    thread = threading.Thread(target=ask)
    thread.start()
    with pytest.raises(reflines.Cancelled):
        work(progress)
    end = time.monotonic()
    thread.join()
    return end - asked[0]


def smaller(cells: int) -> int:
    """So many cells a side that a slower module takes about as long."""
    return max(4, round(cells / SLOWER**0.5))


def flawed_panel(cells: int) -> tuple[np.ndarray, np.ndarray]:
    V, F = panel(cells)
    return rippled(V, amplitude=2e-4, wavelength=0.15), F


def sheet(most: int) -> dict[str, np.ndarray]:
    cells = smaller(most)
    offsets, corners = sample_cages.sheet(cells, cells)
    x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(-1, 1, cells + 1), np.linspace(-1, 1, cells + 1)))
    return {"V": np.stack([x, y, -0.1 * x * x], 1), "face_offsets": offsets, "face_vertices": corners}


def press_of_a_mesh() -> Work:
    V, F = flawed_panel(smaller(300))
    return lambda progress: reflines.smooth_panel(V, F, view_direction=VIEW, line_direction=LINE, progress=progress)


def press_of_a_cage() -> Work:
    return lambda progress: reflines.smooth_cage_panel(**sheet(10), view_direction=VIEW, line_direction=LINE, level=5,
                                                       progress=progress)


def cage() -> Work:
    return lambda progress: reflines.CageOptimizer(**sheet(18), view_direction=VIEW, line_direction=LINE, level=5,
                                                   progress=progress)


def smoothing_of_lines() -> Work:
    V, F = flawed_panel(370 if SLOWER == 1.0 else 250)  # the library that factors is as fast as ever

    def smooth(progress: reflines.Progress) -> object:
        solver = reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LINE, progress=progress)
        return reflines.smooth(solver, length=0.2)

    return smooth


@pytest.mark.parametrize(("stage", "work"), [
    ("smoothing the lines", press_of_a_cage), ("smoothing the lines", press_of_a_mesh), ("making stencils", cage),
    ("factorizing the smoothing", smoothing_of_lines),
], ids=["press of a cage", "press of a mesh", "fine cage", "factorization"])
def test_a_cancelled_call_raises_at_once(stage, work) -> None:
    run = work()
    waits: list[float] = []
    while len(waits) < ATTEMPTS and (not waits or waits[-1] > SOONEST):
        waits.append(waited(stage, run))
    print(stage, waits)
    assert waits[-1] <= SOONEST


def test_a_cancelled_solve_of_a_large_mesh_leaves_every_bit() -> None:
    """Wherever it had come to, the optimizer then solves as a new one does.

    A solve that other work of the machine held up says nothing about when the next one is in its middle, so that a
    faster one sets the moments from then on.
    """
    V, F = flawed_panel(smaller(140))
    other = reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LINE)
    report = other.solve(reflines.smooth(other, length=0.2))
    assert report.converged
    solver = reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LINE)
    target = reflines.smooth(solver, length=0.2)
    before = solver.positions
    cancelled, seconds = 0, report.seconds
    for share in np.linspace(0.05, 0.95, 10):
        progress = reflines.Progress()
        timer = threading.Timer(share * seconds, progress.cancel)
        timer.start()
        result = solver.solve(target, progress=progress)
        timer.cancel()
        if result.termination == "cancelled":
            cancelled += 1
            assert np.array_equal(solver.positions, before)
            result = solver.solve(target, progress=reflines.Progress())
        assert result.converged and np.array_equal(solver.positions, other.positions)
        seconds = min(seconds, result.seconds)
        solver.reset()
    assert cancelled > 2


LEAVES = """
import threading
import reflines
from test_cancelling import press_of_a_mesh
progress = reflines.Progress()
threading.Timer(1.0, progress.cancel).start()
try:
    press_of_a_mesh()(progress)
except reflines.Cancelled:
    print("cancelled", flush=True)
"""


def test_a_process_ends_well_whose_work_was_abandoned() -> None:
    here = Path(__file__).resolve().parent
    search = os.pathsep.join([str(here), str(here.parent), str(Path(reflines.__file__).parent)])
    result = subprocess.run([sys.executable, "-c", LEAVES], env=os.environ | {"PYTHONPATH": search}, text=True,
                            capture_output=True)
    assert (result.returncode, result.stdout) == (0, "cancelled\n"), result.stderr
