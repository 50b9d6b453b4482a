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
LIMIT_MESH = """
import sys
import reflines
from sample_panels import LINE, VIEW, panel, rippled
positions, triangles = panel(125)
start = rippled(positions, amplitude=3e-4, wavelength=0.15)
optimizer = reflines.ShapeOptimizer(start, triangles, view_direction=VIEW, line_direction=LINE)
optimizer.solve(reflines.smooth(optimizer, length=0.3), limit=1e-4)
sys.stdout.buffer.write(optimizer.positions.tobytes() + optimizer.at_limit.tobytes())
"""
LIMIT_CAGE = """
import sys
import reflines
from sample_cages import LINE, VIEW, dented, hood, optimizer
for share in (0.3, 0.03):
    solver = optimizer(dented(hood(18, 15), VIEW, LINE), level=3)
    target = reflines.smooth(solver, length=0.35)
    limit = share * solver.solve(target).largest_move
    solver.reset()
    solver.solve(target, limit=limit)
    sys.stdout.buffer.write(solver.cage_positions.tobytes() + solver.at_limit.tobytes())
"""


def solved(threads: int, program: str, *arguments: str) -> str:
    environment = os.environ | {"OMP_NUM_THREADS": str(threads), "OPENBLAS_NUM_THREADS": str(threads),
                                "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    run = subprocess.run([sys.executable, "-c", program, *arguments], env=environment, check=True,
                         stdout=subprocess.PIPE)
    assert len(run.stdout) > (8 * 140**2 if program is SOLVE else 0)
    return hashlib.sha256(run.stdout).hexdigest()


def test_one_two_and_five_threads_give_the_same_bits():
    arguments = SOLVE, "clamped", "adaptive", "cholmod"
    assert solved(1, *arguments) == solved(2, *arguments) == solved(5, *arguments)


@pytest.mark.parametrize("arguments", [
    (SOLVE, "free", "newton", "cholmod"), (SOLVE, "clamped", "linearized", "umfpack"), (LIMIT_MESH,), (LIMIT_CAGE,),
], ids=["newton", "umfpack", "limit of a mesh", "limit of a cage"])
def test_also_for_other_solvers_and_within_a_limit(arguments):
    assert solved(1, *arguments) == solved(2, *arguments)
