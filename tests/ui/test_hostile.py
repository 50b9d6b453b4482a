"""Hostile scenes and tampered files in a window: stripes, marks and panels are drawn, or say why not. What Blender
prints of errors in drawing goes to the standard error.
"""
import os
import sys
import tempfile
from collections.abc import Callable

import bpy

import hostile_files
import hostile_scenes
import scenes
import sidebar
import window
from errors import read_errors
from picture import drawn
from window import Steps

# Not drawn: what tools alone read, and a second value where there is one.
UNSEEN = ("record", "run: ", "handles: ", "endless ")
FOLDER = tempfile.mkdtemp()
PATH, SOLVED = (os.path.join(FOLDER, name) for name in ("hostile.blend", "solved.blend"))


def draw_modes(driver: window.Window) -> Steps:
    """As it is, and as a map of the last solve with the shape before."""
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.show = True
    yield from drawn(driver)
    stripes.mode, stripes.before = 'DEVIATION', True
    yield from drawn(driver)


def draw_other_mode(driver: window.Window) -> Steps:
    """With an image, in Object Mode where it was in Edit Mode."""
    mode = bpy.context.view_layer.objects.active.mode
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT' if mode == 'EDIT' else 'EDIT')
    bpy.context.scene.reflection_lines.stripes.mode = 'IMAGE'
    yield from drawn(driver)


def clear(driver: window.Window) -> None:
    """Away with all, the scene's settings too; the window stays."""
    with driver.override():
        if bpy.context.mode != 'OBJECT':
            bpy.ops.object.mode_set(mode='OBJECT')
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True, load_ui=False)
    driver.window = bpy.context.window_manager.windows[0]


def show_scene(driver: window.Window, build: Callable[[], bpy.types.Object]) -> Steps:
    with driver.override():
        build()
    yield from draw_modes(driver)
    yield from draw_other_mode(driver)


def show_file(driver: window.Window, change: Callable[[bpy.types.Object], None]) -> Steps:
    with driver.override():
        bpy.ops.wm.open_mainfile(filepath=SOLVED, load_ui=False)
    driver.window = bpy.context.window_manager.windows[0]
    with driver.override():
        change(bpy.data.objects["Panel"])
        hostile_files.save_past_the_addon(PATH)
        bpy.ops.wm.open_mainfile(filepath=PATH, load_ui=False)
    yield 0.05
    driver.window = bpy.context.window_manager.windows[0]
    with driver.override():
        scenes.activate(next(ob for ob in bpy.data.objects if ob.type == 'MESH'))
    yield from draw_modes(driver)


def show_each(driver: window.Window, show: Callable, every: dict[str, Callable]) -> Steps:
    wrong = []
    for name, one in every.items():
        written = yield from read_errors(show(driver, one))
        clear(driver)
        if "Traceback" in written:
            print(f"{name}:\n{written}", flush=True)
            wrong.append(name)
    assert not wrong, wrong


def test_scenes_are_drawn(driver: window.Window) -> Steps:
    yield from sidebar.open_tab(driver)  # stays open
    yield from show_each(driver, show_scene, hostile_scenes.SCENES)


def test_files_are_drawn(driver: window.Window) -> Steps:
    with driver.override():
        scenes.edited_panel()
        scenes.smooth()
        scenes.object_mode()
        sys.modules["reflection_lines.state.persistence"].save_solves()
        scenes.settings().stripes.show = True
        hostile_files.save_past_the_addon(SOLVED)
    yield from show_each(driver, show_file, {name: change for name, change in hostile_files.FILES.items()
                                             if not name.startswith(UNSEEN)})
