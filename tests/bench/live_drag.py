"""Drags of Smooth in a window: how soon the panel follows, how long the window stands still, what Escape takes.

Run as tests/suites.py runs the tests of a window. Writes build/bench/live_drag.json: name -> list of milliseconds, or
of lengths as shares of the panel's size. Each size is dragged twice: drawn, with stripes, and with an empty image in
the place of the 3D view, which leaves Blender little to draw. Without a GPU drawing is most of what is measured.
"""
import json
import sys
import time
from collections.abc import Generator
from pathlib import Path

import bmesh
import bpy
import numpy as np

import dragging
import scenes
import window

ROOT = Path(__file__).resolve().parents[2]

SIZES = {"10k": 99, "100k": 315}  # cells a side
STRIPED = 447                     # cells a side with 400,000 triangles
LOOK = 0.01                       # seconds between looks
STEPS = 8
WIDTH = 2.0                       # of the panel
ESCAPES = (0.0, 0.7, 2.0)  # seconds after the press: while it builds, smooths and factors
PATIENCE = 120.0

Steps = Generator[float, None, None]
Times = dict[str, list[float]]


def height(cells: int) -> float:
    """Of one vertex near the middle, where the panel moves."""
    mesh = bmesh.from_edit_mesh(bpy.context.view_layer.objects.active.data)
    mesh.verts.ensure_lookup_table()
    return mesh.verts[(cells // 2 + cells // 7) * (cells + 1) + cells // 2].co.z


def changed(cells: int, before: float) -> Generator[float, None, tuple[float, float, float]]:
    """Milliseconds until the vertex moved, the longest time in which the window did nothing, and of the processor that
    Blender's main thread took."""
    start = last = time.perf_counter()
    longest, worked = 0.0, time.thread_time()
    while height(cells) == before:
        assert last - start < PATIENCE, "the panel does not follow"
        yield LOOK
        now = time.perf_counter()
        longest, last = max(longest, now - last), now
    return 1e3 * (last - start), 1e3 * longest, 1e3 * (time.thread_time() - worked)


def pressed(driver: window.Window, cells: int, times: Times, name: str) -> Steps:
    """Until the panel has followed the first time."""
    dragging.panel(driver, cells)
    driver.move(400, 300)
    yield 1.0
    before = height(cells)
    with driver.override():
        bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, follow_mouse=True)
    for what, value in zip(("ready", "ready_still"), (yield from changed(cells, before)), strict=False):
        times[f"{what}_{name}"] = [value]


def dragged(driver: window.Window, cells: int, name: str) -> Generator[float, None, Times]:
    times: Times = {}
    yield from pressed(driver, cells, times, name)
    view = driver.area()
    if name.startswith("undrawn"):
        view.type = 'IMAGE_EDITOR'
        yield 0.5
    moves = []
    for _ in range(STEPS):
        before = height(cells)
        driver.x -= 15
        driver.event('MOUSEMOVE')
        moves.append((yield from changed(cells, before)))
        yield 0.3
    view.type = 'VIEW_3D'
    driver.key('ESC')
    yield 1.0
    for what, values in zip(("latency", "still", "processor"), zip(*moves, strict=True), strict=True):
        times[f"{what}_{name}"] = list(values)
    return times


def closed_path(driver: window.Window) -> Generator[float, None, Times]:
    """Where it ends against where it began, and the way of the panel at equal steps of the mouse."""
    dragging.panel(driver, SIZES["10k"])
    yield from dragging.press(driver)
    driver.move(250, 300)
    yield from dragging.settled(driver)
    first = last = dragging.shown(driver)
    kicks = []
    for x in (220, 190, 160, 130, 600, 20, 250):
        driver.move(x, 300)
        yield from dragging.settled(driver)
        now = dragging.shown(driver)
        kicks.append(float(np.abs(now - last).max()) / WIDTH)
        last = now
    driver.key('ESC')
    yield 0.5
    return {"hysteresis": [float(np.abs(last - first).max()) / WIDTH], "kick": kicks[:4]}


def escaped(driver: window.Window, after: float) -> Generator[float, None, tuple[float, float, float]]:
    """Milliseconds from Escape until the next key works (N: the sidebar), until the thread has ended, and what that key
    takes when nothing is at work; undrawn."""
    dragging.panel(driver, SIZES["100k"])
    driver.move(400, 300)
    yield 1.0
    view, worker = driver.area(), sys.modules["reflection_lines"].background_work
    with driver.override():
        bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, follow_mouse=True)
    view.type = 'IMAGE_EDITOR'
    yield after
    space, start, control, ended = view.spaces.active, time.perf_counter(), 0.0, 0.0
    shown = space.show_region_ui
    driver.key('ESC')
    driver.key('N')
    while not (control and ended):
        yield LOOK
        now = 1e3 * (time.perf_counter() - start)
        control = control or now * (space.show_region_ui != shown)
        ended = ended or now * (control > 0.0 and not bpy.app.timers.is_registered(worker.end_stopped_works))
    yield 0.5
    start = time.perf_counter()
    driver.key('N')
    while space.show_region_ui != shown:
        yield LOOK
    alone = 1e3 * (time.perf_counter() - start)
    view.type = 'VIEW_3D'
    yield 0.5
    return control, ended, alone


def stripes_rebuilt(driver: window.Window) -> Generator[float, None, list[float]]:
    """Reading, comparing and uploading 400,000 triangles, one vertex of which has moved: time of the processor."""
    draw, times = sys.modules["reflection_lines"].overlay.draw, []
    dragging.panel(driver, STRIPED)
    with driver.override():
        scenes.object_mode()
    yield 2.0
    while draw.is_waiting():
        yield 0.2
    ob, settings = bpy.context.view_layer.objects.active, bpy.context.scene.reflection_lines.stripes
    settings.show = False
    shown = draw.ShownObject(draw.find_address(ob))

    def measure() -> None:
        shown.stale, start = True, time.thread_time()
        draw.refresh_object(shown, ob, settings, bpy.context.evaluated_depsgraph_get())
        times.append(1e3 * (time.thread_time() - start))

    handle = bpy.types.SpaceView3D.draw_handler_add(measure, (), 'WINDOW', 'POST_VIEW')
    for _ in range(6):
        ob.data.vertices[STRIPED * STRIPED // 2].co.z += 1e-3
        ob.data.update()
        driver.redraw()
        yield 0.5
        while draw.is_waiting():
            draw.poll_fits()
            yield 0.2
    bpy.types.SpaceView3D.draw_handler_remove(handle, 'WINDOW')
    return times[1:]  # the first reads the triangles too, which stay


def drags(driver: window.Window) -> Steps:
    times: Times = {}
    for size, cells in SIZES.items():
        for kind in ("undrawn", "drawn"):
            found = yield from dragged(driver, cells, f"{kind}_{size}")
            print({name: round(float(np.median(values)), 1) for name, values in found.items()}, flush=True)
            times |= found
    escapes = []
    for after in ESCAPES:
        escapes.append((yield from escaped(driver, after)))
    for what, values in zip(("control", "thread", "alone"), zip(*escapes, strict=True), strict=True):
        times[f"escape_{what}"] = list(values)
    times |= yield from closed_path(driver)
    times["stripes_400k"] = yield from stripes_rebuilt(driver)
    out = ROOT / "build" / "bench" / "live_drag.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(times, indent=1) + "\n")


window.start(window.all_steps((drags,)))  # drawn as Blender draws for a user: with smooth edges
