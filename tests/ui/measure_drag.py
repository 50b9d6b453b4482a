"""How soon the panel follows the mouse, in a window, at 10,000 and 100,000 vertices; how long the window stood still.

Not a test of the lane, as times on a busy machine say nothing. Run it as tests/lanes.py runs the tests of this folder;
the numbers go to build/bench/drag.json. Redraws count in: without a GPU they are most of what is measured.
"""
import json
import sys
import time
from collections.abc import Generator
from pathlib import Path

import bmesh
import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import window  # noqa: E402  (found through the line above)

import dragging  # noqa: E402  (needs what `window` finds)
import scenes  # noqa: E402

OUT = Path(__file__).resolve().parents[2] / "build" / "bench" / "drag.json"
LOOK = 0.01  # seconds between looks at the mesh
STEPS = 12

Steps = Generator[float, None, None]


def height(cells: int) -> float:
    """Of one vertex near the middle, where the panel moves."""
    mesh = bmesh.from_edit_mesh(bpy.context.view_layer.objects.active.data)
    mesh.verts.ensure_lookup_table()
    return mesh.verts[(cells // 2 + cells // 7) * (cells + 1) + cells // 2].co.z


def changed(cells: int, before: float) -> Generator[float, None, tuple[float, float]]:
    """(seconds until the vertex moved, longest time in which the window did nothing)."""
    start = last = time.perf_counter()
    longest = 0.0
    while height(cells) == before and last - start < dragging.PATIENCE:
        yield LOOK
        now = time.perf_counter()
        longest, last = max(longest, now - last), now
    return last - start, longest


def measured(driver: window.Window, cells: int) -> Generator[float, None, dict[str, float]]:
    dragging.panel(driver, cells)
    with driver.override():
        start = time.perf_counter()
        scenes.smooth()
        anew = time.perf_counter() - start
    dragging.panel(driver, cells)
    bpy.context.scene.reflection_lines.stripes.show = False
    before = height(cells)
    yield from dragging.press(driver)
    assert height(cells) != before
    latencies, gaps = [], []
    for step in range(STEPS):
        before = height(cells)
        driver.move(380 - 15 * step, 300)
        latency, gap = yield from changed(cells, before)
        assert height(cells) != before, "the panel does not follow"
        latencies.append(latency)
        gaps.append(gap)
        yield from dragging.settled(driver)
    driver.key('ESC')
    yield 1.0
    return {"vertices": (cells + 1)**2, "p50_ms": 1e3 * float(np.median(latencies)),
            "p95_ms": 1e3 * float(np.quantile(latencies, 0.95)), "still_ms": 1e3 * max(gaps), "anew_ms": 1e3 * anew}


def drags_at_two_sizes(driver: window.Window) -> Steps:
    rows = []
    for cells in (99, 315):
        row = yield from measured(driver, cells)
        print("drag:", {name: round(value, 1) for name, value in row.items()}, flush=True)
        rows.append(row)
    OUT.parent.mkdir(parents=True, exist_ok=True)
    OUT.write_text(json.dumps(rows, indent=1) + "\n")


window.run(drags_at_two_sizes)
