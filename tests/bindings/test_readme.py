"""README's two programs, word for word: the one for Python runs, the one for C++ compiles."""
import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

pytestmark = pytest.mark.skipif("REFLINES_ADDON" in os.environ, reason="the package has no README")


def program(language: str) -> str:
    return re.search(rf"```{language}\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)[1]


def test_the_one_for_python_takes_a_dent_out_of_a_dome(capsys: pytest.CaptureFixture[str]) -> None:
    exec(program("python"), names := {})
    healed = names["report"].healed
    assert healed.worst_before > 1.0 and healed.worst_after < 0.1 * healed.worst_before
    assert str(healed.worst_after) in capsys.readouterr().out


def test_the_one_for_cpp_compiles(tmp_path: Path) -> None:
    source = tmp_path / "program.cpp"
    source.write_text(program("cpp"))
    folders = [f"-I{ROOT / 'native/include'}", "-I/usr/include/eigen3"]
    result = subprocess.run(["c++", "-std=c++20", "-fsyntax-only", *folders, source], text=True, stderr=subprocess.PIPE)
    assert result.returncode == 0, result.stderr
