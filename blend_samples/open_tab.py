"""Opens every sample on the add-on's tab of the sidebar, and saves it so: the end of `./run samples`.

A file keeps which tab is in front, but Blender 3.4 lets no script choose it: it is clicked in a real window.
"""
import os
import pathlib
import sys
import traceback
from collections.abc import Generator

import bpy

import sidebar
import window

HERE = pathlib.Path(__file__).resolve().parent
Steps = Generator[float, None, None]


def open_tab(path: pathlib.Path) -> Steps:
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=True)
    yield 1.5
    yield from sidebar.open_tab(window.Window())
    bpy.ops.wm.save_mainfile(compress=True)


def all_steps() -> Steps:
    """Ends Blender after the last sample; one that is not ended waits for a user for ever."""
    code = 1
    try:
        for path in sorted(HERE.glob("*.blend")):
            yield from open_tab(path)
        code = 0
    except BaseException:  # noqa: BLE001  (a Blender that is not ended waits for a user for ever)
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(code)


bpy.context.preferences.filepaths.save_version = 0  # no copies of the files before
window.start(all_steps())
