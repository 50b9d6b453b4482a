"""Runs the test suites and adds their counts up; the last line is always "N passed, N failed, N skipped".

A suite is one way of running tests: native executables, Python without Blender, Blender in the background, Blender in a
window, the rules of the house, an installed package in other Debians. A suite that crashes before its counts are read
counts as one failure. Each failed test is named by a line "FAILED name: why" where it fails, and once more at the end,
below what hundreds of other tests print.

REFLINES_ADDON names an installed add-on, REFLINES_FOLDER its place: then the suites test that one, and build nothing.
"""
import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "build" / "tests"
PYTHON = "/usr/bin/python3"
BLENDER = "/usr/bin/blender"
INSTALLED = "REFLINES_ADDON" in os.environ
COUNTS_LINE = re.compile(r"(\d+) passed, (\d+) failed, (\d+) skipped\s*")
FAILED_LINE = re.compile(r"((?:\w+: )?)FAILED (.+)")  # tests that run beside others have a mark before it
FAILED_BEFORE = re.compile(r"== failed: (.+)")  # those of a whole suite, at its end


@dataclass(frozen=True)
class Counts:
    passed: int = 0
    failed: int = 0
    skipped: int = 0
    failures: tuple[str, ...] = ()  # what is known of those that failed: "name: why"

    def __add__(self, other: "Counts") -> "Counts":
        return Counts(self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped,
                      self.failures + other.failures)

    def __str__(self) -> str:
        return f"{self.passed} passed, {self.failed} failed, {self.skipped} skipped"


AT_ONCE = 3  # suites: one of windows, which mostly waits, and two of one process each
SECOND_TRIES = 3  # Blenders with window tests that are run once more; where more of them fail it is no chance
NO_ARCHIVE = 75  # how .ci/package.py ends where Debian's archive cannot be had


def failed_test(case: ElementTree.Element) -> str | None:
    """The name of a failed test of a JUnit file and the first line of its message; None where it did not fail."""
    for kind in ("failure", "error"):
        found = case.find(kind)
        if found is not None:
            why = (found.get("message") or found.text or kind).strip().splitlines()
            return f"{case.get('classname')}.{case.get('name')}: {why[0] if why else kind}"
    return None


def junit_counts(path: Path) -> Counts:
    """The counts of a JUnit file, as both CTest and pytest write it; prints the failed tests."""
    cases = list(ElementTree.parse(path).getroot().iter("testcase"))
    failures = tuple(what for what in map(failed_test, cases) if what is not None)
    print(*(f"FAILED {what}\n" for what in failures), sep="", end="", flush=True)
    idle = ("notrun", "disabled")
    skipped = sum(1 for case in cases if case.find("skipped") is not None or case.get("status") in idle)
    return Counts(len(cases) - len(failures) - skipped, len(failures), skipped, failures)


def crashed(what: str) -> Counts:
    """One failure of tests that did not come to be counted; prints it as that of a test."""
    print(f"FAILED {what}", flush=True)
    return Counts(failed=1, failures=(what,))


def judged(counts: Counts, code: int, what: str) -> Counts:
    """A non-zero exit without a counted failure is a failure all the same."""
    if code != 0 and counts.failed == 0:
        return counts + crashed(f"{what}: exit code {code} although no test is counted as failed")
    return counts


def run_with_junit(command: Sequence[str], report: Path, env: dict[str, str] | None = None,
                   timeout: int = 2700) -> Counts:
    """Runs a command that writes a JUnit report."""
    report.parent.mkdir(parents=True, exist_ok=True)
    report.unlink(missing_ok=True)
    try:
        code = subprocess.run(command, cwd=ROOT, env=env, timeout=timeout).returncode
    except subprocess.TimeoutExpired:
        return crashed(f"{command[0]}: no end after {timeout} s")
    if not report.is_file():
        return crashed(f"{command[0]}: exit code {code} and no report")
    return judged(junit_counts(report), code, command[0])


def pytest_suite(tests: str) -> Counts:
    """Runs a folder of tests, or one file of them."""
    env = os.environ | {"PYTHONPATH": os.environ.get("REFLINES_FOLDER", str(ROOT / "addon"))}
    report = OUT / f"{Path(tests).stem}.xml"
    command = [PYTHON, "-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", f"--junitxml={report}", f"tests/{tests}"]
    return run_with_junit(command, report, env)


def native_suite(preset: str = "native", env: dict[str, str] | None = None) -> Counts:
    """Runs the native tests of a test preset of CMakePresets.json, each in a process of its own."""
    return run_with_junit(["ctest", "--preset", preset], OUT / f"ctest_{preset}.xml", env, timeout=7200)


def blender_environment(user: str = "blender_user") -> dict[str, str]:
    """A Blender that sees no user's settings; they start empty each time, those with an installed package apart."""
    if INSTALLED:
        return os.environ | {"LIBGL_ALWAYS_SOFTWARE": "1"}
    user = OUT / user
    shutil.rmtree(user, ignore_errors=True)
    user.mkdir(parents=True)
    return os.environ | {"BLENDER_USER_RESOURCES": str(user), "LIBGL_ALWAYS_SOFTWARE": "1"}


def run_reporting(command: Sequence[str], env: Mapping[str, str], timeout: int, mark: str = "",
                  failed: re.Pattern[str] = FAILED_LINE) -> Counts:
    """Runs tests that print the line of counts themselves, as those inside Blender do; shows what they print, each line
    with a mark where others run beside them."""
    process = subprocess.Popen(command, cwd=ROOT, env=env, text=True, errors="replace", stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True)
    watch = threading.Timer(timeout, os.killpg, (process.pid, signal.SIGKILL))
    watch.start()
    counts, failures = None, []
    for line in process.stdout:
        print(mark + line, end="", flush=True)
        found, failure = COUNTS_LINE.fullmatch(line), failed.match(line)
        counts = Counts(*map(int, found.groups())) if found else counts
        failures += [mark + "".join(failure.groups())] if failure else []
    code = process.wait()
    watch.cancel()
    name = mark.removesuffix(": ") or command[-1]
    if counts is None or code == -signal.SIGKILL:
        why = "no line of counts" if counts is None else f"stopped after {timeout} s"
        return Counts(failures=tuple(failures)) + crashed(f"{name}: exit code {code}, {why}")
    return judged(replace(counts, failures=tuple(failures)), code, name)


def script_options(script: str) -> list[str]:
    """Options that make Blender run a script of the project with the import paths of pyproject.toml."""
    return ["--python-exit-code", "1", "--python", "tests/in_blender.py", "--", script]


def addon_suite(*files: str) -> Counts:
    """Runs the tests in background Blender: these files, or all."""
    command = [BLENDER, "-b", "--factory-startup", *script_options("tests/addon/run.py"), *files]
    return run_reporting(command, blender_environment(), 1800)


def window_command(width: int = 1280, height: int = 900, display: int = 99) -> list[str]:
    """On a virtual screen: the first one that is free from `display` on."""
    return ["xvfb-run", "-n", str(display), "-a", "-s", f"-screen 0 {width}x{height}x24", BLENDER, "--factory-startup",
            "--enable-event-simulate", "--window-geometry", "0", "0", str(width), str(height)]


# Files of window tests that leave nothing to each other: one Blender starts for them. Those that take longest begin.
TOGETHER = (
    ("reinstall",),
    ("hostile",),
    ("drag", "drag_meshes", "drag_tools", "draw_nearest", "drawn_lines", "handle_gizmos"),
    ("compare", "check", "stripe_modes", "stripes_edit", "look_through", "toolbar"),
    ("borders", "buttons", "light", "menus", "panels"),
    ("bake_handles", "follow_selected_edges", "inspect", "redo", "sidebar"),
    ("stripes", "stripes_cages", "shut_lines"),
    ("fair_brush", "long_press", "quad_view", "drag_lost"),
    ("several_panels", "pull_line", "sample_tabs", "help"),
    ("stripes_stay", "live_warp", "drag_over_drag", "disabled"),
)


def window_counts(index: int, files: Sequence[Path]) -> Counts:
    """Runs files of window tests in one Blender."""
    names = [str(path.relative_to(ROOT)) for path in files]
    script = script_options(names[0]) if len(names) == 1 else [*script_options("tests/ui/several.py"), *names]
    mark = files[0].stem if len(files) == 1 else f"{files[0].stem} and {len(files) - 1} more"
    size = (1280, 900) if files[0].stem == "test_first_screen" else (800, 600)
    return run_reporting([*window_command(*size, 100 + 20 * index), *script],
                         blender_environment(f"blender_user_{files[0].stem}"), 300 * (len(files) + 1), f"{mark}: ")


def group_window_tests() -> list[list[Path]]:
    """Returns the files of window tests that run in one Blender; those that take longest first."""
    files = {path.stem.removeprefix("test_"): path for path in sorted((ROOT / "tests/ui").glob("test_*.py"))}
    groups = [[files.pop(name) for name in group] for group in TOGETHER]
    return groups + [[path] for path in files.values()]


def ui_suite() -> Counts:
    """Window tests on virtual screens, with simulated mouse and keys; one Blender more than there are cores, for
    most of their time they wait."""
    groups = group_window_tests()
    with ThreadPoolExecutor(min(4, 1 + (os.cpu_count() or 1))) as pool:
        found = list(pool.map(window_counts, range(len(groups)), groups))
    return sum(try_again(found, lambda index: window_counts(index, groups[index])), Counts())


def try_again(found: Sequence[Counts], run: Callable[[int], Counts]) -> list[Counts]:
    """Runs the few that failed once more, alone, and names those that pass then. Real windows are slow where others
    work beside them: of 213 window tests in three Debians one failed so, and a second run of its file was green.
    """
    again = [index for index, counts in enumerate(found) if counts.failed]
    if len(again) > SECOND_TRIES:
        return list(found)
    second = {index: run(index) for index in again}
    for index, counts in second.items():
        if not counts.failed:
            print(*(f"== unsteady, green alone: {what}" for what in found[index].failures), sep="\n", flush=True)
    return [second.get(index, counts) for index, counts in enumerate(found)]


def hostile_suite() -> Counts:
    """Runs those tests of other suites whose scenes, files and arguments are hostile on purpose."""
    addon = [f"tests/addon/test_{name}.py" for name in ("hostile_scenes", "hostile_files", "tampered")]
    return (pytest_suite("bindings/test_hostile.py") + addon_suite(*addon)
            + window_counts(0, [ROOT / "tests/ui/test_hostile.py"]))


def rooted_suite(*script: str) -> Counts:
    """Runs a script that works in other Debians, which takes root."""
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    become_root = [] if os.geteuid() == 0 else ["sudo", f"XDG_CACHE_HOME={cache}"]
    return run_reporting([*become_root, PYTHON, *script], os.environ, 4500)


def packed_suite(*script: str) -> Counts:
    """Packs the add-on and runs a script that tests the package in other Debians."""
    packed = subprocess.run(["./run", "package", "linux"], cwd=ROOT).returncode
    if packed == NO_ARCHIVE:
        return Counts(skipped=1)
    if packed != 0:
        return crashed("there is no package to test")
    return rooted_suite(*script)


@dataclass(frozen=True)
class Suite:
    run: Callable[[], Counts]
    built: bool               # needs the native build
    folders: tuple[str, ...]  # a change below one of these calls for the suite
    asked: bool = False       # runs only when it is asked for, by its name or by --all
    within: bool = False      # its tests are those of other suites, so that --all leaves it out


def sanitizers_suite(kind: str) -> Counts:
    return run_reporting([PYTHON, "tests/sanitizers.py", kind], os.environ, 10800)


SHARED = ("CMakeLists.txt", "CMakePresets.json", "tests/suites.py", "run", ".ci/")
SUITES = {
    "rules": Suite(lambda: pytest_suite("rules"), False, ("",)),
    "native": Suite(native_suite, True, ("native/", "tests/native/", *SHARED)),
    "bindings": Suite(lambda: pytest_suite("bindings"), True, ("native/", "tests/bindings/", *SHARED)),
    "addon": Suite(addon_suite, True, ("native/", "addon/", "tests/addon/", "blend_samples/", *SHARED)),
    "ui": Suite(ui_suite, True, ("addon/", "tests/ui/", *SHARED)),
    "hostile": Suite(hostile_suite, True, (), asked=True, within=True),
    "matrix": Suite(lambda: packed_suite(".ci/matrix.py"), False, (), asked=True),
    "release": Suite(lambda: packed_suite(".ci/release.py", "--test"), False, (), asked=True),
    "windows": Suite(lambda: rooted_suite(".ci/windows.py"), True, (), asked=True),
    "asan": Suite(lambda: sanitizers_suite("asan"), False, (), asked=True),
    "tsan": Suite(lambda: sanitizers_suite("tsan"), False, (), asked=True),
    "fuzz": Suite(lambda: sanitizers_suite("fuzz"), False, (), asked=True),
}


def git_lines(*arguments: str) -> list[str]:
    return subprocess.run(["git", *arguments], cwd=ROOT, text=True, stdout=subprocess.PIPE).stdout.splitlines()


def changed_files() -> list[str]:
    """Files that differ from where this branch left main, uncommitted ones among them."""
    base = git_lines("merge-base", "HEAD", "main") or ["HEAD"]
    return git_lines("diff", "--name-only", base[0]) + git_lines("ls-files", "--others", "--exclude-standard")


def chosen_suites(arguments: argparse.Namespace) -> list[str]:
    present = [name for name in SUITES if SUITES[name].asked or (ROOT / "tests" / name).is_dir()]
    unknown = [name for name in arguments.suites if name not in present]
    if unknown:
        sys.exit(f"no test suite {', '.join(unknown)}; there are {', '.join(present)}")
    if arguments.changed:
        files = changed_files()
        return [name for name in present if any(file.startswith(SUITES[name].folders) for file in files)]
    return arguments.suites or [name for name in present if not SUITES[name].asked
                                or arguments.all and not SUITES[name].within]


def succeeds(*command: str) -> bool:
    return subprocess.run(command, cwd=ROOT).returncode == 0


def configured() -> bool:
    return (ROOT / "build/release/build.ninja").is_file() or succeeds("cmake", "--preset", "release")


def run_suite(name: str, *, built: bool) -> Counts:
    print(f"== {name}", flush=True)
    start = time.monotonic()
    if SUITES[name].built and not built:
        counts = crashed(f"{name}: the native build failed, so this suite cannot run")
    else:
        counts = SUITES[name].run()
    print(f"== {name}: {counts} ({time.monotonic() - start:.0f} s)", flush=True)
    return counts


def run_beside(name: str) -> Counts:
    """Runs a suite in a process of its own, whose lines are marked with its name. Threads that wait for others of their
    process sleep: those that spin kept the others from running, and a test took 220 s beside other suites, 15 s alone.
    """
    env = os.environ | {"OMP_WAIT_POLICY": "passive"}
    return run_reporting([PYTHON, __file__, name, "--built"], env, 4500, f"{name}: ", FAILED_BEFORE)


def run_suites(names: Sequence[str], *, built: bool = False) -> Counts:
    """Runs suites: those of every day at once, longest first, then those that are asked for, one after the other."""
    if not built:
        built = INSTALLED or configured()  # the rules read the compile commands
        if not INSTALLED and any(SUITES[name].built for name in names):
            built = built and succeeds("cmake", "--build", "--preset", "release")
    beside = [name for name in reversed(names) if not SUITES[name].asked]
    beside = beside if built and not INSTALLED and len(beside) > 1 else []
    with ThreadPoolExecutor(AT_ONCE) as pool:
        total = sum(pool.map(run_beside, beside), Counts())
    return sum((run_suite(name, built=built) for name in names if name not in beside), total)


def main() -> int:
    parser = argparse.ArgumentParser(prog="./run test", description=__doc__)
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=", ".join(SUITES))
    parser.add_argument("--changed", action="store_true", help="only the suites that changes touch")
    parser.add_argument("--all", action="store_true", help="with the suites that otherwise run only by name: matrix, "
                                                              "release, windows, asan, tsan, fuzz")
    parser.add_argument("--built", action="store_true", help="the native build is as it should be")
    arguments = parser.parse_args()
    total = run_suites(chosen_suites(arguments), built=arguments.built)
    print(*(f"== failed: {what}\n" for what in total.failures), sep="", end="")
    print(total)
    return 0 if total.failed == 0 and total.passed + total.skipped > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
