"""Builds the solver for 64-bit Windows, in a Debian with the compiler for it, and runs its native tests under Wine.

Then the Python module is linked for each Python that Blender for Windows embeds, and looked into: it may ask for
Windows's own libraries and Python's only, and show nothing but its entry point. Each is loaded under Wine by a CPython
for Windows of its version, which is built here too, and the binding tests run against it. Nothing loads them in Blender
for Windows. A warning of the compiler is a failure. The root is kept in the cache folder, with the solver's libraries
in it. Needs root.

    .ci/windows.py [--modules FOLDER]

--modules: builds the modules only, without tests, and puts them into a folder, for .ci/package.py.
"""
import argparse
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from debian import Unavailable, output
from matrix import ROOT, inside, ready_root
from windows_bindings import TOOLS, test_bindings
from windows_interpreter import ready_interpreter
from windows_libraries import COMPILER, windows_libraries
from windows_libraries import PLACE as LIBRARIES
from windows_python import PLACE as PYTHONS
from windows_python import SUITES as PYTHON_SUITES
from windows_python import ready_python

sys.path.insert(0, str(ROOT / "tests"))

from suites import Counts, crashed, junit_counts  # noqa: E402  (found through the line above)

SUITE = "trixie"  # the first that has this compiler
SOURCES = ("native", "tests", "blend_samples", ".ci/package", ".ci/wine", "CMakeLists.txt", "CMakePresets.json",
           "pyproject.toml")
BUILD = "src/build/windows"
REPORTS = "src/build/tests"
WINE = {"WINEDEBUG": "-all", "WINEPREFIX": "/tmp/wine"}
OWN_LIBRARIES = re.compile(r"KERNEL32\.dll|api-ms-win-crt-[a-z]+-l1-1-0\.dll")
LARGEST = 40e6  # bytes of a module


def built(command: list[str]) -> bool:
    """Whether a command ends well and warns of nothing; shows the end of what it says if not."""
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    well = result.returncode == 0 and "warning:" not in result.stdout
    if not well:
        first = max(result.stdout.find("warning:") - 3000, 0)
        print(result.stdout[first:][:5000] if "warning:" in result.stdout else result.stdout[-5000:])
    return well


def ready() -> Path:
    """The root with compiler, libraries, headers and this project's sources."""
    root = ready_root(SUITE, "windows", ("windows", "build", "package"), TOOLS)
    windows_libraries(root)
    for tag in PYTHON_SUITES:
        ready_python(root, tag)
    for name in SOURCES:
        target = root / "src" / name
        shutil.rmtree(target, ignore_errors=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy2)(ROOT / name, target)
    return root


def build(root: Path, targets: Sequence[str]) -> bool:
    """Builds targets; whether without a warning."""
    pythons = [f"{tag}|/{PYTHONS}/{tag}/include" for tag in PYTHON_SUITES]
    given = [f"-DCMAKE_PREFIX_PATH=/{LIBRARIES}", f"-DREFLINES_PACKAGE_PYTHONS={';'.join(pythons)}"]
    configure = ["cmake", "-S", "/src", "--fresh", "--preset", "package-windows", *given]
    make = ["cmake", "--build", f"/{BUILD}", "--target", *targets]
    return built(inside(root, *configure)) and built(inside(root, *make))


def run_tests(root: Path) -> Counts:
    """Runs each program of native tests under Wine; one that leaves no report counts as one failure."""
    shutil.rmtree(root / REPORTS, ignore_errors=True)
    shutil.rmtree(root / WINE["WINEPREFIX"][1:], ignore_errors=True)
    output(*inside(root, "sh", "-c", "wineboot --init && wineserver --wait", env=WINE))
    total = Counts()
    for program in sorted((root / BUILD).glob("test_*.exe")):
        report = root / REPORTS / f"{program.stem}.xml"
        options = ["--gtest_brief=1", f"--gtest_output=xml:Z:/{REPORTS}/{report.name}"]
        command = ["wine", f"/{BUILD}/{program.name}", *options]
        subprocess.run(inside(root, *command, env=WINE), stderr=subprocess.DEVNULL)
        counts = junit_counts(report) if report.is_file() else crashed(f"{program.stem}: no report")
        print(f"{program.stem}: {counts}", flush=True)
        total += counts
    return total


def modules(root: Path) -> list[Path]:
    return sorted((root / BUILD).rglob("reflines.cp*.pyd"))


def faults(root: Path, module: Path) -> Iterator[str]:
    """What is wrong with a module: what it asks for or shows beyond what it may, and its size."""
    tables = output(*inside(root, f"{COMPILER}-objdump", "-p", f"/{module.relative_to(root)}"))
    python = re.sub(r"reflines\.cp(\d+)-.*", r"python\1.dll", module.name)
    needed = set(re.findall(r"DLL Name: (\S+)", tables))
    if strange := sorted(name for name in needed - {python} if not OWN_LIBRARIES.fullmatch(name)):
        yield f"needs {', '.join(strange)}"
    if python not in needed:
        yield f"does not need {python}"
    shown = re.findall(r"^\s+\[ *\d+\] \+base\[ *\d+\]\s+[0-9a-f]+ (\S+)$", tables, re.MULTILINE)
    if shown != ["PyInit_reflines"]:
        yield f"shows {shown[:5]}"
    if module.stat().st_size > LARGEST:
        yield "is too large"


def inspect(root: Path) -> Counts:
    found, total = modules(root), Counts()
    for tag in PYTHON_SUITES:
        if not any(f".cp{tag}-" in module.name for module in found):
            total += crashed(f"windows: no module for CPython {tag}")
    for module in found:
        wrong = list(faults(root, module))
        print(f"{module.name}: {module.stat().st_size / 1e6:.1f} MB, {'; '.join(wrong) or 'as it should be'}")
        total += crashed(f"{module.name}: {wrong[0]}") if wrong else Counts(passed=1)
    return total


def give_modules(root: Path, folder: Path) -> Counts:
    """Builds the modules and copies them where none has a fault."""
    folder.mkdir(parents=True)
    if not build(root, [f"reflines_{tag}" for tag in PYTHON_SUITES]):
        return crashed("windows: the modules cannot be built")
    counts = inspect(root)
    for module in modules(root) if counts.failed == 0 else ():
        shutil.copy(module, folder)
    return counts


def test(root: Path) -> Counts:
    if not build(root, ["all"]):
        return crashed("windows: the build failed")
    total = run_tests(root) + inspect(root)
    for module in modules(root):
        tag = re.search(r"\.cp(\d+)-", module.name)[1]
        total += test_bindings(root, ready_interpreter(root, tag), module, WINE)
    return total


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--modules", type=Path)
    folder = parser.parse_args().modules
    if folder:
        shutil.rmtree(folder, ignore_errors=True)
    try:
        root = ready()
    except Unavailable as reason:
        print(f"skipped, Debian's archive cannot be had: {reason}\n0 passed, 0 failed, 1 skipped")
        return 0
    total = give_modules(root, folder) if folder else test(root)
    print(total)
    return int(total.failed > 0)


if __name__ == "__main__":
    sys.exit(main())
