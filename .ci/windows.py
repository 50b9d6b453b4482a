"""Compiles the solver for 64-bit Windows, in a Debian with the compiler for it: code that only Linux has does not pass.

Nothing is linked and nothing runs: that takes the solver's own libraries built for Windows. A warning is a failure. The
root is kept in the cache folder. Needs root.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

from debian import BUILT_WITH, CACHE, Suite, Unavailable
from matrix import ROOT, inside, ready_root
from static_libraries import static_libraries

SUITE = "trixie"  # the first that has this compiler
SOURCES = ("native", "CMakeLists.txt", "CMakePresets.json")
LIBRARIES = ("CHOLMOD", "UMFPACK", "OPENBLAS", "OSD_CPU")


def cblas(folder: Path) -> None:
    """Puts OpenBLAS's headers of Debian into a folder, as they are where its build is not for Linux."""
    unpacked = CACHE / "windows" / "openblas"
    if not unpacked.is_dir():
        suite = Suite(BUILT_WITH)
        suite.update()
        suite.unpack(["libopenblas-pthread-dev"], unpacked)
    for header in unpacked.rglob("openblas-pthread/*.h"):
        text = re.sub(r"#define OPENBLAS_OS_LINUX.*\n", "", header.read_text())
        (folder / header.name).write_text(text)


def copy_sources(root: Path) -> None:
    place = root / "src"
    for name in SOURCES:
        shutil.rmtree(place / name, ignore_errors=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy2)(ROOT / name, place / name)
    shutil.rmtree(place / "include", ignore_errors=True)
    shutil.copytree(static_libraries() / "include", place / "include")
    cblas(place / "include")


def compile_in(root: Path) -> bool:
    """Whether everything compiles without a warning."""
    given = [*(f"-D{name}=none" for name in LIBRARIES), "-DSUITESPARSE_INCLUDE=/src/include/suitesparse",
             "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O0 -isystem /src/include"]  # no code is wanted
    configure = ["cmake", "-S", "/src", "--preset", "windows", *given]
    build = ["cmake", "--build", "/src/build/windows"]
    said = ""
    for command in (configure, build):
        result = subprocess.run(inside(root, *command), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        said += result.stdout
        if result.returncode != 0 or "warning:" in said:
            print(said[-5000:])
            return False
    return True


def main() -> int:
    try:
        root = ready_root(SUITE, "windows", ("windows", "build"))
        (root / "src").mkdir(exist_ok=True)
        copy_sources(root)
    except Unavailable as reason:
        print(f"skipped, Debian's archive cannot be had: {reason}\n0 passed, 0 failed, 1 skipped")
        return 0
    compiled = compile_in(root)
    print(f"{int(compiled)} passed, {int(not compiled)} failed, 0 skipped")
    return int(not compiled)


if __name__ == "__main__":
    sys.exit(main())
