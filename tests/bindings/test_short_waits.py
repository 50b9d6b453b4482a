"""Waiting OpenMP threads sleep at once, seen from outside: the processor time of a process that does nothing."""
import os
import subprocess
import sys

import pytest

IDLE = """
import time
import reflines
from dented_dome import clean, grid
V, F = grid(clean)
fit = reflines.NormalFit(V, F)
spent = []
for _ in range(20):
    fit.normals(V)  # ends with a parallel loop, after which the threads wait for the next one
    start = time.process_time()
    time.sleep(0.03)
    spent.append(time.process_time() - start)
print(sorted(spent)[10])
"""

pytestmark = pytest.mark.skipif(sys.platform != "linux" or os.cpu_count() == 1, reason="no thread waits for another")


def measure_idle_time(policy: str | None = None) -> float:
    """Measures the seconds of processors that a pause of 0.03 s after a parallel loop takes, the median of 20."""
    environment = {name: value for name, value in os.environ.items()
                   if name not in {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT"}}
    environment |= {"OMP_NUM_THREADS": str(os.cpu_count()), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    environment |= {} if policy is None else {"OMP_WAIT_POLICY": policy}
    run = subprocess.run([sys.executable, "-c", IDLE], env=environment, check=True, text=True, stdout=subprocess.PIPE)
    return float(run.stdout)


def test_waiting_threads_take_no_time() -> None:
    assert measure_idle_time() < 0.0005


def test_the_user_may_want_them_to_spin() -> None:
    assert measure_idle_time("active") > 0.0025
