"""What the add-on's own work costs in Edit Mode, in a Blender in the background: mesh transfer, and a drag's solves.

    blender -b --factory-startup --python-exit-code 1 --python tests/bench/live_transfer.py

Writes build/bench/live_transfer.json: name -> list of milliseconds.
"""
import json
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "addon"))

import installation  # noqa: E402  (found through the line above)
import scenes  # noqa: E402

SIZES = {"10k": 99, "100k": 315}  # cells a side
REPETITIONS = 9
STEPS = 24

Times = dict[str, list[float]]


def addon(name: str) -> object:
    return sys.modules[f"reflection_lines.{name}"]


def milliseconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - start)


def fresh_panel(cells: int) -> bpy.types.Object:
    if bpy.context.mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    ob = scenes.panel(cells=cells)
    scenes.look_from_above()
    scenes.edit_inner(ob, cells)
    return ob


def transfer(cells: int) -> Times:
    """Every vertex of the region is moved, which is the most that can be written."""
    ob = fresh_panel(cells)
    gather, apply = addon("bridge.gather").gather, addon("bridge.apply").apply
    panel = gather(ob)
    moves = [panel.V + [0.0, 0.0, 1e-4 * k] for k in range(1, REPETITIONS + 1)]
    return {"gather": [milliseconds(lambda: gather(ob)) for _ in range(REPETITIONS)],
            "blender_copy": [milliseconds(ob.update_from_editmode) for _ in range(REPETITIONS)],
            "apply": [milliseconds(partial(apply, ob, panel, move)) for move in moves]}


def request(panel: object, strength: float) -> object:
    solving, smooth, pursuit = addon("solving"), addon("targets.smooth"), addon("drag.pursuit")
    length = solving.length_of(panel, 0.0)
    build = partial(smooth.target, settings=smooth.Smooth(length, strength))
    return pursuit.Request((build,), solving.Settings('clamped', length))


def solves(cells: int) -> Times:
    """One from the bare mesh, and those of a drag of the strength, 15 pixels a step."""
    panel = addon("bridge.gather").gather(fresh_panel(cells))
    session = addon("session")
    view = session.view_of(bpy.context.scene, panel.center)
    first = request(panel, 1.0)
    solve = milliseconds(lambda: session.solve(panel, view, first.settings, first.builds[0]))
    session.forget()
    pursuit = addon("drag.pursuit").Pursuit((panel,), (view,), 'clamped')
    ready = milliseconds(lambda: pursuit.run(first))
    requests = [request(panel, strength) for strength in np.linspace(0.95, 0.0, STEPS)]
    steps = [milliseconds(partial(pursuit.run, wanted)) for wanted in requests]
    return {"solve": [solve], "ready": [ready], "step": steps}


def main() -> None:
    installation.install()
    times = {f"{name}_{size}": values for size, cells in SIZES.items()
             for name, values in (transfer(cells) | solves(cells)).items()}
    out = ROOT / "build" / "bench" / "live_transfer.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(times, indent=1) + "\n")


main()
