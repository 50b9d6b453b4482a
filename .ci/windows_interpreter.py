"""Builds CPython for 64-bit Windows from Debian's source, with the compiler for it, to load the module in under Wine.

It is the interpreter alone: its DLL with the modules that are built in, its program, and its library as files. Other
modules of C, such as sockets, are not built. Sources and defines are those of CPython's project for Visual Studio. In
place of numpy, which is not built for it, a stand-in lies beside it: arrays with the C interface that pybind11 calls
(.ci/wine/site). All lies in the root, below PLACE.
"""
import hashlib
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

from debian import Suite
from windows_libraries import TOOLCHAIN, Workshop
from windows_python import SUITES

ROOT = Path(__file__).resolve().parent.parent
TAG = "313"  # the Python of the root itself, which compiles the modules that are frozen into the DLL
PLACE = "interpreter"
SITE = ROOT / ".ci/wine/site"
# GCC 14 takes for errors what Microsoft's compiler takes: pointers to other types, and functions without a declaration.
FLAGS = "-O1 -DNDEBUG -w -fpermissive -include process.h -include winsock2.h"
LEFT_OUT = ("mmapmodule.c", "zlibmodule.c")  # handles exceptions as only Microsoft's compiler does; needs zlib
EDITS = {  # a file, and what is not as this compiler wants it
    "PC/config.c": (r".*mmap.*\n", ""),
    "Modules/faulthandler.c": (r"Py_ARRAY_LENGTH\((faulthandler_handlers)\);", r"sizeof(\1) / sizeof(\1[0]);"),
    "Python/dynload_win.c": (r"static int(\n_Py_CheckPython3)", r"int\1"),
}
CMAKE = r"""cmake_minimum_required(VERSION 3.25)
project(python C)
file(STRINGS sources.txt sources)
file(STRINGS frozen.txt frozen)
foreach(row ${frozen})
  string(REPLACE "|" ";" row ${row})
  list(GET row 0 name)
  list(GET row 1 file)
  set(header ${CMAKE_BINARY_DIR}/Python/frozen_modules/${name}.h)
  add_custom_command(OUTPUT ${header} COMMAND python3 ${CMAKE_SOURCE_DIR}/Programs/_freeze_module.py
    ${name} ${CMAKE_SOURCE_DIR}/${file} ${header})
  list(APPEND headers ${header})
endforeach()
configure_file(PC/pyconfig.h.in ${CMAKE_BINARY_DIR}/pyconfig.h COPYONLY)
include_directories(${CMAKE_BINARY_DIR} Include PC)
add_link_options(-static)  # no DLL of the compiler
add_library(python@TAG@ SHARED ${sources} ${headers})
target_include_directories(python@TAG@ PRIVATE ${CMAKE_BINARY_DIR}/Python Include/internal Include/internal/mimalloc
  Python Modules/_hacl/include Modules/_hacl/internal)
target_compile_definitions(python@TAG@ PRIVATE Py_BUILD_CORE Py_BUILD_CORE_BUILTIN MS_DLL_ID=\"3.13\"
  PY3_DLLNAME=L\"python3\" PYD_PLATFORM_TAG=\"win_amd64\" PREFIX=NULL EXEC_PREFIX=NULL VERSION=NULL VPATH=\"..\\\\..\"
  PYDEBUGEXT=\"\" PLATLIBDIR=\"DLLs\")
target_link_libraries(python@TAG@ PRIVATE version ws2_32 pathcch bcrypt)
add_executable(python Programs/python.c)
target_compile_definitions(python PRIVATE Py_BUILD_CORE)
target_link_options(python PRIVATE -municode)
target_link_libraries(python PRIVATE python@TAG@)
add_library(multiarray MODULE site/numpy/_core/multiarray.c)
target_link_libraries(multiarray PRIVATE python@TAG@)
set_target_properties(python@TAG@ multiarray PROPERTIES PREFIX "")
set_target_properties(multiarray PROPERTIES SUFFIX ".cp@TAG@-win_amd64.pyd")
"""


def sources(project: str) -> Iterator[str]:
    """The C files that a project for Visual Studio compiles, without those of other libraries."""
    for name in re.findall(r'ClCompile Include="\.\.\\([^"]+)"', project):
        if not name.endswith(LEFT_OUT):
            yield name.replace("\\", "/")


def frozen(project: str) -> Iterator[str]:
    """The modules that the DLL holds as bytes: the name of each and its file."""
    for file, name in re.findall(r'Include="\.\.\\([^"]+)">\s*<ModName>([^<]+)', project):
        yield f"{name}|{file}".replace("\\", "/")


def prepare(source: Path) -> None:
    """Gives CPython's source a build for this compiler."""
    for name, (pattern, replacement) in EDITS.items():
        text, count = re.subn(pattern, replacement, (source / name).read_text())
        assert count > 0, f"{name} has no {pattern}"
        (source / name).write_text(text)
    core, freezer = ((source / f"PCbuild/{name}.vcxproj").read_text() for name in ("pythoncore", "_freeze_module"))
    (source / "sources.txt").write_text("\n".join(sources(core)))
    (source / "frozen.txt").write_text("\n".join(frozen(freezer)))
    (source / "CMakeLists.txt").write_text(CMAKE.replace("@TAG@", TAG))
    shutil.copytree(SITE, source / "site")


def install(source: Path, build: Path, prefix: Path) -> None:
    """Puts program, DLL, library and stand-in where the program looks for them."""
    for name in ("python.exe", f"python{TAG}.dll"):
        shutil.copy(build / name, prefix)
    shutil.copytree(source / "Lib", prefix / "Lib", ignore=shutil.ignore_patterns("test", "idlelib", "tkinter"))
    shutil.copytree(SITE, prefix / "Lib/site-packages", dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.c"))
    shutil.copy(next(build.glob("multiarray*.pyd")), prefix / "Lib/site-packages/numpy/_core")


def recipe() -> str:
    """Changes with whatever this Python is made by."""
    files = sorted(path for path in SITE.rglob("*") if path.is_file())
    return hashlib.sha256(b"".join(path.read_bytes() for path in [Path(__file__), TOOLCHAIN, *files])).hexdigest()


def ready_interpreter(root: Path) -> Path:
    """The program in the root; built where there is none of this recipe. The root must have its libraries already."""
    shop = Workshop(root, PLACE)
    program, stamp = shop.prefix / "python.exe", shop.prefix / "done"
    if stamp.exists() and stamp.read_text() == recipe():
        return program
    shutil.rmtree(shop.prefix, ignore_errors=True)
    shop.work.mkdir(parents=True)
    suite = Suite(SUITES[TAG])
    suite.update()
    source = shop.source(suite, f"python{TAG[0]}.{TAG[1:]}")
    prepare(source)
    install(source, shop.cmake(source, "all", "-DCMAKE_C_FLAGS_RELEASE=", flags=FLAGS), shop.prefix)
    shutil.rmtree(shop.work)
    stamp.write_text(recipe())
    return program
