"""Runs the native benchmarks and writes build/bench/report.json: a list of {"name", "value", "unit", "note"}.

Ratios are taken within one run, where both sides are measured by turns; every time is a median. With --keep the rows
also go into tests/bench/report.json, with the date, the commit and the machine: the report that the documents quote.
"""
import argparse
import json
import math
import os
import platform
import statistics
import subprocess
from dataclasses import asdict
from datetime import date
from pathlib import Path

import json_lines
from bench import continuity, design_tools, handle_steps, light_set, live, ranking, restoration
from bench.row import Row

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/release/tests/bench"
OUT = ROOT / "build/bench"
KEPT = ROOT / "tests/bench/report.json"
REPETITIONS = 5
MILLION_REPETITIONS = 3  # a solve takes half a minute, and its spread is small
TASKS = ("creation", "elimination")
BOUNDED_SHARES = ("10", "50", "90")  # per cent of the vertices that the limit holds
FIGURE_SIZES = (32, 64, 128, 256)
EARLY_GOALS = ("/1e-3", "/1e-5")

Times = dict[str, float]  # benchmark -> median milliseconds


# What is aimed at, by row: (bound, whether the value should lie below it).
REACH = {
    "solve_over_factor_10k": (1.5, True), "solve_over_factor_100k": (0.9, True), "solve_over_factor_1m": (0.6, True),
    "solve_1m_peak_gib": (5.0, True), "growth_100k_to_1m": (22.0, True), "adaptive_vs_linearized": (3.0, False),
    "adaptive_vs_linearized_1e-3": (1.5, False),
    "adaptive_vs_newton": (5.0, False), "warm_step_ms_10k": (16.0, True), "warm_step_ms_100k": (33.0, True),
    "gather_apply_over_solve_100k": (0.2, True), "press_over_native_10k": (1.3, True),
    "press_over_native_100k": (1.3, True), "drag_hysteresis": (1e-6, True), "drag_kick": (1.5, True),
    "stripes_ms_400k": (100.0, True), "escape_ms_100k": (100.0, True), "drag_still_ms_100k": (100.0, True),
    "cgal_fair_over_ours_10k": (8.0, False), "biharmonic_over_ours_100k": (0.5, False),
    "neighbours_ms": (300.0, True), "four_objects_over_one_10k": (1.2, True),
    "four_objects_over_one_100k": (1.2, True),
    "cage_warm_step_ms": (33.0, True), "bounded_over_free_10k": (5.0, True), "bounded_over_free_100k": (5.0, True),
    "bounded_warm_over_free_10k": (2.0, True), "bounded_warm_over_free_100k": (2.0, True),
    "drag_limited_over_free_10k": (2.0, True), "drag_limited_over_free_100k": (2.0, True),
    "restoration_harm_given": (0.3, True), "restoration_harm_crossed": (0.3, True),
    "restoration_harm_worst": (0.6, True), "restoration_dents_given": (0.4, True),
    "restoration_dents_crossed": (0.5, True),
    "restoration_ripple_given": (0.4, True), "restoration_ripple_crossed": (0.5, True),
    "restoration_noise_given": (0.4, True), "restoration_noise_crossed": (0.5, True), "restoration_move": (0.05, True),
    "restoration_cage_move": (3.0, True), "two_lights_over_one": (1.6, True), "families_over_one_8": (2.75, True),
    "light_set_even": (1.0, True), "light_set_theta": (1.0, True), "light_set_over_alone": (1.35, True),
    "light_set_move": (1.1, True),
    "handle_step_ms_10k": (16.0, True), "handle_step_ms_100k": (60.0, True),
    "brush_dab_ms_100k": (33.0, True), "handle_first_ms_10k": (100.0, True), "handle_first_ms_100k": (500.0, True),
    "press_over_solve_10k": (5.0, True), "press_over_solve_100k": (5.0, True),
    "press_factorizations_10k": (8, True),
    "press_again_strength_over_press_100k": (0.15, True), "press_again_limit_over_press_100k": (0.15, True),
    **continuity.find_limits(),
    "ranking_height": (0.9, False), "ranking_given": (0.9, False), "ranking_crossed": (0.9, False),
    "tools_crossed": (1.0, True), "tools_move": (5.0, True), "tools_turned": (0.0, True),
}


def run(executable: str, pattern: str, repetitions: int) -> tuple[dict[str, list[dict]], float]:
    """The runs of every benchmark that matches, and the peak memory of their process in GiB."""
    OUT.mkdir(parents=True, exist_ok=True)
    raw = OUT / f"{executable}.json"
    command = [BUILD / executable, f"--benchmark_filter={pattern}", f"--benchmark_repetitions={repetitions}",
               "--benchmark_enable_random_interleaving=true", f"--benchmark_out={raw}", "--benchmark_out_format=json"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"{executable} {pattern} ended with exit code {os.waitstatus_to_exitcode(status)}")
    runs: dict[str, list[dict]] = {}
    for entry in json.loads(raw.read_text())["benchmarks"]:
        if entry["run_type"] == "iteration":
            runs.setdefault(entry["name"].split("/iterations")[0], []).append(entry)
    return runs, usage.ru_maxrss / 2**20


def medians(runs: dict[str, list[dict]]) -> Times:
    return {name: statistics.median(entry["real_time"] for entry in entries) for name, entries in runs.items()}


def fastest_factor(times: Times, size: str) -> tuple[float, str]:
    """Milliseconds of one analyse and factor with the fastest back end, and its name."""
    prefix = "factor_"
    return min((time, name.split("/")[0].removeprefix(prefix)) for name, time in times.items()
               if name.startswith(prefix) and name.endswith(f"/{size}"))


def solve_rows(times: Times) -> list[Row]:
    rows = []
    for size in ("10k", "100k"):
        factor, back_end = fastest_factor(times, size)
        solve = times[f"solve/{size}"]
        rows.append(Row(f"solve_over_factor_{size}", solve / factor, "",
                        f"solve {solve:.0f} ms / analyse and factor with {back_end} in its own order {factor:.0f} ms, "
                        f"medians of {REPETITIONS}"))
        rows.append(Row(f"warm_step_ms_{size}", times[f"warm_step/{size}"], "ms",
                        f"one drag update, gradient down 100x; 10 updates, median of {REPETITIONS}"))
        whole = times[f"whole_solve/{size}"]
        rows.append(Row(f"whole_solve_ms_{size}", whole, "ms", f"from the bare mesh on, median of {REPETITIONS}"))
    biharmonic, whole = times["biharmonic/100k"], times["whole_solve/100k"]
    rows.append(Row("biharmonic_over_ours_100k", biharmonic / whole, "",
                    f"{biharmonic:.0f} ms / {whole:.0f} ms, both from the bare mesh on, medians of {REPETITIONS}"))
    return rows


def cgal_rows(times: Times) -> list[Row]:
    """CGAL as a release has it, and with its assertions on."""
    rows, ours = [], times["whole_solve/10k"]
    for name, executable in (("cgal_fair", "bench_cgal"), ("cgal_asserting_fair", "bench_cgal_asserting")):
        cgal = medians(run(executable, ".*", REPETITIONS)[0])["cgal_fair/10k"]
        rows.append(Row(f"{name}_over_ours_10k", cgal / ours, "",
                        f"{cgal:.0f} ms / {ours:.0f} ms from the bare mesh on, medians of {REPETITIONS}"))
    return rows


def cage_rows(times: Times) -> list[Row]:
    cage, dense = times["cage_solve"], times["dense_solve"]
    note = f"cage of 2,025 vertices at level 3, median of {REPETITIONS}"
    return [Row("cage_solve_ms", cage, "ms", note),
            Row("cage_vs_dense_ratio", dense / cage, "", f"its surface as a mesh {dense:.0f} ms / cage {cage:.0f} ms"),
            Row("cage_warm_step_ms", times["cage_warm_step"], "ms", f"one drag update of Smooth, {note}")]


def ended(runs: list[dict]) -> bool:
    """Returns whether all runs of a benchmark converged before they were stopped."""
    return all(not run.get("error_occurred") and run["converged"] for run in runs)


def bounded_rows(runs: dict[str, list[dict]]) -> list[Row]:
    """Solves within a limit against free ones of the same noisy panel; of three limits the slowest counts."""
    rows = []
    for name, row in (("bounded", "bounded_over_free"), ("bounded_warm_step", "bounded_warm_over_free")):
        for size in ("10k", "100k"):
            every = {share: runs[f"{name}/{size}/{share}"] for share in ("free", *BOUNDED_SHARES)}
            times = medians(every)
            ratios = {share: times[share] / times["free"] if ended(every[share]) else math.inf
                      for share in BOUNDED_SHARES}
            parts = ", ".join(f"{100 * every[share][0]['touching']:.0f} % of the vertices touching {ratio:.2f}"
                              if ended(every[share]) else "one does not end in time"
                              for share, ratio in ratios.items())
            rows.append(Row(f"{row}_{size}", max(ratios.values()), "",
                            f"{parts}; free {times['free']:.0f} ms, medians of {len(every['free'])}"))
    return rows


def million_rows(times: Times) -> list[Row]:
    """Each run is a process of its own, solves and factorizations by turns, so that the peak is that of one solve."""
    solves, factors, peaks = [], [], []
    for _ in range(MILLION_REPETITIONS):
        runs, peak = run("bench_solve", "^solve/1m", 1)
        solves.append(medians(runs)["solve/1m"])
        peaks.append(peak)
        factors.append(medians(run("bench_solve", "^factor_cholmod/1m", 1)[0])["factor_cholmod/1m"])
    solve, factor, note = statistics.median(solves), statistics.median(factors), f"medians of {MILLION_REPETITIONS}"
    return [Row("solve_over_factor_1m", solve / factor, "",
                f"solve {solve / 1000:.1f} s / analyse and factor with cholmod in its own order {factor / 1000:.1f} s, "
                f"{note} (each takes long)"),
            Row("solve_1m_peak_gib", max(peaks), "GiB", "largest resident set of a process that makes and solves it"),
            Row("growth_100k_to_1m", solve / times["solve/100k"], "",
                f"{solve / 1000:.1f} s / {times['solve/100k']:.0f} ms")]


def strategy_rows(sizes: tuple[int, ...]) -> list[Row]:
    """The paper's strategy and full Newton against ours: geometric means over both problems and all sizes."""
    runs, _ = run("bench_solve", f"^strategy/[a-z_]*/[a-z_]*/({'|'.join(map(str, sizes))})/", REPETITIONS)
    times = medians(runs)
    (OUT / "strategies.json").write_text(json.dumps(
        {name: entries[0] | {"real_time": times[name]} for name, entries in runs.items()}, indent=1))
    raced = [("linearized", goal) for goal in ("", *EARLY_GOALS)] + [("gauss_newton", ""), ("newton", "")]
    return [compare_strategies(runs, times, sizes, other, goal) for other, goal in raced]


def compare_strategies(runs: dict[str, list[dict]], times: Times, sizes: tuple[int, ...], other: str,
                       goal: str) -> Row:
    """Returns how many times as long as ours another strategy takes to the same energy."""
    ratios, missed = [], 0
    for task in TASKS:
        for size in sizes:
            name = f"strategy/{task}/{other}/{size}{goal}"
            missed += runs[name][0]["reached"] == 0
            ratios.append(times[name] / times[f"strategy/{task}/adaptive/{size}{goal}"])
    spread = f"{min(ratios):.1f} to {max(ratios):.1f} over {len(ratios)} problems"
    note = f"to {goal.removeprefix('/') or '1e-8'} of the energy, {spread}, medians of {REPETITIONS}"
    late = f"; {missed} of them not there after 256 steps, and counted with those" if missed else ""
    value = math.exp(statistics.fmean(map(math.log, ratios)))
    return Row(f"adaptive_vs_{other}{goal.replace('/', '_')}", value, "", note + late)


def print_table(rows: list[Row]) -> None:
    print(f"\n{'name':28} {'value':>8} {'unit':4} {'reach':>8}      note")
    for row in rows:
        bound, below = REACH.get(row.name, (math.nan, True))
        met = "" if math.isnan(bound) else "ok" if (row.value <= bound if below else row.value >= bound) else "MISSED"
        reach = "" if math.isnan(bound) else f"{'<=' if below else '>='} {bound:g}"
        print(f"{row.name:28} {row.value:8.2f} {row.unit:4} {reach:>8} {met:6} {row.note}")


def machine() -> str:
    return f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores"


def keep(rows: list[dict]) -> None:
    """Writes the report that the documents quote; a commit that ends in "-dirty" has uncommitted changes."""
    describe = ["git", "describe", "--always", "--dirty", "--exclude=*"]
    commit = subprocess.run(describe, cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout.strip()
    kept = {"date": date.today().isoformat(), "commit": commit, "machine": machine(), "rows": rows}
    KEPT.write_text(json_lines.dump(kept) + "\n")


def asked() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./run bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="without one million unknowns and the largest of Figure 7")
    parser.add_argument("--keep", action="store_true", help="keep the report as the one that the documents quote")
    arguments = parser.parse_args()
    if arguments.quick and arguments.keep:
        parser.error("a quick report lacks rows that the documents quote: keep a full one")
    return arguments


def main() -> None:
    arguments = asked()
    quick = arguments.quick
    times = medians(run("bench_solve", "^(solve|whole_solve|factor_[a-z]*|warm_step|biharmonic)/100?k", REPETITIONS)[0])
    sizes = FIGURE_SIZES[:-1] if quick else FIGURE_SIZES
    cages = medians(run("bench_solve", "^(cage_solve|dense_solve|cage_warm_step)", REPETITIONS)[0])
    bounded = run("bench_solve", "^bounded.*/10k", REPETITIONS)[0] | run("bench_solve", "^bounded.*/100k", 1)[0]
    rows = [*solve_rows(times), *bounded_rows(bounded), *cgal_rows(times), *strategy_rows(sizes), *cage_rows(cages),
            *restoration.rows(), *light_set.rows(), *continuity.rows(), *ranking.rows(), *design_tools.rows(),
            *handle_steps.rows()]
    if not quick:
        rows += [*million_rows(times), *live.rows()]
    values = [asdict(row) | {"value": row.value if math.isfinite(row.value) else None} for row in rows]  # JSON
    (OUT / "report.json").write_text(json_lines.dump(values) + "\n")
    if arguments.keep:
        keep(values)
    print_table(rows)
    load = os.getloadavg()[0]
    print(f"\n{machine()}, load {load:.1f} at the end: ", end="")
    print("a load well above the cores blurs milliseconds." if load > os.cpu_count() + 1 else "quiet.")


if __name__ == "__main__":
    main()
