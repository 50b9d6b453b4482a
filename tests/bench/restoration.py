"""The rows of the press of Smooth: harm to clean panels, remainder of planted flaws, moves of clean cages, and cost.

Harm and remainder are measured by the judge of ../shared/restoration, which shares no code with the solver, on the real
panels beside it; without them only the cost is measured.

    PYTHONPATH=addon:tests python3 -m bench.restoration    prints the rows
"""
import importlib.util
import json
import statistics
import time
from pathlib import Path
from types import ModuleType

import numpy as np
import reflines

from bench.row import Row

ROOT = Path(__file__).resolve().parents[2]
JUDGE = ROOT.parent / "shared/restoration/restoration.py"
REPETITIONS = 3
CELLS, LARGE = 99, 315
LIGHTS = ("given", "crossed")


def load_judge() -> ModuleType:
    spec = importlib.util.spec_from_file_location("restoration", JUDGE)
    judge = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(judge)
    return judge


def load_panel(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns V, F, view and light of a real panel."""
    judge = load_judge()
    panel = read_panels(cages=False)[name]
    return (*judge.load(panel["file"], panel.get("patch")), judge.unit(panel["view_direction"]),
            judge.unit(panel["light_across"]))


def read_panels(*, cages: bool) -> dict[str, dict]:
    panels = json.loads((JUDGE.parent / "selections.json").read_text())
    return {name: panel for name, panel in panels.items() if panel["cage"] == cages}


def panel_rows() -> list[Row]:
    judge = load_judge()
    results = [judge.judge(panel, judge.present) for panel in read_panels(cages=False).values()]
    harm = np.array([result["harm"] for result in results])
    note = f"median of {len(results)} real panels"
    rows = [Row("restoration_harm_worst", float(harm.max()), "deg", f"worst of {len(results)} panels, two lights"),
            Row("restoration_move", max(result["move"] for result in results), "%",
                "largest move on a clean panel, of its diagonal")]
    for light, name in enumerate(LIGHTS):
        rows.append(Row(f"restoration_harm_{name}", float(np.median(harm[:, light])), "deg", note))
        rows += [Row(f"restoration_{kind}_{name}", statistics.median(result[kind][light] for result in results), "",
                     f"share of the error that is left, {note}") for kind in judge.FLAWS]
    return rows


def read_cage(panel: dict, selected: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns positions, face offsets, corners and the mask of the selected faces."""
    lines = [line.split() for line in (JUDGE.parent.parent / "meshes" / panel["file"]).read_text().splitlines()]
    V = np.array([line[1:4] for line in lines if line and line[0] == "v"], float)
    faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line and line[0] == "f"]
    region = np.zeros(len(faces), bool)
    region[panel[selected]] = True
    return V, np.cumsum([0] + [len(face) for face in faces]), np.concatenate(faces), region


def cage_row() -> Row:
    """Returns the largest move of the surface of a clean cage, over the panels and what a careless selection takes."""
    moves = {}
    for name, panel in read_panels(cages=True).items():
        for selected in ("patch", "box"):
            V, offsets, corners, region = read_cage(panel, selected)
            _, report = reflines.smooth_cage_panel(V, offsets, corners, region=region,
                                                   view_direction=panel["view_direction"],
                                                   line_direction=panel["light_across"])
            moves[f"{name}, {selected}"] = 1000 * report.largest_move
    worst = max(moves, key=moves.get)
    return Row("restoration_cage_move", moves[worst], "mm", f"largest on {len(moves)} clean selections: {worst}")


def make_noisy_panel(cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns vertices and triangles of a dome; the noise is a hundredth of an edge."""
    x, y = (grid.ravel() for grid in np.meshgrid(*2 * [np.linspace(-0.5, 0.5, cells + 1)]))
    noise = 0.01 / cells * np.random.default_rng(5).standard_normal(len(x))
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    a, b, c, d = corner, corner + 1, corner + cells + 2, corner + cells + 1
    F = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.int32)
    return np.stack([x, y, -0.15 * x**2 - 0.1 * y**2 + noise], 1), F


def press_row(name: str, cells: int) -> Row:
    """Returns how many times as long a press takes as a whole solve from the bare mesh, by turns; the making of the
    solve's target does not count, as in `whole_solve_ms`.
    """
    V, F = make_noisy_panel(cells)
    seen = {"view_direction": (0, 0, 1), "line_direction": (0, 1, 0)}

    target = reflines.smooth(reflines.ShapeOptimizer(V, F, **seen), length=0.1)

    def solve() -> None:
        reflines.ShapeOptimizer(V, F, **seen).solve(target)

    times: dict[str, list[float]] = {"press": [], "solve": []}
    for _ in range(REPETITIONS):
        for work, run in (("press", lambda: reflines.smooth_panel(V, F, **seen)), ("solve", solve)):
            start = time.perf_counter()
            run()
            times[work].append(1000 * (time.perf_counter() - start))
    press, whole = (statistics.median(times[work]) for work in ("press", "solve"))
    return Row(f"press_over_solve_{name}", press / whole, "",
               f"{press:.0f} ms / {whole:.0f} ms from the bare mesh on, medians of {REPETITIONS}")


def work_row() -> Row:
    """Returns how many matrices a press factors, which no machine's noise changes."""
    V, F = make_noisy_panel(CELLS)
    work = reflines.smooth_panel(V, F, view_direction=(0, 0, 1), line_direction=(0, 1, 0))[1].work
    return Row("press_factorizations_10k", work.factorizations, "", f"and {work.solves} solves of one column")


def again_rows(name: str, cells: int) -> list[Row]:
    """Returns how long a press with another strength, and with another limit, takes of the first one: the second press
    with each, whose matrix has to be factored again, does not count.
    """
    V, F = make_noisy_panel(cells)
    smoother = reflines.PanelSmoother(V, F, view_direction=(0, 0, 1), line_direction=(0, 1, 0))

    def press(**amount: float) -> tuple[float, float]:
        start = time.perf_counter()
        _, told = smoother.press(**amount)
        return 1000 * (time.perf_counter() - start), told.largest_move

    first, move = press()
    press(strength=0.9)
    rows = []
    for title, amounts in (("strength", [{"strength": share} for share in (0.5, 0.6, 0.7)]),
                           ("limit", [{"limit": share * move} for share in (0.5, 0.6, 0.7)])):
        again = statistics.median(press(**amount)[0] for amount in amounts)
        rows.append(Row(f"press_again_{title}_over_press_{name}", again / first, "",
                        f"{again:.0f} ms / {first:.0f} ms, another {title}; median of 3"))
    return rows


def set_row() -> Row:
    """Returns how many times as long a press for eight lights, two from each of four eyes, takes as one for one."""
    V, F = make_noisy_panel(CELLS)
    eyes, lines = reflines.walk_around((0, 0, 1), (0, 1, 0))
    many = reflines.LightSet(np.tile(lines[[0, 4]], (4, 1)), np.repeat(eyes[:4], 2, axis=0))
    times: dict[int, list[float]] = {8: [], 1: []}
    for _ in range(REPETITIONS):
        for count, taken in times.items():
            start = time.perf_counter()
            reflines.smooth_panel(V, F, view_direction=(0, 0, 1), line_direction=(0, 1, 0), lights="single",
                                  light_set=many if count == 8 else None)
            taken.append(1000 * (time.perf_counter() - start))
    all_of_them, one = (statistics.median(times[count]) for count in (8, 1))
    return Row("families_over_one_8", all_of_them / one, "",
               f"a press at 10k from four eyes: {all_of_them:.0f} ms / {one:.0f} ms, medians of {REPETITIONS}")


def lights_row() -> Row:
    """Returns how many times as long a press for two lights takes as one for one, by turns."""
    V, F = make_noisy_panel(CELLS)
    times: dict[str, list[float]] = {"crossed": [], "single": []}
    for _ in range(REPETITIONS):
        for lights, taken in times.items():
            start = time.perf_counter()
            reflines.smooth_panel(V, F, view_direction=(0, 0, 1), line_direction=(0, 1, 0), lights=lights)
            taken.append(1000 * (time.perf_counter() - start))
    two, one = (statistics.median(times[lights]) for lights in ("crossed", "single"))
    return Row("two_lights_over_one", two / one, "",
               f"a press at 10k: {two:.0f} ms / {one:.0f} ms, medians of {REPETITIONS}")


def rows() -> list[Row]:
    return [*([*panel_rows(), cage_row()] if JUDGE.is_file() else []), lights_row(), set_row(),
            press_row("10k", CELLS), press_row("100k", LARGE),
            *again_rows("100k", LARGE), work_row()]


if __name__ == "__main__":
    for row in rows():
        print(f"{row.name:28} {row.value:8.3f} {row.unit:4} {row.note}")
