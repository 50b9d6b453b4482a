"""Builds the libraries that go into the package: those of native/superbuild, from Debian's sources, and OpenBLAS.

Debian's own archives will not do: those of SuiteSparse are not position independent, METIS and OpenSubdiv have none.
OpenBLAS's archive is fit and is taken as it is, with kernels for every x86-64 processor. The solver asks BLAS for one
thread (same input, same bits), but the serial archive will not do: it locks nothing, and of 180 solves in threads that
overlapped 7 came out wrong and one failed. Two and a half minutes on two idle cores; kept in the cache folder, and
built anew when the superbuild or this file has changed.
"""
import hashlib
import shutil
import subprocess
from collections.abc import Callable, Iterable
from pathlib import Path

from debian import BUILT_WITH, CACHE, Suite

SUPERBUILD = Path(__file__).resolve().parent.parent / "native/superbuild"
PREFIX = CACHE / "static"
PACKAGES = ("metis", "suitesparse", "opensubdiv")  # of sources


def run(*command: str | Path) -> None:
    """Runs a command in silence; raises with the end of what it said where it fails."""
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))[:500]} ...: {result.stdout[-3000:]}")


def make_libraries(prefix: Path, made_by: Iterable[Path], packages: Iterable[str],
                   build: Callable[[Suite, Path], None]) -> Path:
    """The prefix with lib/ and include/; builds it from sources of packages where it has none of this recipe."""
    stamp, files = prefix / "done", [*sorted(SUPERBUILD.iterdir()), Path(__file__), *made_by]
    recipe = hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()
    if stamp.exists() and stamp.read_text() == recipe:
        return prefix
    shutil.rmtree(prefix, ignore_errors=True)
    suite, work = Suite(BUILT_WITH), prefix / "work"
    suite.update()
    for package in packages:
        suite.source(package, work)
    build(suite, work)
    shutil.rmtree(work)
    stamp.write_text(recipe)
    return prefix


def build(suite: Suite, work: Path) -> None:
    run("cmake", "-S", SUPERBUILD, "-B", work / "superbuild", "-G", "Ninja", f"-DREFLINES_SOURCES={work}",
        f"-DCMAKE_INSTALL_PREFIX={PREFIX}")
    run("cmake", "--build", work / "superbuild", "--target", "install")
    suite.unpack(["libopenblas-pthread-dev"], work / "openblas")
    shutil.copy(next((work / "openblas").rglob("libopenblasp-r*.a")), PREFIX / "lib/libopenblas.a")
    for header in (work / "openblas").rglob("*.h"):
        shutil.copy(header, PREFIX / "include")


def static_libraries() -> Path:
    return make_libraries(PREFIX, [], PACKAGES, build)
