"""Rows of what an artist waits for, measured inside Blender: mesh transfer, presses, neighbours, drags, Escape,
stripes.
"""
import json
import os
import statistics
import subprocess
import time
from pathlib import Path

import suites

from bench.row import Row

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "build/bench"
PATIENCE = 1200  # seconds for a script

Times = dict[str, list[float]]


def measured(name: str, command: list[str]) -> Times:
    """What a script of this folder leaves in build/bench."""
    out = OUT / f"{name}.json"
    out.unlink(missing_ok=True)
    subprocess.run([*command, *suites.script_options(f"tests/bench/{name}.py")], cwd=ROOT, check=True,
                   env=suites.blender_environment(), timeout=PATIENCE, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return json.loads(out.read_text())


def p95(values: list[float]) -> float:
    return sorted(values)[max(0, round(0.95 * len(values)) - 1)]


def share(times: Times) -> float:
    middle = statistics.median
    return (middle(times["gather_100k"]) + middle(times["apply_100k"])) / times["solve_100k"][0]


def transfer_rows(times: Times) -> list[Row]:
    middle = statistics.median
    copy = f"Blender's own copy out of Edit Mode {middle(times['blender_copy_100k']):.0f} ms of it"
    solve = times["solve_100k"][0]
    return [Row("gather_ms_100k", middle(times["gather_100k"]), "ms", f"in Edit Mode, {copy}; median of 9"),
            Row("apply_ms_100k", middle(times["apply_100k"]), "ms", "all vertices moved, with normals; median of 9"),
            Row("gather_apply_over_solve_100k", share(times), "", f"of {solve:.0f} ms from the bare mesh on"),
            Row("brush_dab_ms_100k", middle(times["dab_100k"]), "ms",
                f"Fair Brush over 500 vertices, median of {len(times['dab_100k'])}; the slowest "
                f"{max(times['dab_100k']):.0f} ms"),
            *(Row(f"drag_solve_p95_ms_{size}", p95(times[f"step_{size}"]), "ms",
                  f"of the job: target, solve, positions; median {middle(times[f'step_{size}']):.0f} ms of "
                  f"{len(times[f'step_{size}'])} steps") for size in ("10k", "100k")),
            *(limited_row(times, size) for size in ("10k", "100k"))]


def limited_row(times: Times, size: str) -> Row:
    """Of the same steps within a limit, all but the last few of which would move farther."""
    free, limited = (statistics.median(times[f"{name}_{size}"]) for name in ("step", "limited_step"))
    return Row(f"drag_limited_over_free_{size}", limited / free, "",
               f"{limited:.0f} ms / {free:.0f} ms of the same job, medians of {len(times[f'step_{size}'])} steps")


def drag_rows(times: Times, size: str) -> list[Row]:
    drawn, undrawn = times[f"latency_drawn_{size}"], times[f"latency_undrawn_{size}"]
    worked = times[f"processor_undrawn_{size}"]
    return [Row(f"drag_p95_ms_{size}", p95(drawn), "ms",
                f"mouse to mesh in a window with stripes, drawn by the processor; window still for at most "
                f"{max(times[f'still_drawn_{size}']):.0f} ms, median {statistics.median(drawn):.0f} ms"),
            Row(f"drag_undrawn_p95_ms_{size}", p95(undrawn), "ms",
                f"the same with an empty image in place of the 3D view; median {statistics.median(undrawn):.0f} ms"),
            Row(f"drag_still_ms_{size}", max(times[f"still_undrawn_{size}"]), "ms",
                f"longest time in which the window did nothing, in {len(undrawn)} of these steps"),
            Row(f"drag_processor_ms_{size}", statistics.median(worked), "ms",
                f"of Blender's main thread in such a step, whatever else the machine does; median of {len(worked)}")]


def feel_rows(times: Times) -> list[Row]:
    control, thread, kicks = times["escape_control"], times["escape_thread"], times["kick"]
    return [Row("escape_ms_100k", max(control), "ms",
                f"until the next key has worked, which alone takes up to {max(times['escape_alone']):.0f} ms; the "
                f"thread ends after at most {max(thread):.0f} ms; {len(control)} times while a drag prepares"),
            Row("drag_hysteresis", times["hysteresis"][0], "", "of the panel's size, after a closed path"),
            Row("drag_kick", max(kicks) / min(kicks), "", "largest over smallest move at equal steps of the mouse"),
            Row("stripes_ms_400k", statistics.median(times["stripes_400k"]), "ms",
                "of the main thread, for a moved vertex of 400,000 triangles: reading, normals, upload")]


def press_rows(times: Times) -> list[Row]:
    rows = []
    for size in ("10k", "100k"):
        press, alone = (statistics.median(times[f"{name}_{size}"]) for name in ("press", "press_native"))
        rows.append(Row(f"press_over_native_{size}", press / alone, "",
                        f"{press:.0f} ms / {alone:.0f} ms on a panel with ripples and noise, in Edit Mode, by turns; "
                        f"medians of {len(times[f'press_{size}'])}"))
        one, four = (statistics.median(times[f"{name}_{size}"]) for name in ("one_object", "four_objects"))
        rows.append(Row(f"four_objects_over_one_{size}", four / one, "",
                        f"{four:.0f} ms / {one:.0f} ms: the panel cut in four objects, pressed as one problem, and "
                        f"whole, by turns; medians of {len(times[f'one_object_{size}'])}"))
    return rows


def neighbour_rows(times: Times) -> list[Row]:
    beside, unjoined, check = (statistics.median(times[name]) for name in ("beside", "unjoined", "check"))
    return [Row("neighbours_ms", beside + unjoined, "ms",
                f"a press reads what lies beside {beside:.0f} ms, finds edges that lie on others {unjoined:.0f} ms; "
                f"Check reads {check:.0f} ms; medians of {len(times['beside'])}")]


def rows() -> list[Row]:
    background = measured("live_transfer", [suites.BLENDER, "-b", "--factory-startup"])
    press = measured("live_press", [suites.BLENDER, "-b", "--factory-startup"])
    neighbours = measured("live_neighbours", [suites.BLENDER, "-b", "--factory-startup"])
    window = measured("live_drag", suites.window_command())
    load = os.getloadavg()[0]
    print(f"live rows at {time.strftime('%H:%M')}: load {load:.1f} on {os.cpu_count()} cores", flush=True)
    return [*transfer_rows(background), *press_rows(press), *neighbour_rows(neighbours),
            *drag_rows(window, "10k"), *drag_rows(window, "100k"), *feel_rows(window)]


if __name__ == "__main__":
    for row in rows():
        print(f"{row.name:30} {row.value:10.4g} {row.unit:4} {row.note}")
