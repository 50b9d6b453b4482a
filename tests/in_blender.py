"""Runs a script of the project inside Blender, with the import paths that stand in pyproject.toml:

    blender -b --factory-startup --python tests/in_blender.py -- SCRIPT [ARGUMENT...]

Blender gives a script neither its own folder nor PYTHONPATH to import from.
"""
import runpy
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def main() -> None:
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    sys.path[:0] = [str(ROOT / folder) for folder in settings["tool"]["pytest"]["ini_options"]["pythonpath"]]
    script, *arguments = sys.argv[sys.argv.index("--") + 1:]
    sys.argv[:] = [script, *arguments]
    runpy.run_path(str(ROOT / script), run_name="__main__")


main()
