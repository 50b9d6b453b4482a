"""Runs the tests of this folder inside Blender, with the add-on installed and enabled as a user has it.

    blender -b --factory-startup --python tests/in_blender.py -- tests/addon/run.py [pytest arguments]

Debian's Blender uses the system's Python, so the system's pytest is at hand.
"""
import sys
from pathlib import Path

import pytest

import installation

HERE = Path(__file__).resolve().parent


class Counter:
    """Prints the one line that the test lanes read."""

    def pytest_terminal_summary(self, terminalreporter: object) -> None:
        stats = terminalreporter.stats
        failed = len(stats.get("failed", [])) + len(stats.get("error", []))
        terminalreporter.write_line(f"{len(stats.get('passed', []))} passed, {failed} failed, "
                                    f"{len(stats.get('skipped', []))} skipped")


def main() -> None:
    installation.install()
    options = ["-q", "-rs", "-p", "no:cacheprovider", "--rootdir", str(HERE)]
    code = pytest.main([*options, *(sys.argv[1:] or [str(HERE)])], plugins=[Counter()])
    sys.exit(int(code))


main()
