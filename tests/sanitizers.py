"""Runs the native code under clang's sanitizers, and its fuzzers; the last line is "N passed, N failed, N skipped".

    tests/sanitizers.py asan | tsan | fuzz [MINUTES [SEED]]

asan: memory errors, undefined behaviour and leaks in the native tests and in those of the bindings. tsan: data races
in the native tests, with Archer, which tells ThreadSanitizer how OpenMP synchronizes; a program with a race of its own
must be caught, else nothing was looked for. fuzz: each fuzzer of tests/fuzz from its seeds on, with
other random numbers each time unless SEED is given; REFLINES_SLOWER lengthens the limit of time of an input.
"""
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from suites import PYTHON, ROOT, Counts, crashed, native_suite, run_with_junit

# Seconds of one input. A press fits small matrices to look for dents: with sanitizers that takes 160 times as long.
FUZZERS = {"shape": 5, "cage": 5, "grids": 5, "press": 25}
# All files of tests/bindings run, in processes of their own, but these, and those tests.
LEFT_OUT = {
    "test_bit_identity": "has the bits of another compiler",
    "test_installed_library": "builds the library anew, without sanitizers",
    "test_wheel": "builds the module anew, likewise",
    "test_processors": "compares processes with each other: what each does is done by other files",
    "test_thread_count": "likewise, and takes a quarter of an hour",
    "test_careless": "presses on whole car bodies: half an hour of what test_smooth_panel does",
    "test_smooth_panel::test_real_panels_are_restored": "likewise",
    "test_fair_border::test_flaws_across_the_border_go_from_the_region": "likewise, on larger meshes",
}
LONGEST = 2400  # seconds of a file
SLOWER = 20  # times
MOST_MEMORY = 2048  # MiB of one input
# OpenBLAS and the interpreter keep what they have for the whole run.
LEAKS = ("leak:libopenblas", "leak:libpython", "leak:libomp", "leak:libgomp")
# Libraries that are compiled without the sanitizer, and synchronize by means that it does not see.
# OpenBLAS has no line: it is mapped twice, which ends the run, and modules without the sanitizer are left out anyway.
RACES = ("called_from_lib:libgomp", "called_from_lib:libcholmod", "called_from_lib:libumfpack",
         "called_from_lib:libmetis")
RACE = """
#include <cstdio>
int main() {
  int sum = 0;
#pragma omp parallel for num_threads(2)
  for (int i = 0; i < 100000; ++i) sum += i;
  std::printf("%d\\n", sum);
}
"""


def built(preset: str, *targets: str) -> bool:
    """Builds these targets, or all."""
    folder = ROOT / "build" / preset
    configured = (folder / "build.ninja").is_file() or \
        subprocess.run(["cmake", "--preset", preset], cwd=ROOT).returncode == 0
    chosen = ["--target", *targets] if targets else []
    return configured and subprocess.run(["cmake", "--build", "--preset", preset, *chosen], cwd=ROOT).returncode == 0


def suppressions(name: str, lines: tuple[str, ...]) -> Path:
    path = ROOT / "build" / f"{name}.suppressions"
    path.write_text("\n".join(lines) + "\n")
    return path


def asan_environment() -> dict[str, str]:
    return os.environ | {"ASAN_OPTIONS": "detect_leaks=1:detect_stack_use_after_return=1:allocator_may_return_null=1",
                         "LSAN_OPTIONS": f"suppressions={suppressions('leaks', LEAKS)}",
                         "UBSAN_OPTIONS": "print_stacktrace=1"}


def binding_tests(env: dict[str, str]) -> Counts:
    """The interpreter itself has leaks by design, so that none are looked for; times are those of slow code."""
    runtime = subprocess.run(["clang", "-print-file-name=libclang_rt.asan-x86_64.so"], text=True,
                             stdout=subprocess.PIPE).stdout.strip()
    env = env | {"ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1", "LD_PRELOAD": runtime,
                 "PYTHONPATH": str(ROOT / "build/asan/module"), "PYTHONMALLOC": "malloc",
                 "REFLINES_SLOWER": str(SLOWER)}
    files = [path for path in sorted((ROOT / "tests/bindings").glob("test_*.py")) if path.stem not in LEFT_OUT]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return sum(pool.map(lambda path: binding_file(path, env), files), Counts())


def binding_file(path: Path, env: dict[str, str]) -> Counts:
    """A process of its own: a crash costs no other file's counts."""
    report = ROOT / f"build/tests/asan_{path.stem}.xml"
    skipped = [f"--deselect={path.relative_to(ROOT)}::{name.partition('::')[2]}" for name in LEFT_OUT
               if name.startswith(f"{path.stem}::")]
    command = [PYTHON, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--junitxml={report}", *skipped, str(path)]
    start = time.monotonic()
    counts = run_with_junit(command, report, env, timeout=LONGEST)
    print(f"asan {path.stem}: {counts} ({time.monotonic() - start:.0f} s)", flush=True)
    return counts


def asan() -> Counts:
    if not built("asan"):
        return crashed("asan: the build failed")
    env = asan_environment()
    return native_suite("asan", env) + binding_tests(env)


def catches_a_race(env: dict[str, str]) -> bool:
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder, "race.cpp"), Path(folder, "race")
        source.write_text(RACE)
        command = ["clang++", "-g", "-O1", "-fopenmp", "-fsanitize=thread", str(source), "-o", str(program)]
        return (subprocess.run(command).returncode == 0
                and subprocess.run([str(program)], env=env, capture_output=True).returncode == 66)


def tsan() -> Counts:
    archer = subprocess.run(["clang", "-print-file-name=libarcher.so"], text=True, stdout=subprocess.PIPE).stdout
    env = os.environ | {"TSAN_OPTIONS": f"ignore_noninstrumented_modules=1:suppressions={suppressions('races', RACES)}",
                        "OMP_NUM_THREADS": "4", "OMP_TOOL_LIBRARIES": archer.strip()}  # not always found
    if not catches_a_race(env):
        return crashed("tsan: the racy program was not caught")
    if not built("tsan"):
        return crashed("tsan: the build failed")
    return Counts(passed=1) + native_suite("tsan", env)


def fuzz(minutes: float = 1.0, seed: int = 0) -> Counts:
    if not built("asan", *(f"fuzz_{name}" for name in FUZZERS)):
        return crashed("fuzz: the build failed")
    return sum((fuzzed(name, minutes, seed) for name in FUZZERS), Counts())


def fuzzed(name: str, minutes: float, seed: int) -> Counts:
    """New inputs that reach new code are kept in build/fuzz, findings beside them; seeds only those of the project."""
    kept = ROOT / "build/fuzz" / name
    kept.mkdir(parents=True, exist_ok=True)
    longest = round(FUZZERS[name] * float(os.environ.get("REFLINES_SLOWER", 1.0)))
    command = [str(ROOT / "build/asan" / f"fuzz_{name}"), str(kept), str(ROOT / "tests/fuzz/seeds" / name),
               f"-max_total_time={round(60 * minutes)}", f"-timeout={longest}", f"-rss_limit_mb={MOST_MEMORY}",
               f"-seed={seed}",
               "-max_len=600", "-print_final_stats=1", "-verbosity=0", f"-artifact_prefix={kept}-"]
    code = subprocess.run(command, cwd=ROOT, env=asan_environment() | {"OMP_NUM_THREADS": "1"}).returncode
    print(f"fuzz {name}: exit code {code}", flush=True)
    return Counts(passed=1) if code == 0 else crashed(f"fuzz {name}: exit code {code}")


def main() -> int:
    kind = sys.argv[1]
    suites: dict[str, Callable[[], Counts]] = {
        "asan": asan, "tsan": tsan, "fuzz": lambda: fuzz(*map(float, sys.argv[2:3]), *map(int, sys.argv[3:]))}
    total = suites[kind]()
    print(total)
    return 0 if total.failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
