"""Inspect in a real window: Blender goes on meanwhile, Esc cancels, and a click on a spot frames it."""
import sys
import time
from collections.abc import Generator
from pathlib import Path
from tempfile import TemporaryDirectory

import bpy
import numpy as np

import scenes
import window
from window import Steps

CELLS = 100
PATIENCE = 120.0  # seconds
PLACE = (0.4, 0.3)


def dented(x: float, y: float) -> float:
    return scenes.crown(x, y) - 0.002 * float(np.exp(-((x - PLACE[0])**2 + (y - PLACE[1])**2) / 0.06**2))


def begin(driver: window.Window) -> Generator[float, None, bpy.types.Object]:
    """Inspects a panel with a dent as the button does; returns while that is at work."""
    with driver.override():
        if bpy.context.mode != 'OBJECT':
            scenes.object_mode()
        ob = scenes.panel(height=dented, cells=CELLS)
        scenes.look_from_above()
        bpy.context.scene.reflection_lines.stripes.show = True
    driver.move(300, 300)
    yield 0.1
    with driver.override():
        assert bpy.ops.reflines.inspect('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}
    return ob


def wait() -> Generator[float, None, float]:
    """Waits until nothing runs; returns the longest time in which Blender did nothing else."""
    longest, before, begun = 0.0, time.monotonic(), time.monotonic()
    while sys.modules["reflection_lines"].interactive.running_operators._running and before - begun < PATIENCE:
        yield 0.01
        longest, before = max(longest, time.monotonic() - before), time.monotonic()
    yield 0.2
    return longest


def test_blender_goes_on_and_a_spot_is_framed(driver: window.Window) -> Steps:
    ob = yield from begin(driver)
    begun = time.monotonic()
    longest = yield from wait()
    whole = time.monotonic() - begun
    found = ob.reflection_lines.inspection
    assert len(found.spots) == 1
    assert longest < max(0.5 * whole, 0.5), f"Blender stood still for {longest:.2f} s of {whole:.2f} s"
    with driver.override():
        assert bpy.ops.reflines.show_spot('EXEC_DEFAULT', True, index=0) == {'FINISHED'}
    yield 0.3
    assert np.allclose(tuple(driver.region_3d().view_location)[:2], PLACE, atol=0.1)
    assert driver.region_3d().view_distance < 2.0
    assert any(face.select for face in ob.data.polygons) and not all(face.select for face in ob.data.polygons)


def test_escape_cancels(driver: window.Window) -> Steps:
    ob = yield from begin(driver)
    driver.key('ESC')
    yield 0.3
    yield from wait()
    assert not ob.reflection_lines.inspection.summary


def find_file_browser() -> tuple[bpy.types.Window, bpy.types.Area] | None:
    found = [(each, area) for each in bpy.context.window_manager.windows for area in each.screen.areas
             if area.type == 'FILE_BROWSER' and area.spaces.active.params is not None]
    return found[0] if found else None


def wait_for_file_browser() -> Generator[float, None, tuple[bpy.types.Window, bpy.types.Area]]:
    """Waits until Blender's file browser was drawn. Before that it has no list of files, and Blender crashes where its
    button is pressed by a script.
    """
    drawn: list[bool] = []
    handler = bpy.types.SpaceFileBrowser.draw_handler_add(lambda: drawn.append(True), (), 'WINDOW', 'POST_PIXEL')
    while (browser := find_file_browser()) is None or not drawn:
        yield 0.05
    bpy.types.SpaceFileBrowser.draw_handler_remove(handler, 'WINDOW')
    return browser


def begin_film(driver: window.Window, folder: Path) -> Generator[float, None, None]:
    """Writes a film of a panel by Export Film, whose file is chosen in Blender's browser; returns while that is at
    work.
    """
    with driver.override():
        scenes.panel(height=dented, cells=CELLS)
        scenes.look_from_above()
        scene = bpy.context.scene
        scene.render.resolution_x, scene.render.resolution_y = 640, 360
        scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 5, 10
    driver.move(300, 300)
    yield 0.1
    with driver.override():
        assert bpy.ops.reflines.export_film('INVOKE_DEFAULT', filepath=str(folder / "film_.png")) == {
            'RUNNING_MODAL'}
    browser = yield from wait_for_file_browser()
    browser[1].spaces.active.params.directory = str(folder).encode()
    browser[1].spaces.active.params.filename = "film_.png"
    with bpy.context.temp_override(window=browser[0], area=browser[1], region=browser[1].regions[-1]):
        assert bpy.ops.file.execute('INVOKE_DEFAULT') == {'FINISHED'}
    while find_file_browser() is not None:
        yield 0.01


def test_a_film_is_written_beside_blender(driver: window.Window) -> Steps:
    with TemporaryDirectory() as folder:
        yield from begin_film(driver, Path(folder))
        steps, begun = [], time.monotonic()  # of Blender's, and how many frames were there
        while sys.modules["reflection_lines"].interactive.running_operators._running:
            steps.append(len(list(Path(folder).iterdir())))
            assert time.monotonic() - begun < PATIENCE
            yield 0.01
        assert len(list(Path(folder).iterdir())) == 6 and set(steps) >= {0, 1, 2, 3, 4, 5} and len(steps) > 12


def test_escape_ends_a_film_early(driver: window.Window) -> Steps:
    with TemporaryDirectory() as folder:
        yield from begin_film(driver, Path(folder))
        while not list(Path(folder).iterdir()):
            yield 0.02
        driver.key('ESC')
        yield 0.3
        yield from wait()
        assert 1 <= len(list(Path(folder).iterdir())) < 6


def begin_sheet(driver: window.Window, file: Path) -> Generator[float, None, None]:
    """Writes the sheet of a panel as Export Sheet does once its file is chosen; returns while that is at work."""
    with driver.override():
        scenes.panel(height=dented, cells=40)
        scenes.look_from_above()
        assert bpy.ops.reflines.inspect('EXEC_DEFAULT', True) == {'FINISHED'}
    driver.move(300, 300)
    yield 0.1
    with driver.override():
        assert bpy.ops.reflines.export_sheet('EXEC_DEFAULT', filepath=str(file)) == {'RUNNING_MODAL'}


def test_a_sheet_is_written_beside_blender_and_escape_cancels_it(driver: window.Window) -> Steps:
    with TemporaryDirectory() as folder:
        file, running = Path(folder) / "sheet.png", sys.modules["reflection_lines"].interactive.running_operators
        for cancelled in (True, False):
            yield from begin_sheet(driver, file)
            steps, begun = 0, time.monotonic()  # of Blender's
            while running._running and time.monotonic() - begun < PATIENCE:
                steps += 1
                if cancelled and steps == 3:
                    driver.key('ESC')
                yield 0.01
            assert file.exists() != cancelled and (cancelled or steps > 12), steps
