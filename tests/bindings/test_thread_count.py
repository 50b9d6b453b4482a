"""The same bits for any number of threads, seen from outside: each count in a process of its own."""
import hashlib
import os
import subprocess
import sys

import pytest

SOLVE = """
import sys
import numpy as np
import reflines
from sample_panels import LINE, VIEW, panel, rippled
positions, triangles = panel(140)  # 39,200 triangles: enough for loops to be shared out
start = rippled(positions, amplitude=3e-4, wavelength=0.15)
optimizer = reflines.ShapeOptimizer(start, triangles, view_direction=VIEW, line_direction=LINE, border=sys.argv[1],
                                    linear_solver=sys.argv[3])
optimizer.solve(reflines.smooth(optimizer, length=0.3), strategy=sys.argv[2], max_iterations=4)
sys.stdout.buffer.write(optimizer.heights.tobytes() + optimizer.field().tobytes())
"""


def solved(threads: int, border: str, strategy: str, linear_solver: str = "cholmod") -> str:
    environment = os.environ | {"OMP_NUM_THREADS": str(threads), "OPENBLAS_NUM_THREADS": str(threads),
                                "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    run = subprocess.run([sys.executable, "-c", SOLVE, border, strategy, linear_solver], env=environment,
                         check=True, stdout=subprocess.PIPE)
    assert len(run.stdout) > 8 * 140**2
    return hashlib.sha256(run.stdout).hexdigest()


def test_one_two_and_five_threads_give_the_same_bits():
    assert solved(1, "clamped", "adaptive") == solved(2, "clamped", "adaptive") == solved(5, "clamped", "adaptive")


@pytest.mark.parametrize("options", [("free", "newton"), ("clamped", "linearized", "umfpack")])
def test_also_for_full_newton_with_a_free_border_and_for_umfpack(options):
    assert solved(1, *options) == solved(2, *options)
