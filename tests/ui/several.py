"""Runs several files of window tests in one Blender, each with the scene and the screen that Blender starts with:

    blender ... -P tests/in_blender.py -- tests/ui/several.py FILE...

Starting Blender takes longer than many files. What a test leaves in the add-on's memory meets the next file, as in the
session of an artist who opens one file after another.
"""
import runpy
import sys
from pathlib import Path

import bpy

import window

SMOOTH_VIEW = bpy.context.preferences.view.smooth_view  # milliseconds, as Blender begins with
Files = dict[str, list[window.Test]]


def collect_tests(paths: list[str]) -> Files:
    """Reads the tests of the files."""
    return {Path(path).stem: window.find_tests(runpy.run_path(path, run_name="__main__")) for path in paths}


def begin_anew(first: window.Test, name: str) -> window.Test:
    """Returns the first test of a file, before which what Blender starts with is loaded."""
    def test(_driver: window.Window) -> window.Steps:
        print(f"-- {name}", flush=True)
        bpy.ops.wm.read_homefile(use_factory_startup=True)
        window.draw_sparingly()
        bpy.context.preferences.view.show_splash = False
        bpy.context.preferences.view.smooth_view = SMOOTH_VIEW
        yield 0.5
        yield from first(window.Window())
    test.__name__ = first.__name__
    return test


def list_tests(files: Files) -> list[window.Test]:
    return [test for name, (first, *others) in files.items() for test in (begin_anew(first, name), *others)]


window.run(*list_tests(collect_tests(sys.argv[1:])))
