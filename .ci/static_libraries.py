"""Builds the libraries that go into the package, from Debian's sources: static, position independent, hidden.

Debian's own archives will not do: those of SuiteSparse are not position independent, METIS and OpenSubdiv have none.
OpenBLAS's archive is fit and is taken as it is, with kernels for every x86-64 processor. The solver asks BLAS for one
thread (same input, same bits), but the serial archive will not do: it locks nothing, and of 180 solves in threads that
overlapped 7 came out wrong and one failed. Two and a half minutes on two idle cores; kept in the cache folder, and
built anew when this file has changed.
"""
import hashlib
import os
import shutil
import subprocess
from pathlib import Path

from debian import BUILT_WITH, CACHE, Suite

PREFIX = CACHE / "static"
FLAGS = "-O3 -fPIC -fvisibility=hidden -w"
SUITESPARSE = ("SuiteSparse_config", "AMD", "CAMD", "COLAMD", "CCOLAMD", "CHOLMOD", "UMFPACK")
OPENSUBDIV_OFF = ("EXAMPLES", "TUTORIALS", "REGRESSION", "DOC", "OMP", "TBB", "CUDA", "OPENCL", "CLEW", "OPENGL",
                  "METAL", "DX", "TESTS", "GLTESTS", "PTEX")


def run(*command: str | Path) -> None:
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def cmake(source: Path, target: str, *options: str) -> Path:
    build = source.with_name(source.name + "-build")
    run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_C_FLAGS={FLAGS}",
        "-DCMAKE_C_COMPILER_LAUNCHER=ccache", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", f"-DCMAKE_CXX_FLAGS={FLAGS}",
        "-DCMAKE_POLICY_VERSION_MINIMUM=3.5", *options)
    run("cmake", "--build", build, "--target", target)
    return build


def opensubdiv(suite: Suite, work: Path, prefix: Path) -> None:
    source = suite.source("opensubdiv", work)
    options = [f"-DNO_{part}=ON" for part in OPENSUBDIV_OFF]
    build = cmake(source, "osd_static_cpu", "-DBUILD_SHARED_LIBS=OFF", *options)
    shutil.copy(next(build.rglob("libosdCPU.a")), prefix / "lib")
    no_headers = shutil.ignore_patterns("*.cpp", "*.glsl")
    shutil.copytree(source / "opensubdiv", prefix / "include/opensubdiv", ignore=no_headers)


def metis(suite: Suite, work: Path, prefix: Path) -> Path:
    source = suite.source("metis", work)
    build = cmake(source, "metis", f"-DGKLIB_PATH={source / 'GKlib'}")
    shutil.copy(next(build.rglob("libmetis.a")), prefix / "lib")
    return source / "include"


def suitesparse(suite: Suite, work: Path, prefix: Path, metis_include: Path) -> None:
    source = suite.source("suitesparse", work)
    options = [f"JOBS={os.cpu_count()}", "CC=ccache cc", f"CFLAGS={FLAGS}", "AUTOCC=no", "CUDA=no", "BLAS=-lopenblas",
               "LAPACK=", "MY_METIS_LIB=-lmetis", f"MY_METIS_INC={metis_include}"]
    for part in SUITESPARSE:
        run("make", "-s", "-C", source / part, "static", *options)
        shutil.copy(next((source / part).rglob("lib*.a")), prefix / "lib")
        for header in (source / part).glob("**/*.h"):
            if header.parent.name in ("Include", "SuiteSparse_config"):
                shutil.copy(header, prefix / "include/suitesparse")


def openblas(suite: Suite, work: Path, prefix: Path) -> None:
    suite.unpack(["libopenblas-pthread-dev"], work / "openblas")
    shutil.copy(next((work / "openblas").rglob("libopenblasp-r*.a")), prefix / "lib/libopenblas.a")


def static_libraries() -> Path:
    """The prefix with lib/ and include/; builds it where the cache has none."""
    stamp, recipe = PREFIX / "done", hashlib.sha256(Path(__file__).read_bytes()).hexdigest()
    if stamp.exists() and stamp.read_text() == recipe:
        return PREFIX
    shutil.rmtree(PREFIX, ignore_errors=True)
    for folder in ("lib", "include/suitesparse", "work"):
        (PREFIX / folder).mkdir(parents=True)
    suite, work = Suite(BUILT_WITH), PREFIX / "work"
    suite.update()
    opensubdiv(suite, work, PREFIX)
    suitesparse(suite, work, PREFIX, metis(suite, work, PREFIX))
    openblas(suite, work, PREFIX)
    shutil.rmtree(work)
    stamp.write_text(recipe)
    return PREFIX
