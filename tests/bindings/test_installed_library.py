"""The C++ library as another project uses it: installed into a scratch prefix, found by CMake, linked, run."""
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import reflines
from bit_identity import panel

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/release"
LENGTH = 0.5

pytestmark = pytest.mark.skipif("REFLINES_ADDON" in os.environ or not (BUILD / "CMakeCache.txt").is_file(),
                                reason="there is no build of the library in build/release to install")


def run(*command: str | Path) -> str:
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert result.returncode == 0, result.stdout[-3000:]
    return result.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("prefix")
    run("cmake", "--install", BUILD, "--prefix", folder, "--component", "reflines")
    return folder


@pytest.fixture(scope="module")
def example(prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    build = tmp_path_factory.mktemp("examples")
    run("cmake", "-S", ROOT / "native/examples", "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}",
        "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", build)
    return build / "smooth_obj"


def write_obj(path: Path, V: np.ndarray, F: np.ndarray) -> None:
    vertices = [f"v {x!r} {y!r} {z!r}" for x, y, z in V.tolist()]
    path.write_text("\n".join([*vertices, *(f"f {a} {b} {c}" for a, b, c in (F + 1).tolist())]) + "\n")


def read_vertices(path: Path) -> np.ndarray:
    lines = path.read_text().splitlines()
    return np.array([[float(word) for word in line.split()[1:]] for line in lines if line.startswith("v ")])


def test_only_public_headers_are_installed(prefix: Path) -> None:
    installed = {path.name for path in (prefix / "include/reflines").iterdir()}
    assert installed == {path.name for path in (ROOT / "native/include/reflines").iterdir()}


def test_the_example_does_what_the_module_does(example: Path, tmp_path: Path) -> None:
    V, F = panel(14, seed=1)
    write_obj(tmp_path / "in.obj", V, F)
    told = run(example, tmp_path / "in.obj", tmp_path / "out.obj", str(LENGTH))
    positions, report = reflines.smooth_panel(V, F, view_direction=(0, 0, 1), line_direction=(0, 1, 0), border="fixed",
                                              length=LENGTH)
    assert f"deviation of lines {report.healed.worst_before:.6g} -> {report.healed.worst_after:.6g} degrees" in told
    assert np.abs(positions - V).max() > 1e-5
    assert np.array_equal(read_vertices(tmp_path / "out.obj"), positions)


def test_the_example_refuses_a_file_that_is_not_there(example: Path, tmp_path: Path) -> None:
    missing = tmp_path / "missing.obj"
    result = subprocess.run([example, missing, tmp_path / "out.obj", "1"], text=True, stderr=subprocess.PIPE)
    assert result.returncode == 1 and "cannot be read" in result.stderr
