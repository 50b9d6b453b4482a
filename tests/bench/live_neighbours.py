"""What it takes to find the neighbours of a panel with 10,000 border vertices in a scene of a million faces, in a
Blender in the background.

    blender -b --factory-startup --python tests/in_blender.py -- tests/bench/live_neighbours.py

Four panels, all with the same number of faces: two lie across a gap from the panel's long sides, one touches its end.
Writes build/bench/live_neighbours.json: name -> list of milliseconds.
"""
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

import installation
import scenes

OUT = Path(__file__).resolve().parents[2] / "build/bench/live_neighbours.json"
COLUMNS, ROWS = 4950, 50  # cells of a panel: 10,000 border vertices, 247,500 faces
STEP, GAP = 0.001, 0.002
REPETITIONS = 5


def build_panel(name: str, x: float, y: float) -> bpy.types.Object:
    columns, rows = x + STEP * np.arange(COLUMNS + 1), y + STEP * np.arange(ROWS + 1)
    across, along = np.meshgrid(columns, rows)
    V = np.stack([across, along, 0.01 * across**2 + 0.1 * along**2], axis=2).reshape(-1, 3)
    first = (np.arange(ROWS)[:, None] * (COLUMNS + 1) + np.arange(COLUMNS)).reshape(-1, 1)
    F = first + [0, 1, COLUMNS + 2, COLUMNS + 1]
    return scenes.linked(name, V.tolist(), F.tolist())


def milliseconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - start)


def measure() -> dict[str, list[float]]:
    read, model = (sys.modules[f"reflection_lines.{name}"] for name in ("read", "model"))
    scenes.remove_all()
    ob, width = build_panel("Panel", 0.0, 0.0), STEP * ROWS
    for name, x, y in (("Above", 0.0, width + GAP), ("Below", 0.0, -width - GAP), ("Beyond", STEP * COLUMNS, 0.0)):
        build_panel(name, x, y)
    scenes.activate(ob)
    bpy.context.view_layer.update()
    purpose = read.mesh_checks.Purpose.READ
    patch = read.gather.gather_patch(ob, or_all=True, purpose=purpose)
    snapshot = read.read_snapshot.read_snapshot(ob, "", None, or_all=True, purpose=purpose)
    crossing = model.beside.Crossing(everywhere=True)
    return {name: [milliseconds(work) for _ in range(REPETITIONS)] for name, work in {
        "beside": lambda: read.read_beside.read_beside(ob, snapshot, patch, crossing),
        "unjoined": lambda: read.unjoined_border.find_unjoined(bpy.context.scene, ob, patch, within=False),
        "check": lambda: model.steps.finish(read.read_beside.read_neighbors(ob, patch.V)),
    }.items()}


def main() -> None:
    installation.install()
    OUT.parent.mkdir(parents=True, exist_ok=True)
    OUT.write_text(json.dumps(measure(), indent=1) + "\n")


main()
