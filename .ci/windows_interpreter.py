"""Builds CPython for 64-bit Windows from Debian's source, with the compiler for it, to load a module in under Wine.

It is the interpreter alone: its DLL with the modules that are built in, its program, and its library as files. Other
modules of C, such as sockets, are not built. Sources and defines are those of CPython's project for Visual Studio. The
modules that are frozen into the DLL are compiled by the same suite's Python for Linux: only the same version makes the
same bytecode. In place of numpy, which is not built for it, a stand-in lies beside it: arrays with the C interface that
pybind11 calls (.ci/wine/site). All lies in the root, below PLACE, a folder for each version.
"""
import hashlib
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

from debian import Suite
from windows_libraries import TOOLCHAIN, Workshop
from windows_python import SUITES, version

ROOT = Path(__file__).resolve().parent.parent
PLACE = "interpreter"
SITE = ROOT / ".ci/wine/site"
# GCC 14 takes for errors what Microsoft's compiler takes: pointers to other types, and functions without a declaration.
# MS_WIN64, without which pointers have 4 bytes, 3.11's headers set for Microsoft's compiler only.
FLAGS = "-O1 -DNDEBUG -DMS_WIN64= -w -fpermissive -include process.h -include winsock2.h"
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
  add_custom_command(OUTPUT ${header} COMMAND @PYTHON@ ${CMAKE_SOURCE_DIR}/Programs/_freeze_module.py
    ${name} ${CMAKE_SOURCE_DIR}/${file} ${header})
  list(APPEND headers ${header})
  list(APPEND named ${header}:${name})
endforeach()
set(deepfreeze ${CMAKE_SOURCE_DIR}/Python/deepfreeze/deepfreeze.c)  # the frozen modules as objects: a source of 3.11
add_custom_command(OUTPUT ${deepfreeze} DEPENDS ${headers}
  COMMAND @PYTHON@ ${CMAKE_SOURCE_DIR}/Tools/scripts/deepfreeze.py ${named} -o ${deepfreeze})
file(GLOB settings PC/pyconfig.h*)
configure_file(${settings} ${CMAKE_BINARY_DIR}/pyconfig.h COPYONLY)
include_directories(${CMAKE_BINARY_DIR} Include PC)
add_link_options(-static)  # no DLL of the compiler
add_library(python@TAG@ SHARED ${sources} ${headers})
target_include_directories(python@TAG@ PRIVATE ${CMAKE_BINARY_DIR}/Python Include/internal Include/internal/mimalloc
  Python Modules/_hacl/include Modules/_hacl/internal)
target_compile_definitions(python@TAG@ PRIVATE Py_BUILD_CORE Py_BUILD_CORE_BUILTIN MS_DLL_ID=\"@VERSION@\"
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


def prepare(source: Path, tag: str, host: str) -> None:
    """Gives CPython's source a build for this compiler; `host` is the program of its version that runs in the root."""
    for name, (pattern, replacement) in EDITS.items():
        text, count = re.subn(pattern, replacement, (source / name).read_text())
        assert count > 0, f"{name} has no {pattern}"
        (source / name).write_text(text)
    core, freezer = ((source / f"PCbuild/{name}.vcxproj").read_text() for name in ("pythoncore", "_freeze_module"))
    (source / "sources.txt").write_text("\n".join(sources(core)))
    (source / "frozen.txt").write_text("\n".join(frozen(freezer)))
    lists = CMAKE.replace("@TAG@", tag).replace("@VERSION@", version(tag)).replace("@PYTHON@", host)
    (source / "CMakeLists.txt").write_text(lists)
    shutil.copytree(SITE, source / "site")


def install(source: Path, build: Path, prefix: Path, tag: str) -> None:
    """Puts program, DLL, library and stand-in where the program looks for them."""
    for name in ("python.exe", f"python{tag}.dll"):
        shutil.copy(build / name, prefix)
    shutil.copytree(source / "Lib", prefix / "Lib", ignore=shutil.ignore_patterns("test", "idlelib", "tkinter"))
    shutil.copytree(SITE, prefix / "Lib/site-packages", dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.c"))
    shutil.copy(next(build.glob("multiarray*.pyd")), prefix / "Lib/site-packages/numpy/_core")


def recipe() -> str:
    """Changes with whatever these Pythons are made by."""
    files = sorted(path for path in SITE.rglob("*") if path.is_file())
    return hashlib.sha256(b"".join(path.read_bytes() for path in [Path(__file__), TOOLCHAIN, *files])).hexdigest()


def build_interpreter(shop: Workshop, tag: str) -> None:
    """Builds it with all that it stands on, in the folder of its version."""
    package, suite = f"python{version(tag)}", Suite(SUITES[tag])
    suite.update()
    host = shop.work / "host"
    suite.unpack([f"{package}-minimal", f"lib{package}-minimal", f"lib{package}-stdlib"], host)
    source = shop.source(suite, package)
    prepare(source, tag, shop.named(host / "usr/bin" / package))
    install(source, shop.cmake(source, "all", "-DCMAKE_C_FLAGS_RELEASE=", flags=FLAGS), shop.prefix, tag)


def ready_interpreter(root: Path, tag: str) -> Path:
    """The program in the root; built where there is none of this recipe. The root must have its libraries already."""
    shop = Workshop(root, f"{PLACE}/{tag}")
    program, stamp = shop.prefix / "python.exe", shop.prefix / "done"
    if stamp.exists() and stamp.read_text() == recipe():
        return program
    shutil.rmtree(shop.prefix, ignore_errors=True)
    shop.work.mkdir(parents=True)
    build_interpreter(shop, tag)
    shutil.rmtree(shop.work)
    stamp.write_text(recipe())
    return program
