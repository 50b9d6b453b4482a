"""Builds the libraries of the solver for 64-bit Windows, static, from the sources of which Linux's are built.

native/superbuild runs in the Debian that has the compiler, and its results stay there, below PLACE. The BLAS is
Eigen's, not OpenBLAS: that takes 5 minutes of one core to build, with patches, and Eigen's has no threads that start
while a module is loaded. It does not choose its code by the processor. In seconds of one core under Wine, with Eigen's
and with OpenBLAS's kernels for Haswell: whole solves of 10,000, 100,000 and 300,000 unknowns 0.05 and 0.05, 0.98 and
0.79, 3.9 and 2.8, factorizations of the last two 0.69 and 0.39, 1.95 and 1.13. On Linux the whole solve of 100,000
takes 0.63. The solver's tests need GoogleTest, which is built too.
"""
import shutil
from pathlib import Path

from debian import Suite
from matrix import inside
from static_libraries import PACKAGES, SUPERBUILD, make_libraries, run

ROOT = Path(__file__).resolve().parent.parent
PLACE = "libraries"  # of all this in the root
COMPILER = "x86_64-w64-mingw32ucrt"
TOOLCHAIN = ROOT / "native/cmake/windows.cmake"


class Workshop:
    """The folder of a place in a root where sources are built, seen from outside."""

    def __init__(self, root: Path, place: str = PLACE) -> None:
        self.root, self.prefix = root, root / place
        self.work = self.prefix / "work"

    def named(self, path: Path) -> str:
        """A path as it is called in the root."""
        return f"/{path.relative_to(self.root)}"

    def run(self, *command: str | Path) -> None:
        run(*inside(self.root, *(self.named(part) if isinstance(part, Path) else part for part in command)))

    def source(self, suite: Suite, package: str) -> Path:
        return suite.source(package, self.work)

    def cmake(self, source: Path, target: str, *options: str, flags: str | None = None) -> Path:
        """Builds a target; flags stand in place of the toolchain's."""
        build = source.with_name(source.name + "-build")
        given = [f"-DCMAKE_{language}_FLAGS={flags}" for language in ("C", "CXX")] if flags else []
        self.run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 f"--toolchain=/{PLACE}/{TOOLCHAIN.name}", "-DCMAKE_C_COMPILER_LAUNCHER=ccache",
                 "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", f"-DCMAKE_INSTALL_PREFIX=/{PLACE}", *given, *options)
        self.run("cmake", "--build", build, "--target", target)
        return build


def windows_libraries(root: Path) -> Path:
    """The folder with lib/ and include/ in the root; builds it where there is none of this recipe."""
    shop = Workshop(root)

    def build(_suite: Suite, work: Path) -> None:
        shutil.copytree(root / "usr/src/googletest", work / "googletest")
        shutil.copytree(SUPERBUILD, work / "superbuild")
        shutil.copy(TOOLCHAIN, shop.prefix)
        shop.cmake(work / "superbuild", "install", f"-DREFLINES_SOURCES={shop.named(work)}")

    return make_libraries(shop.prefix, [Path(__file__), TOOLCHAIN], [*PACKAGES, "eigen3"], build)
