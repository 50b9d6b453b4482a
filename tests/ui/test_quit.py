"""Blender is closed while threads are at work: it ends soon and well. What the suite counts is the exit code."""
import sys
from collections.abc import Generator

import bpy

import window
from dragging import panel


def quit_while_a_drag_prepares_and_normals_are_fitted(driver: window.Window) -> Generator[float, None, None]:
    panel(driver, cells=300)
    driver.move(400, 300)
    draw = sys.modules["reflection_lines"].overlay.draw
    for _ in range(100):
        if draw.is_waiting():
            break
        yield 0.02
    assert draw.is_waiting()
    with driver.override():
        assert bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, follow_mouse=True) == {'RUNNING_MODAL'}
    print("1 passed, 0 failed, 0 skipped", flush=True)
    with driver.override():
        bpy.ops.wm.quit_blender()
    yield 600.0

window.start(quit_while_a_drag_prepares_and_normals_are_fitted(window.Window()))
