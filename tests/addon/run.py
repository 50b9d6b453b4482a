"""Runs the tests of this folder inside Blender, with the add-on installed and enabled as a user has it.

    blender -b --factory-startup --python tests/in_blender.py -- tests/addon/run.py [pytest arguments]

Debian's Blender uses the system's Python, so the system's pytest is at hand.
"""
import sys
from pathlib import Path

import pytest

import installation

HERE = Path(__file__).resolve().parent


def reason(report: pytest.TestReport) -> str:
    """The first line of what a failed test raised, as far as pytest knows it."""
    crash = getattr(report.longrepr, "reprcrash", None)
    return (crash.message if crash else str(report.longrepr)).strip().partition("\n")[0]


class Counter:
    """Prints what the test suites read: a line for each failed test, and the line of counts."""

    def pytest_terminal_summary(self, terminalreporter: object) -> None:
        stats = terminalreporter.stats
        failed = [*stats.get("failed", []), *stats.get("error", [])]
        for report in failed:
            terminalreporter.write_line(f"FAILED {report.nodeid}: {reason(report)}")
        terminalreporter.write_line(f"{len(stats.get('passed', []))} passed, {len(failed)} failed, "
                                    f"{len(stats.get('skipped', []))} skipped")


def main() -> None:
    installation.install()
    options = ["-q", "-rs", "-p", "no:cacheprovider", "--rootdir", str(HERE)]
    code = pytest.main([*options, *(sys.argv[1:] or [str(HERE)])], plugins=[Counter()])
    sys.exit(int(code))


main()
