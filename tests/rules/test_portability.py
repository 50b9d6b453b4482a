"""The code is one for Linux, Windows and macOS, and for Python 3.10 on: what only one has stands behind a guard."""
import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tree import ROOT, cpp_files, files, python_files

# Headers that only some systems have.
OF_ONE_SYSTEM = re.compile(r"sys/|unistd\.h|dlfcn\.h|pthread\.h|sched\.h|malloc\.h|mach/|windows\.h|Windows\.h")
# What only some compilers or systems know, in code without literals.
OF_SOME_SYSTEMS = re.compile(r"\b(?:madvise|mmap|sysconf|getpid|_?popen|_?pclose|setenv|_putenv_s|__libc_\w+)\b")
INSTEAD = {re.compile(r"\bM_PI\w*\b"): "std::numbers",
           re.compile(r"\b(?<!long )long\b(?! long)"): "int or std::int64_t: 32 bits in Windows"}
GUARD = re.compile(r"defined\((__linux__|__GLIBC__|_WIN32|__APPLE__)\)")
LITERAL = re.compile(r'"(?:\\.|[^"\\])*"|//.*$')
PLACE = re.compile(r"(?<![\w.}])/(?:usr|proc|opt|home|root|tmp)\b")
# What Python 3.11 and later brought, as far as an add-on could want it.
NOT_IN_PYTHON_3_10 = {"tomllib", "StrEnum", "Self", "assert_never", "override", "batched", "UTC", "ExceptionGroup",
                      "file_digest", "chdir", "TaskGroup"}


def code_with_guards(file: Path) -> Iterator[tuple[int, str, bool]]:
    """Yields the lines of a file with their numbers, and whether they stand behind a guard."""
    guards: list[bool] = []
    for number, line in enumerate((ROOT / file).read_text().splitlines(), start=1):
        if re.match(r"\s*#\s*if", line):
            guards.append(bool(GUARD.search(line)))
        elif re.match(r"\s*#\s*endif", line):
            guards.pop()
        yield number, line, any(guards)


def faults(file: Path) -> Iterator[str]:
    for number, line, guarded in code_with_guards(file):
        included = re.match(r"\s*#\s*include\s*<([^>]+)>", line)
        if included and OF_ONE_SYSTEM.match(included[1]) and not guarded:
            yield f"{file}:{number} includes {included[1]} without a guard"
        code = LITERAL.sub("", line)
        for word in OF_SOME_SYSTEMS.findall(code) if not guarded else ():
            yield f"{file}:{number} has {word} without a guard"
        yield from (f"{file}:{number} should have {other}" for word, other in INSTEAD.items() if word.search(code))
        if PLACE.search(line):
            yield f"{file}:{number} names a place that only some systems have"


def native_files() -> list[Path]:
    return [file for file in cpp_files() if file.parts[0] == "native" or file.parts[:2] == ("tests", "native")]


def test_what_one_system_has_stands_behind_a_guard() -> None:
    wrong = [fault for file in native_files() for fault in faults(file)]
    assert len(native_files()) > 150 and not wrong, "\n".join(wrong)


def cmake_files() -> list[Path]:
    return [file for file in files() if file.name == "CMakeLists.txt" or file.suffix == ".cmake"]


@pytest.mark.parametrize("file", cmake_files(), ids=str)
def test_cmake_names_no_place_of_one_system(file: Path) -> None:
    assert not PLACE.findall((ROOT / file).read_text()), "let find_package look, or set it in a preset"


def names(tree: ast.Module) -> set[str]:
    imported = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)
                for alias in node.names}
    return imported | {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}


@pytest.mark.parametrize("file", python_files("addon/"), ids=str)
def test_the_addon_runs_with_python_3_10(file: Path) -> None:
    """Which Blender 3.4 to 4.0 from blender.org embed."""
    tree = ast.parse((ROOT / file).read_text(), feature_version=(3, 10))
    assert not names(tree) & NOT_IN_PYTHON_3_10
