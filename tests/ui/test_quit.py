"""Blender is closed while threads are at work: it ends soon and well. What the lane counts is the exit code."""
import sys
from collections.abc import Generator
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))

import window  # noqa: E402  (found through the line above)

from dragging import panel  # noqa: E402  (needs what `window` finds)


def quit_while_a_drag_prepares_and_normals_are_fitted(driver: window.Window) -> Generator[float, None, None]:
    panel(driver, cells=300)
    driver.move(400, 300)
    draw = sys.modules["reflection_lines"].draw
    for _ in range(100):
        if draw.is_waiting():
            break
        yield 0.02
    assert draw.is_waiting()
    with driver.override():
        assert bpy.ops.reflines.smooth('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}
    print("1 passed, 0 failed, 0 skipped", flush=True)
    with driver.override():
        bpy.ops.wm.quit_blender()
    yield 600.0

window.start(quit_while_a_drag_prepares_and_normals_are_fitted(window.Window()))
