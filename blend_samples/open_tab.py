"""Opens every sample on the add-on's tab of the sidebar, and saves it so: the end of `./run samples`.

A file keeps which tab is in front, but Blender 3.4 lets no script choose it: it is clicked in a real window.
"""
import pathlib

import bpy

import sidebar
import window
from window import Steps

HERE = pathlib.Path(__file__).resolve().parent


def open_tab(path: pathlib.Path) -> Steps:
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=True)
    yield 1.5
    yield from sidebar.open_tab(window.Window())
    bpy.ops.wm.save_mainfile(compress=True)


def open_all(_: window.Window) -> Steps:
    for path in sorted(HERE.glob("*.blend")):
        yield from open_tab(path)


bpy.context.preferences.filepaths.save_version = 0  # no copies of the files before
window.start(window.all_steps((open_all,)))
