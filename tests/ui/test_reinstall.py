"""Installing the add-on over itself, seven times in one session of Blender: it goes on working and ends well."""
import os
import subprocess
import time
from collections.abc import Generator
from pathlib import Path
from tempfile import TemporaryDirectory

import bpy

import installation
import window

IN_BLENDER = installation.ROOT / "tests/in_blender.py"
PATIENCE = 300.0  # seconds


def session(rounds: int, user: Path, log: Path, **env: str) -> Generator[float, None, int]:
    """Runs reinstalling.py in a Blender of its own; its exit code, negative where a signal ended it."""
    settings = {name: value for name, value in os.environ.items() if not name.startswith("BLENDER_USER_")}
    settings |= {"BLENDER_USER_RESOURCES": str(user), "XDG_CACHE_HOME": str(user / "cache")} | env
    command = [bpy.app.binary_path, "--factory-startup", "--window-geometry", "0", "0", "800", "600",
               "--python-exit-code", "1", "--python", str(IN_BLENDER), "--", "tests/ui/reinstalling.py", str(rounds),
               str(installation.FOLDER)]
    with log.open("w") as output:
        child = subprocess.Popen(command, env=settings, stdout=output, stderr=subprocess.STDOUT)
    end = time.monotonic() + PATIENCE
    while child.poll() is None and time.monotonic() < end:
        yield 0.2
    if child.poll() is None:
        child.kill()
    return child.wait()


def goes_well(rounds: int, user: Path, **env: str) -> Generator[float, None, None]:
    code = yield from session(rounds, user, user / "log", **env)
    said = (user / "log").read_text()
    assert code == 0 and "all rounds done" in said and "Traceback" not in said, f"exit code {code}: {said[-3000:]}"


def test_over_itself_seven_times(driver: window.Window) -> Generator[float, None, None]:
    """The same build and another, each after one that was used, unused, and switched off and on. And each of the two
    has one copy in the cache, however often it was loaded."""
    with TemporaryDirectory() as name:
        yield from goes_well(7, Path(name))
        kept = sorted(path.name for path in Path(name, "cache/reflection_lines/library").glob("*/*"))
        assert len(kept) == 2 and len(set(kept)) == 1, kept


def test_over_itself_where_the_cache_cannot_be_written(driver: window.Window) -> Generator[float, None, None]:
    with TemporaryDirectory() as name:
        cache = Path(name, "not a folder")
        cache.write_bytes(b"")
        Path(name, "tmp").mkdir()
        yield from goes_well(3, Path(name), XDG_CACHE_HOME=str(cache), TMPDIR=str(Path(name, "tmp")))
