"""Builds the libraries of the solver for 64-bit Windows, static, from the sources of which Linux's are built.

The build runs in the Debian that has the compiler, and its results stay there, below PLACE. The BLAS is Eigen's, not
OpenBLAS: that takes 5 minutes of one core to build, with patches, and Eigen's has no threads that start while a module
is loaded. It does not choose its code by the processor. In seconds of one core under Wine, with Eigen's and with
OpenBLAS's kernels for Haswell: whole solves of 10,000, 100,000 and 300,000 unknowns 0.05 and 0.05, 0.98 and 0.79, 3.9
and 2.8, factorizations of the last two 0.69 and 0.39, 1.95 and 1.13. On Linux the whole solve of 100,000 takes 0.63.
The solver's tests need GoogleTest, which is built too.

Windows promises 16 bytes of alignment on the stack, and this compiler keeps no more: what it keeps there of AVX is
moved by instructions that take any address.
"""
import hashlib
import os
import re
import shutil
import subprocess
from pathlib import Path

from debian import BUILT_WITH, Suite
from matrix import inside
from static_libraries import OPENSUBDIV_OFF, SUITESPARSE

ROOT = Path(__file__).resolve().parent.parent
PLACE = "libraries"  # of all this in the root
COMPILER = "x86_64-w64-mingw32ucrt"
TOOLCHAIN = ROOT / "native/cmake/windows.cmake"
FLAGS = "-O3 -w -Wa,-muse-unaligned-vector-move"
BLAS_BUILD = """cmake_minimum_required(VERSION 3.25)
project(blas LANGUAGES CXX)
add_library(blas STATIC ../blas/double.cpp ../blas/complex_double.cpp ../blas/xerbla.cpp
  ../lapack/double_cholesky.cpp ../lapack/complex_double_cholesky.cpp)
target_include_directories(blas PRIVATE .. ../blas ../lapack)
install(TARGETS blas)
"""


class Workshop:
    """The folder of a place in a root where sources are built, seen from outside."""

    def __init__(self, root: Path, place: str = PLACE) -> None:
        self.root, self.prefix = root, root / place
        self.work = self.prefix / "work"

    def named(self, path: Path) -> str:
        """A path as it is called in the root."""
        return f"/{path.relative_to(self.root)}"

    def run(self, *command: str | Path) -> None:
        named = [self.named(part) if isinstance(part, Path) else part for part in command]
        result = subprocess.run(inside(self.root, *named), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if result.returncode != 0:
            raise RuntimeError(f"{' '.join(named[:5])} ...: {result.stdout[-3000:]}")

    def source(self, suite: Suite, package: str) -> Path:
        return suite.source(package, self.work)

    def cmake(self, source: Path, target: str, *options: str, flags: str = FLAGS) -> Path:
        build = source.with_name(source.name + "-build")
        self.run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 f"--toolchain=/{PLACE}/{TOOLCHAIN.name}", f"-DCMAKE_C_FLAGS={flags}", f"-DCMAKE_CXX_FLAGS={flags}",
                 "-DCMAKE_C_COMPILER_LAUNCHER=ccache", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache",
                 f"-DCMAKE_INSTALL_PREFIX=/{PLACE}", "-DCMAKE_POLICY_VERSION_MINIMUM=3.5", *options)
        self.run("cmake", "--build", build, "--target", target)
        return build


def opensubdiv(shop: Workshop, suite: Suite) -> None:
    source = shop.source(suite, "opensubdiv")
    options = [f"-DNO_{part}=ON" for part in OPENSUBDIV_OFF]
    build = shop.cmake(source, "osd_static_cpu", "-DBUILD_SHARED_LIBS=OFF", *options)
    shutil.copy(next(build.rglob("libosdCPU.a")), shop.prefix / "lib")
    no_headers = shutil.ignore_patterns("*.cpp", "*.glsl")
    shutil.copytree(source / "opensubdiv", shop.prefix / "include/opensubdiv", ignore=no_headers)


def metis(shop: Workshop, suite: Suite) -> Path:
    """METIS with random numbers of its own: Windows's have 15 bits."""
    source = shop.source(suite, "metis")
    (source / "GKlib/sys").mkdir()
    (source / "GKlib/sys/resource.h").touch()  # named, but not used where WIN32 is defined
    options = source / "GKlib/gk_getopt.h"
    options.write_text(re.sub("__arg([cv])", r"arg_\1", options.read_text()))  # which are macros here
    gklib = f"{shop.named(source)}/GKlib"
    build = shop.cmake(source, "metis", f"-DGKLIB_PATH={gklib}", "-DGKRAND=ON",
                       flags=f"{FLAGS} -DWIN32 -fpermissive -I{gklib}")
    shutil.copy(next(build.rglob("libmetis.a")), shop.prefix / "lib")
    return source / "include"


def suitesparse(shop: Workshop, suite: Suite, metis_include: Path) -> None:
    source = shop.source(suite, "suitesparse")
    options = [f"JOBS={os.cpu_count()}", f"-j{os.cpu_count()}", f"CC=ccache {COMPILER}-gcc", f"AR={COMPILER}-gcc-ar",
               f"RANLIB={COMPILER}-gcc-ranlib", f"CFLAGS={FLAGS}", "AUTOCC=no", "CUDA=no", "BLAS=-lopenblas", "LAPACK=",
               "MY_METIS_LIB=-lmetis", f"MY_METIS_INC={shop.named(metis_include)}"]
    for part in SUITESPARSE:
        shop.run("make", "-s", "-C", source / part, "static", *options)
        shutil.copy(next((source / part).rglob("lib*.a")), shop.prefix / "lib")
        for header in (source / part).glob("**/*.h"):
            if header.parent.name in ("Include", "SuiteSparse_config"):
                shutil.copy(header, shop.prefix / "include/suitesparse")


def blas(shop: Workshop, suite: Suite) -> None:
    """The BLAS that Eigen brings, and its Cholesky factorization: what SuiteSparse calls of LAPACK.

    Another name for the name space keeps its templates apart from the solver's own, which have OpenMP.
    """
    source = shop.source(suite, "eigen3")
    for name in ("double", "complex_double"):
        whole = (source / f"lapack/{name}.cpp").read_text()
        (source / f"lapack/{name}_cholesky.cpp").write_text(whole.split('#include "lu.cpp"')[0])
    (source / "blas_only").mkdir()
    (source / "blas_only/CMakeLists.txt").write_text(BLAS_BUILD)
    shop.cmake(source / "blas_only", "install", flags=f"{FLAGS} -DNDEBUG -DEigen=eigen_of_blas")


def googletest(shop: Workshop) -> None:
    source = shop.work / "googletest"
    shutil.copytree(shop.root / "usr/src/googletest", source)
    shop.cmake(source, "install", "-DBUILD_GMOCK=OFF")


def windows_libraries(root: Path) -> Path:
    """The folder with lib/ and include/ in the root; builds it where there is none of this recipe."""
    shop = Workshop(root)
    stamp = shop.prefix / "done"
    recipe = hashlib.sha256(Path(__file__).read_bytes() + TOOLCHAIN.read_bytes()).hexdigest()
    if stamp.exists() and stamp.read_text() == recipe:
        return shop.prefix
    shutil.rmtree(shop.prefix, ignore_errors=True)
    for folder in ("lib", "include/suitesparse", "work"):
        (shop.prefix / folder).mkdir(parents=True)
    shutil.copy(TOOLCHAIN, shop.prefix)
    suite = Suite(BUILT_WITH)
    suite.update()
    opensubdiv(shop, suite)
    suitesparse(shop, suite, metis(shop, suite))
    blas(shop, suite)
    googletest(shop)
    shutil.rmtree(shop.work)
    stamp.write_text(recipe)
    return shop.prefix
