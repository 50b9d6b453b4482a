"""Walks at random through Blender in a window, with the add-on installed as a user has it, so that it is reinstalled on
the way; the last line is "N passed, N failed, N skipped".

    tests/walk.py [STEPS [SEED]]
"""
import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from suites import ROOT, Counts, run_reporting, script_options, window_command

NAME = "reflection_lines"
SLOWEST_STEP = 10  # seconds in the mean, on a machine with other work


def installed(user: Path) -> dict[str, str]:
    """Installs the built add-on among a new user's settings; returns the environment of Blender and the tests."""
    folder = user / "scripts/addons" / NAME
    shutil.copytree(ROOT / "addon", folder, ignore=shutil.ignore_patterns("__pycache__"))
    return os.environ | {"BLENDER_USER_RESOURCES": str(user), "XDG_CACHE_HOME": str(user / "cache"),
                         "REFLINES_ADDON": NAME, "REFLINES_FOLDER": str(folder), "LIBGL_ALWAYS_SOFTWARE": "1"}


def walk(steps: int, seed: int) -> Counts:
    with tempfile.TemporaryDirectory() as user:
        env = installed(Path(user)) | {"REFLINES_WALK": str(steps), "REFLINES_SEED": str(seed)}
        command = [*window_command(800, 600), *script_options("tests/ui/test_random_walk.py")]
        return run_reporting(command, env, 120 + SLOWEST_STEP * steps)


def main() -> int:
    parser = argparse.ArgumentParser(prog="./run walk", description=__doc__)
    parser.add_argument("steps", nargs="?", type=int, default=2000)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    arguments = parser.parse_args()
    total = walk(arguments.steps, arguments.seed)
    print(total)
    return 0 if total.failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
