"""The same solve on processors of different kinds: the bits differ with OpenBLAS's kernels, the shape does not.

Thread counts and runs give the same bits (see test_thread_count.py); of processors 1e-9 of the move is promised.
"""
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import reflines

# Kernels for processors of 2004, 2011, 2013 and 2017; a name that this processor cannot run falls back to its own.
KINDS = ("Prescott", "Sandybridge", "Haswell", "SkylakeX")
PROMISED = 1e-9  # of the largest move
SCRIPT = """
import sys
import numpy as np
import reflines
from sample_panels import LINE, VIEW, panel, rippled
positions, triangles = panel(96)
solver = reflines.ShapeOptimizer(rippled(positions, amplitude=1e-3, wavelength=0.3), triangles, view_direction=VIEW,
                                 line_direction=LINE, border=sys.argv[1])
before = solver.positions
assert solver.solve(reflines.smooth(solver, length=0.3)).converged
np.save(sys.argv[2], solver.positions - before)
"""


def move_on(kind: str, border: str, path: Path) -> np.ndarray:
    here = Path(__file__).resolve().parent
    search = os.pathsep.join([str(here), str(here.parent), str(Path(reflines.__file__).parent)])
    env = os.environ | {"OPENBLAS_CORETYPE": kind, "PYTHONPATH": search}
    subprocess.run([sys.executable, "-c", SCRIPT, border, str(path)], env=env, check=True)
    return np.load(path)


@pytest.mark.parametrize("border", ["clamped", "free"])
def test_the_shape_is_the_same_on_processors_of_any_kind(border, tmp_path) -> None:
    moves = {kind: move_on(kind, border, tmp_path / f"{kind}.npy") for kind in KINDS}
    first = moves[KINDS[0]]
    largest = np.abs(first).max()
    assert largest > 1e-4
    apart = {kind: float(np.abs(move - first).max() / largest) for kind, move in moves.items()}
    print(border, apart)
    assert max(apart.values()) <= PROMISED
