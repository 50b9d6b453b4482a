"""Every test starts in an empty scene, with the add-on enabled."""
import bpy
import pytest


@pytest.fixture(autouse=True)
def empty_scene() -> None:
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
