"""The wheel of the module: pip builds it, installs it in a place of its own, and there it needs no checkout."""
import os
import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

import numpy as np
import pytest
import reflines
from bit_identity import panel

ROOT = Path(__file__).resolve().parents[2]
PYTHON = "/usr/bin/python3"
SOLVE = """
import numpy as np
import reflines
optimizer = reflines.ShapeOptimizer(np.load("V.npy"), np.load("F.npy"), view_direction=(0, 0, 1),
                                    line_direction=(0, 1, 0), border="fixed")
optimizer.solve(reflines.smooth(optimizer, length=0.5))
np.save("solved.npy", optimizer.positions)
print(reflines.__file__)
"""

pytestmark = pytest.mark.skipif("REFLINES_ADDON" in os.environ, reason="there is no source to build a wheel from")


def run(*command: str | Path, cwd: Path = ROOT) -> str:
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    result = subprocess.run(command, cwd=cwd, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert result.returncode == 0, result.stdout[-3000:]
    return result.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    run(PYTHON, "-m", "pip", "wheel", ".", "--no-deps", "--no-index", "--wheel-dir", folder)
    found, = folder.iterdir()
    return found


def test_it_says_what_it_is(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        about = Parser().parsestr(archive.read(f"reflines-{reflines.__version__}.dist-info/METADATA").decode())
    assert (about["Name"], about["Version"]) == ("reflines", reflines.__version__)
    assert about.get_all("Requires-Dist") == ["numpy"]
    assert "reflines-stubs/__init__.pyi" in names
    assert len([name for name in names if name.endswith(".so")]) == 1
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    assert wheel.name.startswith(f"reflines-{reflines.__version__}-{python}-{python}-")


def test_installed_it_solves_as_the_build_does(wheel: Path, tmp_path: Path) -> None:
    """In an environment that has numpy from the system, from which pip sees that nothing else is asked for."""
    place = tmp_path / "environment"
    run(PYTHON, "-m", "venv", "--system-site-packages", place)
    run(place / "bin/python", "-m", "pip", "install", "--no-index", wheel)
    V, F = panel(14, seed=1)
    np.save(tmp_path / "V.npy", V)
    np.save(tmp_path / "F.npy", F)
    loaded = run(place / "bin/python", "-c", SOLVE, cwd=tmp_path).strip()
    assert Path(loaded).is_relative_to(place)
    optimizer = reflines.ShapeOptimizer(V, F, view_direction=(0, 0, 1), line_direction=(0, 1, 0), border="fixed")
    optimizer.solve(reflines.smooth(optimizer, length=0.5))
    assert np.abs(optimizer.positions - V).max() > 1e-5
    assert np.array_equal(np.load(tmp_path / "solved.npy"), optimizer.positions)
    run(place / "bin/python", "-m", "pip", "uninstall", "--yes", "reflines")
    assert not list(place.rglob("reflines*")), "what the wheel brought is all in its record"
