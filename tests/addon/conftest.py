"""Fixtures of all tests: every one starts in an empty scene, with the add-on enabled."""
import bpy
import pytest

import scenes


@pytest.fixture(autouse=True)
def empty_scene() -> None:
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)


@pytest.fixture
def panel() -> bpy.types.Object:
    """Returns a rippled panel of 16 x 16 faces in Edit Mode, its inner faces selected, seen from above."""
    return scenes.edited_panel()
