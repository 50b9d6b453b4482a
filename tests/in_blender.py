"""Runs a script of the project inside Blender, with the import paths that stand in pyproject.toml:

    blender -b --factory-startup --python tests/in_blender.py -- SCRIPT [ARGUMENT...]

Blender gives a script neither its own folder nor PYTHONPATH to import from. Of a file with window tests they are run.
"""
import importlib
import runpy
import sys
import tomllib
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).resolve().parents[1]


def run_tests(window: ModuleType, names: dict[str, object]) -> None:
    """Runs the window tests among the names of a file, if there are any."""
    tests = window.find_tests(names)
    if tests:
        window.run(*tests)


def main() -> None:
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    sys.path[:0] = [str(ROOT / folder) for folder in settings["tool"]["pytest"]["ini_options"]["pythonpath"]]
    script, *arguments = sys.argv[sys.argv.index("--") + 1:]
    sys.argv[:] = [script, *arguments]
    names = runpy.run_path(str(ROOT / script), run_name="__main__")
    if script.startswith("tests/ui/test_"):
        run_tests(importlib.import_module("window"), names)


main()
