"""What a press of Smooth takes in a Blender in the background: the whole operator, its native call alone, and that over
four objects which gaps part.

    blender -b --factory-startup --python tests/in_blender.py -- tests/bench/live_press.py

Each two are measured by turns on a panel with ripples and noise. Writes build/bench/live_press.json: name -> list of
milliseconds.
"""
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path

import bmesh
import bpy
import numpy as np

import installation
import scenes

ROOT = Path(__file__).resolve().parents[2]

SIZES = {"10k": 99, "100k": 315}  # cells a side
REPETITIONS = 3
NOISE = 1e-5  # root mean square, of a panel of width 2
GAP = 0.008


def milliseconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - start)


def make_bumpy_panel(cells: int) -> bpy.types.Object:
    scenes.remove_all()
    random = np.random.default_rng(5)
    ob = scenes.panel(height=lambda x, y: scenes.rippled(x, y) + NOISE * random.standard_normal(), cells=cells)
    scenes.look_from_above()
    scenes.edit_inner(ob, cells)
    return ob


def put_back(ob: bpy.types.Object, start: list[tuple[float, float, float]]) -> None:
    mesh = bmesh.from_edit_mesh(ob.data)
    for vertex, co in zip(mesh.verts, start, strict=True):
        vertex.co = co
    bmesh.update_edit_mesh(ob.data)


def measure_press(cells: int) -> dict[str, list[float]]:
    native = sys.modules["reflection_lines.native"]
    ob = make_bumpy_panel(cells)
    start = [tuple(vertex.co) for vertex in bmesh.from_edit_mesh(ob.data).verts]
    patch = sys.modules["reflection_lines.read.gather"].gather_patch(ob)
    view = sys.modules["reflection_lines.view.view_and_light"].read_scene_view(bpy.context.scene, patch.center)
    press, alone = [], []
    for _ in range(REPETITIONS):
        # A kept smoother presses in a tenth of the time.
        sys.modules["reflection_lines.state.press_cache"]._presses.clear()
        press.append(milliseconds(scenes.smooth))
        put_back(ob, start)
        alone.append(milliseconds(lambda: native.reflines.smooth_panel(
            patch.V, patch.F, view_direction=view.view_direction, line_direction=view.line_direction)))
    return {"press": press, "press_native": alone}


def build_part(name: str, x: np.ndarray, y: np.ndarray) -> bpy.types.Object:
    """A part of the panel with ripples and noise, at these columns and rows."""
    random = np.random.default_rng(5)
    points = [(a, b, scenes.rippled(a, b) + NOISE * random.standard_normal()) for b in y for a in x]
    first = (np.arange(len(y) - 1)[:, None] * len(x) + np.arange(len(x) - 1)).reshape(-1, 1)
    return scenes.linked(name, points, (first + [0, 1, len(x) + 1, len(x)]).tolist())


def press_parts(cells: int, parts: int) -> float:
    """Builds the panel in parts x parts objects anew, and presses them as one problem."""
    scenes.remove_all()
    ends = np.linspace(-1.0, 1.0, parts + 1)
    sides = [np.linspace(low + 0.5 * GAP, high - 0.5 * GAP, cells // parts + 1)
             for low, high in zip(ends[:-1], ends[1:], strict=True)]
    objects = [build_part(f"Part {i}{j}", x, y) for i, x in enumerate(sides) for j, y in enumerate(sides)]
    scenes.look_from_above()
    scenes.edit(*objects)
    for ob in objects:
        scenes.select_faces(ob, lambda _face: True)
    sys.modules["reflection_lines.state.press_cache"]._presses.clear()
    return milliseconds(lambda: scenes.smooth(border='follow'))


def measure_parts(cells: int) -> dict[str, list[float]]:
    turns = [(press_parts(cells, 1), press_parts(cells, 2)) for _ in range(REPETITIONS)]
    one, four = map(list, zip(*turns, strict=True))
    return {"one_object": one, "four_objects": four}


def main() -> None:
    installation.install()
    times = {f"{name}_{size}": values for size, cells in SIZES.items()
             for name, values in (measure_press(cells) | measure_parts(cells)).items()}
    out = ROOT / "build" / "bench" / "live_press.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(times, indent=1) + "\n")


main()
