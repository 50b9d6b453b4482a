"""Loads a module in a Python of Windows under Wine, compares its solves with Linux's, and runs the binding tests.

The tests run in the root's own Python, with its numpy and pytest; .ci/wine/client stands for the module there and hands
every call through a pipe to .ci/wine/server.py in the Python of Windows, which has no numpy but a stand-in.
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from matrix import ROOT, inside

sys.path.insert(0, str(ROOT / "tests"))

from suites import Counts, crashed, judged, junit_counts  # noqa: E402  (found through the line above)

TOOLS = ("python3-numpy", "python3-pytest", "python3-scipy")  # of the tests, in the root
TESTS = "src/tests/bindings"
CLIENT = "/src/.ci/wine/client"
REPORT = "src/build/tests/bindings.xml"
LIMIT = 3600  # seconds, for each module; the tests take 10 minutes
# Of the largest move of each of 70 solves. Measured: 3.0e-9 at most, where OpenBLAS's kernels for two processors of
# Linux differ by 3.3e-9; both in a solve whose minimum is flat, and by 1e-10 and less in 64 of them.
DIFFERENCE = 1e-8
LEFT_OUT = {
    "test_bit_identity.py": "its hashes are of OpenBLAS's results; the BLAS in the module for Windows is Eigen's",
    "test_processors.py": "it chooses OpenBLAS's kernels, and the module for Windows has none of them",
    "test_wheel.py": "it makes a wheel of the module for Linux",
    "test_installed_library.py": "it builds the C++ library for Linux",
    "test_two_copies.py": "it copies the module's file beside that which is loaded",
    "test_hostile.py::test_no_object_is_made_without_its_constructor": "the tests' classes stand for the module's here",
    "test_task.py::test_no_other_thread_runs_python": "it looks at the threads of its own Python, not of Windows's",
}


def place_module(program: Path, module: Path) -> None:
    """Puts the module and the server of calls where a Python of Windows finds them."""
    for file in (module, ROOT / ".ci/wine/server.py", ROOT / ".ci/wine/client/messages.py"):
        shutil.copy(file, program.parent / "Lib/site-packages")


def settings(root: Path, program: Path, wine: dict[str, str]) -> dict[str, str]:
    return {**wine, "PYTHONPATH": f"{CLIENT}:/{TESTS}", "PYTHONDONTWRITEBYTECODE": "1",
            "REFLINES_WINDOWS_PYTHON": f"/{program.relative_to(root)}"}


def loaded(root: Path, env: dict[str, str]) -> Counts:
    """Whether the module loads; prints where and in which Python."""
    command = ["python3", "-c", "import reflines; print('loaded', reflines.LOADED)"]
    found = subprocess.run(inside(root, *command, env=env)).returncode == 0
    return Counts(passed=1) if found else crashed("windows: the module does not load")


def run_tests(root: Path, env: dict[str, str]) -> Counts:
    for test, reason in LEFT_OUT.items():
        print(f"left out: {test}: {reason}")
    left_out = [f"--deselect=tests/bindings/{test}" for test in LEFT_OUT]
    (root / REPORT).unlink(missing_ok=True)
    script = 'cd /src && exec python3 -m pytest -q -rs -p no:cacheprovider "$@"'
    command = ["sh", "-c", script, "sh", f"--junitxml=/{REPORT}", *left_out, f"/{TESTS}"]
    try:
        code = subprocess.run(inside(root, *command, env=env), timeout=LIMIT).returncode
    except subprocess.TimeoutExpired:
        return crashed(f"windows: the binding tests did not end within {LIMIT} s")
    if not (root / REPORT).is_file():
        return crashed("windows: the binding tests left no report")
    counts = junit_counts(root / REPORT)
    return judged(counts, code, "bindings") + Counts(skipped=len(LEFT_OUT))


def largest_difference(here: Path, there: Path) -> float:
    """Between the moves in two files, relative to the largest move of each solve."""
    with np.load(here) as ours, np.load(there) as others:
        assert ours.files == others.files
        return max(np.abs(ours[name] - others[name]).max() / np.abs(ours[name]).max() for name in ours.files)


def compare(root: Path, env: dict[str, str]) -> Counts:
    """Whether solves move the same as those of the module for Linux, which is built in the add-on's folder."""
    here, there = ROOT / "build/tests/moves.npz", root / "src/build/tests/moves.npz"
    here.parent.mkdir(parents=True, exist_ok=True)
    path = os.pathsep.join([str(ROOT / "addon"), str(ROOT / "tests/bindings")])
    runs = [subprocess.run([sys.executable, ROOT / ".ci/wine/moves.py", here], env=os.environ | {"PYTHONPATH": path}),
            subprocess.run(inside(root, "python3", "/src/.ci/wine/moves.py", f"/{there.relative_to(root)}", env=env))]
    if any(run.returncode != 0 for run in runs):
        return crashed("windows: the solves that are compared did not end")
    difference = largest_difference(here, there)
    print(f"solves of Windows and Linux differ by {difference:.1e} of the largest move; {DIFFERENCE:.0e} is allowed")
    return Counts(passed=1) if difference <= DIFFERENCE else crashed("windows: other solves than on Linux")


def test_bindings(root: Path, program: Path, module: Path, wine: dict[str, str]) -> Counts:
    place_module(program, module)
    env = settings(root, program, wine)
    total = loaded(root, env)
    if total.failed == 0:
        total += compare(root, env) + run_tests(root, env)
    print(f"bindings of {module.name} under Wine: {total}", flush=True)
    return total
