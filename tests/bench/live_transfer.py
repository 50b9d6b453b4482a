"""What the add-on's own work costs in Edit Mode, in a Blender in the background: mesh transfer, and a drag's solves.

    blender -b --factory-startup --python tests/in_blender.py -- tests/bench/live_transfer.py

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

import installation
import scenes

ROOT = Path(__file__).resolve().parents[2]

SIZES = {"10k": 99, "100k": 315}  # cells a side
REPETITIONS = 9
STEPS = 24
LIMITED = 0.1  # of the largest move at full strength
DAB_RADIUS = 0.08  # of a panel of 2 x 2: 500 of 100,000 vertices

Times = dict[str, list[float]]


def addon(name: str) -> object:
    return sys.modules[f"reflection_lines.{name}"]


def milliseconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - start)


def fresh_panel(cells: int) -> bpy.types.Object:
    scenes.remove_all()
    ob = scenes.panel(cells=cells)
    scenes.look_from_above()
    scenes.edit_inner(ob, cells)
    return ob


def transfer(cells: int) -> Times:
    """Every vertex of the region is moved, which is the most that can be written."""
    ob = fresh_panel(cells)
    gather, write = addon("read.gather").gather_patch, addon("write.write_mesh").write_solution
    patch = gather(ob)
    moves = [patch.V + [0.0, 0.0, 1e-4 * k] for k in range(1, REPETITIONS + 1)]
    return {"gather": [milliseconds(lambda: gather(ob)) for _ in range(REPETITIONS)],
            "blender_copy": [milliseconds(ob.update_from_editmode) for _ in range(REPETITIONS)],
            "apply": [milliseconds(partial(write, ob, patch, move)) for move in moves]}


def request(patch: object, strength: float, limit: float = 0.0) -> object:
    smooth = addon("targets.smooth")
    length = addon("solver.solve").choose_length(patch, 0.0)
    build = partial(smooth.build_smooth_target, settings=smooth.Smooth(length, strength))
    settings = addon("model.solution").SolveSettings('clamped', length, limit=limit)
    return addon("interactive.solve_job").SolveRequest((build,), (settings,))


def solves(cells: int) -> Times:
    """One from the bare mesh, and those of a drag of the strength, 15 pixels a step, without a limit that is reached
    and within a share of the largest move.
    """
    patch = addon("read.gather").gather_patch(fresh_panel(cells))
    cache = addon("state.optimizer_cache")
    view = addon("view.view_and_light").read_scene_view(bpy.context.scene, patch.center)
    first = request(patch, 1.0)
    solve = milliseconds(lambda: cache.solve_with_cache(patch, view, first.settings[0], first.builds[0]))
    cache._optimizers.clear()
    job = addon("interactive.solve_job").SolveJob((patch,), (view,), 'clamped')

    def serve(wanted: object) -> object:
        return addon("native_call").run_now(job.run(wanted))

    ready = milliseconds(partial(serve, first))
    def drag(limit: float) -> list[float]:
        return [milliseconds(partial(serve, request(patch, strength, limit)))
                for strength in np.linspace(0.95, 0.0, STEPS)]

    limit = LIMITED * np.abs(job.followers[0].heights - job.starts[0].optimizer.heights).max()
    steps = {"step": drag(0.0)}
    serve(first)
    return {"solve": [solve], "ready": [ready], **steps, "limited_step": drag(limit)}


def dabs(cells: int) -> Times:
    """Dabs of Fair Brush along a stroke: place, window, solve; without writing the mesh."""
    patch = addon("read.gather").gather_patch(fresh_panel(cells))
    brush, view = addon("solver.brush"), addon("view.facing").read_patch_view(bpy.context.scene, patch)
    brushed = brush.BrushedPatch(patch, view, "clamped")
    settings = brush.Brush(DAB_RADIUS, strength=0.5, length=0.3, limit=1.0, families=2)
    return {"dab": [milliseconds(partial(brushed.dab, np.array([x, 0.1, 0.0]), settings))
                    for x in np.linspace(-0.4, 0.4, STEPS)]}


def main() -> None:
    installation.install()
    times = {f"{name}_{size}": values for size, cells in SIZES.items()
             for name, values in (transfer(cells) | solves(cells) | dabs(cells)).items()}
    out = ROOT / "build" / "bench" / "live_transfer.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(times, indent=1) + "\n")


main()
