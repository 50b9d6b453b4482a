"""Gives what a module for a Python of Windows is built with: its headers, and a library that names its DLL's exports.

The headers are those of CPython's source as Debian has it; the DLL's names are all that the headers declare, of which
the module imports those that it uses. Python 3.11 and 3.13 are those of Blender 4.1 to 5.0 and of 5.1 and later.
Results are kept in the root, below PLACE.
"""
import hashlib
import re
import shutil
from pathlib import Path

from debian import CACHE, Suite, output
from matrix import inside
from windows_libraries import COMPILER

PLACE = "python"  # of all this in the root
SUITES = {"311": "bookworm", "313": "trixie"}
RECIPE = (Path(__file__), Path(__file__).with_name("debian.py"))
DECLARED = re.compile(r"PyAPI_(FUNC|DATA)\([^)]*\)\s*\*?\s*(_?Py\w+)")


def version(tag: str) -> str:
    return f"{tag[0]}.{tag[1:]}"


def exports(tag: str, headers: Path) -> str:
    """The text from which dlltool makes the library."""
    text = "".join(header.read_text() for header in sorted(headers.rglob("*.h")))
    kinds = {name: kind for kind, name in DECLARED.findall(text)}
    rows = [name + (" DATA" if kind == "DATA" else "") for name, kind in sorted(kinds.items())]
    return "\n".join([f"LIBRARY python{tag}.dll", "EXPORTS", *rows, ""])


def copy_headers(suite: Suite, tag: str, include: Path) -> None:
    """Copies the headers of a suite's Python, that of Windows's settings among them, and of pybind11."""
    work = CACHE / "windows" / f"python{tag}"
    shutil.rmtree(work, ignore_errors=True)
    suite.update()
    source = suite.source(f"python{version(tag)}", work)
    shutil.copytree(source / "Include", include)
    shutil.copy(next((source / "PC").glob("pyconfig.h*")), include / "pyconfig.h")
    shutil.copytree(suite.unpack_pybind11(work / "pybind11") / "pybind11", include / "pybind11")
    shutil.rmtree(work)


def ready_python(root: Path, tag: str) -> Path:
    """The folder of a Python in the root, with include/ and libs/; made where there is none of this recipe."""
    place = root / PLACE / tag
    stamp, recipe = place / "done", hashlib.sha256(b"".join(path.read_bytes() for path in RECIPE)).hexdigest()
    if stamp.exists() and stamp.read_text() == recipe:
        return place
    shutil.rmtree(place, ignore_errors=True)
    (place / "libs").mkdir(parents=True)
    copy_headers(Suite(SUITES[tag]), tag, place / "include")
    (place / "python.def").write_text(exports(tag, place / "include"))
    output(*inside(root, f"{COMPILER}-dlltool", "--input-def", f"/{PLACE}/{tag}/python.def",
                   "--output-lib", f"/{PLACE}/{tag}/libs/libpython{tag}.a"))
    stamp.write_text(recipe)
    return place
