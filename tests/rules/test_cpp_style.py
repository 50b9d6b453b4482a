"""The layout and the names of the C++ code, judged by clang-format and clang-tidy."""
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import groupby
from pathlib import Path

import pytest
from tree import ROOT, cpp_files

BUILD = ROOT / "build/release"
JUDGED = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "reflection_lines/tidy"
ROOTS = ("native/include", "native/src", "native", ".")  # where the build looks for an include
PRECOMPILED = re.compile(r"-Winvalid-pch -include \S+|-fpch-preprocess")  # of g++, which clang cannot read
OWN_INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def needed(tool: str) -> str:
    path = shutil.which(tool)
    if path is None:
        pytest.skip(f"{tool} is not installed")
    return path


def test_clang_format() -> None:
    command = [needed("clang-format"), "--dry-run", "-Werror", *map(str, cpp_files())]
    result = subprocess.run(command, cwd=ROOT, text=True, stderr=subprocess.PIPE)
    wrong = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error", result.stderr, re.MULTILINE)))
    assert result.returncode == 0, f"./run format would change {wrong}\n{result.stderr[:2000]}"


def with_own_headers(file: Path, seen: set[Path]) -> set[Path]:
    """The file and every header of the project that it includes, near or far."""
    if file not in seen and (ROOT / file).is_file():
        seen.add(file)
        for included in OWN_INCLUDE.findall((ROOT / file).read_text()):
            for folder in (*ROOTS, file.parent):
                with_own_headers(Path(folder, included), seen)
    return seen


def fingerprint(file: Path, version: bytes) -> str:
    """What clang-tidy's verdict on a translation unit depends on."""
    digest = hashlib.sha256(version + (ROOT / ".clang-tidy").read_bytes())
    for part in sorted(with_own_headers(file, set())):
        digest.update(str(part).encode() + (ROOT / part).read_bytes())
    return digest.hexdigest()


def flags_by_file() -> dict[Path, tuple[str, ...]]:
    """The compiler's flags for each translation unit of the build."""
    entries = json.loads(read_compile_commands())
    words = {Path(entry["file"]).relative_to(ROOT): shlex.split(PRECOMPILED.sub("", entry["command"]))
             for entry in entries}
    return {file: tuple(command[1:command.index("-o")]) for file, command in words.items()}


def find_complaints(tidy: str, flags: Sequence[str], files: Sequence[Path]) -> str:
    """clang-tidy's complaints about files that are included one after the other; empty when it has none."""
    with tempfile.TemporaryDirectory() as folder:
        joined = Path(folder, "joined.cpp")
        joined.write_text("".join(f'#include "{ROOT / file}"\n' for file in files))
        command = ["nice", tidy, "--quiet", f"--config-file={ROOT / '.clang-tidy'}", str(joined), "--", *flags]
        result = subprocess.run(command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return "" if result.returncode == 0 else result.stdout


def verdicts(files: Sequence[Path], complaints_of: Callable[[Sequence[Path]], str]) -> dict[Path, str]:
    """The complaints about each of some files, which are judged together: a library's headers are then read once. Files
    that complaints name are judged apart from the others, for their only fault may be a name that another has too."""
    complaints = complaints_of(files)
    if not complaints or len(files) == 1:
        return dict.fromkeys(files, complaints)
    named = [file for file in files if str(ROOT / file) in complaints]
    parts = ([file for file in files if file not in named], named)
    parts = parts if all(parts) else ([file] for file in files)
    return {file: text for part in parts for file, text in verdicts(part, complaints_of).items()}


def batches(files: Sequence[Path], flags: dict[Path, tuple[str, ...]]) -> list[list[Path]]:
    """Files of one folder, which are built with the same flags, by the dozen."""
    groups = [list(group) for _, group in groupby(sorted(files), lambda file: (file.parent, flags[file]))]
    return [group[at:at + 12] for group in groups for at in range(0, len(group), 12)]


def read_compile_commands() -> str:
    if not (BUILD / "compile_commands.json").is_file():
        pytest.skip("build/release is not configured: ./run build")
    return (BUILD / "compile_commands.json").read_text()


def judge(files: Sequence[Path], version: bytes, batch: Callable[[list[Path]], list[list[Path]]],
          complaints_of: Callable[[Sequence[Path]], str]) -> None:
    """Judges the translation units that changed since they were last found good, as many batches at once as there are
    cores."""
    stamps = {file: JUDGED / fingerprint(file, version) for file in files}
    pending = [file for file, stamp in stamps.items() if not stamp.exists()]
    JUDGED.mkdir(parents=True, exist_ok=True)
    wrong = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(lambda part: verdicts(part, complaints_of), batch(pending)):
            for file in (file for file, complaints in found.items() if not complaints):
                stamps[file].touch()
            wrong += filter(None, found.values())
    assert not wrong, "\n".join(wrong)


def test_names() -> None:
    tidy, flags = needed("clang-tidy"), flags_by_file()
    version = subprocess.run([tidy, "--version"], check=True, stdout=subprocess.PIPE).stdout
    judge([file for file in cpp_files(".cpp") if file in flags], version, lambda files: batches(files, flags),
          lambda files: find_complaints(tidy, flags[files[0]], files))


def test_a_name_that_two_files_have_is_no_fault_and_a_wrong_one_is_found() -> None:
    first, second, third = (Path(f"native/{name}.cpp") for name in ("first", "second", "third"))

    def complain(files: Sequence[Path]) -> str:
        meet = f"{ROOT / second}: redefinition" if {first, second} <= set(files) else ""
        return meet + (f"{ROOT / third}: wrong" if third in files else "")
    assert verdicts([first, second, third], complain) == {first: "", second: "", third: f"{ROOT / third}: wrong"}


def parse(command: list[str], file: Path) -> str:
    """What a compiler says against a file that it only parses; empty where a library of the benchmarks is missing."""
    result = subprocess.run([*command, str(file)], cwd=ROOT, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    missing = re.search(r"fatal error: (benchmark|CGAL)/", result.stdout)
    return "" if result.returncode == 0 or missing else f"{file}: {result.stdout}"


def test_benchmarks_and_fuzzers_are_of_the_present_interfaces() -> None:
    """They are built by name only, so that a member that has gone was found after a day, by the benchmark."""
    entry = next(each for each in json.loads(read_compile_commands()) if each["file"].endswith("shape_optimizer.cpp"))
    kept = [word for word in shlex.split(entry["command"]) if word.startswith(("-D", "-f", "-std", "/"))]
    paths = re.findall(r"(?:-I|-isystem) ?(\S+)", entry["command"])
    compiler = next(word for word in kept if word.endswith(("c++", "g++", "clang++")))
    command = [compiler, *(word for word in kept if word[0] == "-" and "lto" not in word), "-fsyntax-only",
               *(f"-I{path}" for path in (*paths, ROOT))]
    files = [file for file in cpp_files(".cpp") if file.parts[:2] in (("tests", "bench"), ("tests", "fuzz"))]
    assert len(files) > 10
    judge(files, "\n".join(command).encode(), lambda changed: [[file] for file in changed],
          lambda part: parse(command, part[0]))
