"""Builds the project with one fault at a time and runs the test that should find it; a fault that passes is a gap in
the tests. The last line is "N passed, N failed, N skipped", where passed counts the faults that were found.

    tests/mutation/run.py [WORD...]    only those whose file, test or name contains one of the words

The faults stand in mutants.toml. They are put into a copy of the project in build/mutation, never into the checkout.
"""
import os
import shutil
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from suites import BLENDER, PYTHON, ROOT, Counts, git_lines, script_options, window_command  # noqa: E402

COPY = ROOT / "build" / "mutation" / "project"
PATIENCE = 900  # seconds of one test; one that does not end has failed


@dataclass(frozen=True)
class Mutant:
    what: str
    file: str
    old: str
    new: str
    test: str


def read_mutants(words: list[str]) -> list[Mutant]:
    listed = tomllib.loads((Path(__file__).parent / "mutants.toml").read_text())["mutant"]
    mutants = [Mutant(**entry) for entry in listed]
    return [each for each in mutants
            if not words or any(word in f"{each.file} {each.test} {each.what}" for word in words)]


def copy_project() -> None:
    """Files that are as they were keep their times, so that they are not built again."""
    for name in git_lines("ls-files", "--cached", "--others", "--exclude-standard"):
        source, target = ROOT / name, COPY / name
        if not source.is_file() or target.is_file() and target.read_bytes() == source.read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)


def take_sound_module() -> None:
    """The Python module as it is built in the checkout, in the place of one with a fault."""
    for module in (ROOT / "addon").glob("reflines*.so"):
        shutil.copyfile(module, COPY / "addon" / module.name)


def environment() -> dict[str, str]:
    user = COPY / "build/blender_user"
    shutil.rmtree(user, ignore_errors=True)
    user.mkdir(parents=True)
    return os.environ | {"PWD": str(COPY),  # by which Blender resolves relative paths
                         "PYTHONPATH": str(COPY / "addon"), "BLENDER_USER_RESOURCES": str(user),
                         "XDG_CACHE_HOME": str(user / "cache"), "LIBGL_ALWAYS_SOFTWARE": "1",
                         "CCACHE_BASEDIR": str(COPY), "CCACHE_NOHASHDIR": "1"}


def runs(command: list[str], log: Path) -> bool:
    with log.open("w") as output:
        try:
            return subprocess.run(command, cwd=COPY, env=environment(), stdout=output, stderr=subprocess.STDOUT,
                                  timeout=PATIENCE).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def builds(test: str, log: Path, *, module: bool) -> bool:
    """Builds what a test needs; the Python module only where that is to be another than the checkout's."""
    if not module and not test.startswith("tests/native/"):
        take_sound_module()
        return True
    target = f"test_{Path(test).name}" if test.startswith("tests/native/") else "reflines_python"
    configured = (COPY / "build/release/build.ninja").is_file() or runs(["cmake", "--preset", "release"], log)
    return configured and runs(["cmake", "--build", "--preset", "release", "--target", target], log)


def command_of(test: str) -> list[str]:
    kind, name = test.split("/")[1:3]
    if kind == "native":
        return [f"build/release/test_{name}"]
    if kind == "bindings":
        return [PYTHON, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", test]
    if kind == "addon":
        return [BLENDER, "-b", "--factory-startup", *script_options("tests/addon/run.py"), test]
    return [*window_command(800, 600), *script_options(test)]


def judge(mutant: Mutant) -> str:
    """Puts the fault in, builds, runs the test, takes the fault out; says what is wrong, nothing where it was found."""
    path, log = COPY / mutant.file, COPY / "build" / "mutation.log"
    sound = path.read_text()
    if sound.count(mutant.old) != 1:
        return f"stands {sound.count(mutant.old)} times in {mutant.file}"
    path.write_text(sound.replace(mutant.old, mutant.new))
    try:
        if not builds(mutant.test, log, module=mutant.file.startswith("native/")):
            return f"does not build, see {log}"
        return f"SURVIVED {mutant.test}" if runs(command_of(mutant.test), log) else ""
    finally:
        path.write_text(sound)


@cache
def is_sound(test: str) -> bool:
    """Whether a test passes without a fault: another finds none."""
    log = COPY / "build" / "sound.log"
    sound = builds(test, log, module=False) and runs(command_of(test), log)
    if not sound:
        print(f"{test} fails without a fault:\n{log.read_text()[-3000:]}", flush=True)
    return sound


def main() -> int:
    mutants = read_mutants(sys.argv[1:])
    copy_project()
    (COPY / "build").mkdir(exist_ok=True)
    found = 0
    for mutant in mutants:
        start = time.monotonic()
        wrong = judge(mutant) if is_sound(mutant.test) else f"{mutant.test} fails without it"
        found += not wrong
        print(f"{mutant.what} ({mutant.file}): {wrong or 'found'} ({time.monotonic() - start:.0f} s)", flush=True)
    print(Counts(found, len(mutants) - found, 0))
    return 0 if found == len(mutants) and mutants else 1


if __name__ == "__main__":
    sys.exit(main())
