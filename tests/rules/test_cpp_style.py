"""The layout and the names of the C++ code, judged by clang-format and clang-tidy."""
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from tree import ROOT, cpp_files

BUILD = ROOT / "build/release"
JUDGED = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "reflection_lines/tidy"
ROOTS = ("native/include", "native/src", "native", ".")  # where the build looks for an include
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


def verdict(tidy: str, file: Path) -> str:
    """clang-tidy's complaints about one translation unit; empty when it has none."""
    command = ["nice", tidy, "--quiet", "-p", str(BUILD), str(file)]
    result = subprocess.run(command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return "" if result.returncode == 0 else result.stdout


def read_compile_commands() -> str:
    if not (BUILD / "compile_commands.json").is_file():
        pytest.skip("build/release is not configured: ./run build")
    return (BUILD / "compile_commands.json").read_text()


def judge(files: list[Path], version: bytes, find_complaints: Callable[[Path], str]) -> None:
    """Judges the translation units that changed since they were last found good."""
    stamps = {JUDGED / fingerprint(file, version): file for file in files}
    pending = {stamp: file for stamp, file in stamps.items() if not stamp.exists()}
    JUDGED.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        verdicts = dict(zip(pending, pool.map(find_complaints, pending.values()), strict=True))
    for stamp, complaints in verdicts.items():
        if not complaints:
            stamp.touch()
    assert not any(verdicts.values()), "\n".join(filter(None, verdicts.values()))


def test_names() -> None:
    tidy, compiled = needed("clang-tidy"), read_compile_commands()
    version = subprocess.run([tidy, "--version"], check=True, stdout=subprocess.PIPE).stdout
    judge([file for file in cpp_files(".cpp") if f"{file}\"" in compiled], version, lambda file: verdict(tidy, file))


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
    judge(files, "\n".join(command).encode(), lambda file: parse(command, file))
