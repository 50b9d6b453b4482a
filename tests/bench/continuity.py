"""The rows of the press as a function of its input: by how much the move differs where nothing visible does.

Measured by the judge of ../shared/continuity on five analytic panels, which shares no code with the solver.

    PYTHONPATH=addon:tests python3 -m bench.continuity    prints the rows
"""
import contextlib
import importlib.util
import io
from pathlib import Path
from types import ModuleType

from bench.row import Row

JUDGE = Path(__file__).resolve().parents[3] / "shared/continuity/continuity.py"
UNITS = {"facets": "deg"}
NOTES = {"shake": "heights shaken by 2e-7 of the size", "jitter": "x and y jittered by 1e-7 and 1e-5 on one surface",
         "corners": "triangles begin at their next corner", "diagonals": "quads cut the other way",
         "scale": "scenes of 0.001, 0.1 and 1000 times the size",
         "again": "largest move of a second press, of the first's",
         "grows": "1 where a later press moves further than one before",
         "symmetry": "left against right of a dent at 0",
         "number": "unevenness and score from 40 to 160 cells a side", "facets": "degrees that a mesh's facets add"}


def load_judge() -> ModuleType:
    spec = importlib.util.spec_from_file_location("continuity", JUDGE)
    judge = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(judge)
    return judge


def find_limits() -> dict[str, tuple[float, bool]]:
    """Returns what is aimed at, by row, as bench.report has it; empty where the judge is not there."""
    if not JUDGE.exists():
        return {}
    return {f"continuity_{kind}": (limit, True) for kind, limit in load_judge().LIMITS.items()}


def rows() -> list[Row]:
    if not JUDGE.exists():
        return []
    judge = load_judge()
    worst: dict[str, float] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        for name, height in judge.PANELS.items():
            judge.try_panel(name, height, worst)
        judge.try_number(worst)
    return [Row(f"continuity_{kind}", float(value), UNITS.get(kind, ""), f"{NOTES[kind]}; worst of the judge's panels")
            for kind, value in worst.items()]


if __name__ == "__main__":
    for row in rows():
        print(f"{row.name:28} {row.value:8.3f} {row.unit:4} {row.note}")
