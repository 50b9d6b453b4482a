"""How fast a window with stripes is drawn by a GPU: at rest, in an orbit, under a turning light, and in drags.

    blender --factory-startup --enable-event-simulate --window-geometry 0 0 1920 1080 \
        --python tests/in_blender.py -- tests/bench/live_window.py [--software] [--frames N] [CELLS...]

Needs a display whose OpenGL is the GPU's own (under Xvfb with NVIDIA's driver: __GLX_VENDOR_LIBRARY_NAME=nvidia and
__GL_SYNC_TO_VBLANK=0); ends with code 75 where the processor draws, which --software permits. Draws the bonnet of
blend_samples and panels of CELLS cells a side (315 and 999: 99,856 and 1,000,000 vertices). Writes
build/bench/live_window.json after each part: name -> list of milliseconds, one a frame, a step or a gap.

Names are PART_PANEL_MODE_SHOWN_MOTION. SHOWN: stripes off, on, or both sides of Compare with Before. MOTION: nothing
changes (rest: after eight frames Blender keeps its own picture of the mesh), the view turns (orbit), the light turns
(light). `window`: the whole window drawn and swapped; `sweep`: between two frames of Sweep Light under a moving mouse.
"""
import argparse
import json
import os
import sys
import time
from collections.abc import Callable, Generator
from math import pi, radians, sin
from pathlib import Path

import bmesh
import bpy
import gpu
import numpy as np
from mathutils import Quaternion

import dragging
import pulling
import scenes
import window

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "build" / "bench" / "live_window.json"
SAMPLE = ROOT / "blend_samples" / "hood.blend"

NO_GPU = 75
PROCESSORS = ("llvmpipe", "softpipe", "swrast", "SwiftShader")
CELLS = (315, 999)
SOLVED = 100              # cells a side of the middle that is smoothed, to have a shape before
FRAMES, WARM = 100, 10    # frames that count, and those before
STEP = radians(0.2)       # of view or light from frame to frame
VIEW_DISTANCE = 2.6       # at which a panel fills the window's height
SHARE_OF_DRAG = 0.06      # of the view's height, to each side
DRAG_TIME = 5.0           # seconds
MOUSE_INTERVAL = 0.008    # seconds between two moves of a usual mouse
STEPS = 20
PATIENCE = 120.0

Steps = Generator[float, None, None]
Times = dict[str, list[float]]
Motion = Callable[[int], None]


def now() -> float:
    """Milliseconds."""
    return 1e3 * time.perf_counter()


def stripes() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines.stripes


class Stamps:
    """Notes when the 3D view was drawn."""

    def __init__(self) -> None:
        self.times: list[float] = []
        self.handle = bpy.types.SpaceView3D.draw_handler_add(lambda: self.times.append(now()), (), 'WINDOW',
                                                             'POST_PIXEL')

    def end(self) -> list[float]:
        """Ends the notes; returns the milliseconds from frame to frame."""
        bpy.types.SpaceView3D.draw_handler_remove(self.handle, 'WINDOW')
        return np.diff(self.times).tolist()


class Bench:
    """All measurements, and what they found so far."""

    def __init__(self, driver: window.Window, arguments: argparse.Namespace) -> None:
        self.driver, self.frames, self.cells = driver, arguments.frames, arguments.cells or CELLS
        self.times: Times = {}

    def keep(self, name: str, values: list[float]) -> None:
        self.times[name] = values
        OUT.parent.mkdir(parents=True, exist_ok=True)
        OUT.write_text(json.dumps(self.times) + "\n")
        low = sorted(values)
        print(f"{name:44} median {low[len(low) // 2]:8.2f} p95 {low[max(0, round(0.95 * len(low)) - 1)]:8.2f} "
              f"worst {low[-1]:8.2f} ms of {len(low)}", flush=True)

    def settled(self) -> Steps:
        """Waits until the normals are fitted, and draws what has changed."""
        draw = sys.modules["reflection_lines"].overlay.draw
        self.driver.redraw()
        yield 0.5
        while draw.is_waiting():
            yield 0.1
        self.driver.redraw()
        yield 0.3

    def draw_frames(self, motion: Motion, count: int) -> list[float]:
        times = []
        with self.driver.override():
            for number in range(count + WARM):
                start = now()
                motion(number)
                bpy.ops.wm.redraw_timer(type='DRAW_WIN_SWAP', iterations=1)
                times.append(now() - start)
        return times[WARM:]

    def motions(self) -> dict[str, Motion]:
        view, settings = self.driver.region_3d(), bpy.context.scene.reflection_lines
        rotation, turn = view.view_rotation.copy(), settings.light_turn

        def orbit(number: int) -> None:
            view.view_rotation = rotation @ Quaternion((0.0, 0.0, 1.0), STEP * number)

        def turn_light(number: int) -> None:
            settings.light_turn = turn + STEP * number
            bpy.context.view_layer.update()

        return {"rest": lambda _number: None, "orbit": orbit, "light": turn_light}

    def measure(self, name: str) -> Steps:
        """All that is shown in all motions, of the present object and mode."""
        turn, rotation = bpy.context.scene.reflection_lines.light_turn, self.driver.region_3d().view_rotation.copy()
        for shown in ("off", "on", "before"):
            stripes().show, stripes().before = shown != "off", shown == "before"
            yield from self.settled()
            for kind, motion in self.motions().items():
                self.keep(f"window_{name}_{shown}_{kind}", self.draw_frames(motion, self.frames))
                bpy.context.scene.reflection_lines.light_turn = turn
                self.driver.region_3d().view_rotation = rotation
                yield 0.1
            yield from self.settled()
            yield from window.take_picture(self.driver, f"{name}_{shown}")
        stripes().before = False
        yield from self.swept(name)

    def swept(self, name: str) -> Steps:
        """Frames of Blender's own loop while Sweep Light follows a mouse that never rests."""
        driver = self.driver
        driver.move(driver.region().width / 2, driver.region().height / 2)
        yield 0.3
        with driver.override():
            bpy.ops.reflines.sweep_light('INVOKE_DEFAULT')
        yield 0.3
        stamps, start = Stamps(), now()
        while len(stamps.times) <= self.frames + WARM and now() - start < 1e3 * PATIENCE:
            driver.x += 1 if len(stamps.times) % 200 < 100 else -1
            driver.event('MOUSEMOVE')
            yield 0.0
        driver.key('ESC')
        yield 0.5
        self.keep(f"sweep_{name}", stamps.end()[WARM:])

    def sample(self) -> Steps:
        """The bonnet, in Edit Mode as it opens, and smoothed."""
        bpy.ops.wm.open_mainfile(filepath=str(SAMPLE), load_ui=True)
        yield 2.0
        self.driver = driver = window.Window()
        with driver.override():
            bpy.context.preferences.view.smooth_view = 0
            driver.region_3d().view_rotation = bpy.context.scene.reflection_lines.camera.matrix_world.to_quaternion()
            driver.region_3d().view_perspective = 'PERSP'
            bpy.ops.view3d.view_selected()
            assert scenes.smooth() == {'FINISHED'}
        print(f"view {driver.region().width} x {driver.region().height} of a window "
              f"{driver.window.width} x {driver.window.height}", flush=True)
        yield from self.measure("hood_edit")

    def panel(self, cells: int) -> Steps:
        """A panel in both modes, whose middle is smoothed."""
        begin = now()
        ob = dragging.panel(self.driver, cells)
        with self.driver.override():
            self.driver.region_3d().view_distance = VIEW_DISTANCE
            scenes.select_faces(ob, scenes.inner(cells, max(1, (cells - SOLVED) // 2)))
            assert scenes.smooth() == {'FINISHED'}
            scenes.object_mode()
        print(f"{len(ob.data.vertices)} vertices, made and smoothed in {1e-3 * (now() - begin):.0f} s", flush=True)
        yield from self.measure(f"{len(ob.data.vertices)}_object")
        with self.driver.override():
            scenes.edit(ob)
        yield from self.measure(f"{len(ob.data.vertices)}_edit")

    def height(self, cells: int) -> float:
        """Of the vertex in the middle, under the mouse."""
        mesh = bmesh.from_edit_mesh(bpy.context.view_layer.objects.active.data)
        mesh.verts.ensure_lookup_table()
        return mesh.verts[(cells // 2) * (cells + 1) + cells // 2].co.z

    def dragged(self, name: str, cells: int, begin: Callable[[], Steps], across: tuple[float, float]) -> Steps:
        """Single steps, from the move of the mouse until the moved mesh is drawn, and then a mouse that never rests."""
        driver = self.driver
        dragging.panel(driver, cells)
        driver.region_3d().view_distance = VIEW_DISTANCE
        yield from self.settled()
        yield from begin()
        middle = driver.region().x + driver.region().width // 2, driver.region().y + driver.region().height // 2
        size = SHARE_OF_DRAG * driver.region().height

        def move(share: float) -> None:
            driver.x, driver.y = (int(m + share * size * a) for m, a in zip(middle, across, strict=True))
            driver.event('MOUSEMOVE')

        stamps, latencies = Stamps(), []
        for number in range(STEPS):
            before, start = self.height(cells), now()
            move(0.1 + number / STEPS)
            while self.height(cells) == before:
                assert now() - start < 1e3 * PATIENCE, "the panel does not follow"
                yield 0.0
            drawn = len(stamps.times)
            while len(stamps.times) == drawn:
                yield 0.0
            latencies.append(stamps.times[-1] - start)
            yield 0.2
        stamps.end()
        self.keep(f"{name}_latency", latencies)
        yield from window.take_picture(driver, name)
        yield from self.hurried(name, cells, move)
        driver.key('ESC')
        yield 1.0

    def hurried(self, name: str, cells: int, move: Callable[[float], None]) -> Steps:
        """A mouse that never rests: between two frames, between two shapes, and the turns of Blender's loop."""
        stamps, start, turns, shapes = Stamps(), now(), [], []
        moved = last = start
        height = self.height(cells)
        while last - start < 1e3 * DRAG_TIME:
            if last - moved > 1e3 * MOUSE_INTERVAL:
                moved = last
                move(sin(pi * 1e-3 * (last - start)))
            yield 0.0
            turns.append(now() - last)
            last += turns[-1]
            if self.height(cells) != height:
                height = self.height(cells)
                shapes.append(last)
        self.keep(f"{name}_frame", stamps.end())
        self.keep(f"{name}_shape", np.diff(shapes).tolist())
        self.keep(f"{name}_still", turns)

    def begin_smooth(self) -> Steps:
        driver = self.driver
        driver.move(driver.region().width // 2, driver.region().height // 2)
        yield 0.5
        with driver.override():
            bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, follow_mouse=True)
        yield 0.2
        yield from dragging.settled(driver)

    def begin_pull(self) -> Steps:
        driver = self.driver
        yield from pulling.begin(driver)
        yield from pulling.move(driver, driver.region().width // 2, driver.region().height // 2)
        driver.event('LEFTMOUSE', 'PRESS')
        yield 0.3

    def all(self) -> Steps:
        bpy.context.preferences.view.smooth_view = 0
        for cells in self.cells:
            yield from self.panel(cells)
        cells = self.cells[0]
        size = (cells + 1) ** 2
        yield from self.dragged(f"pull_{size}", cells, self.begin_pull, (0.0, 1.0))
        yield from self.dragged(f"smooth_{size}", cells, self.begin_smooth, (-1.0, 0.0))
        yield from self.sample()


def read_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="live_window.py")
    parser.add_argument("--software", action="store_true", help="measure where the processor draws, too")
    parser.add_argument("--frames", type=int, default=FRAMES)
    parser.add_argument("cells", type=int, nargs="*", help="cells a side of each panel; the first is dragged, too")
    return parser.parse_args()


def frames(driver: window.Window) -> Steps:
    arguments, renderer = read_arguments(), gpu.platform.renderer_get()
    print(f"drawn by {renderer}, {gpu.platform.version_get()}", flush=True)
    if any(name in renderer for name in PROCESSORS) and not arguments.software:
        print("the processor draws: nothing is measured", flush=True)
        os._exit(NO_GPU)
    yield 0.1
    yield from Bench(driver, arguments).all()


window.start(window.all_steps((frames,)))  # drawn as Blender draws for a user: with smooth edges
