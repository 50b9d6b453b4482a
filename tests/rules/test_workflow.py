"""The workflow for public CI, which cannot run here, is made of what does: verbs of `./run` and presets of CMake."""
import json
import re

from test_tree import verbs
from tree import ROOT

WORKFLOW = ROOT / ".github/workflows/build.yml"
PRESET = re.compile(r"(cmake|cmake --build|ctest) --preset ([\w-]+)")
KINDS = {"cmake": "configurePresets", "cmake --build": "buildPresets", "ctest": "testPresets"}


def test_it_calls_verbs_that_are_there() -> None:
    called = re.findall(r"\./run ([a-z]+)", WORKFLOW.read_text())
    assert called and set(called) <= set(verbs())


def test_it_uses_presets_that_are_there() -> None:
    presets = json.loads((ROOT / "CMakePresets.json").read_text())
    used = PRESET.findall(WORKFLOW.read_text())
    assert len(used) >= 6
    wrong = [(tool, name) for tool, name in used if name not in {preset["name"] for preset in presets[KINDS[tool]]}]
    assert not wrong, wrong


def test_it_says_that_it_has_not_been_run() -> None:
    assert "has not been run" in WORKFLOW.read_text().splitlines()[0]
