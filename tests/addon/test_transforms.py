"""The same surface in the world gives the same result, whatever transform its object has."""
import bpy
import numpy as np
import pytest
from mathutils import Matrix

import scenes


def smoothed(matrix: Matrix) -> np.ndarray:
    """The moves (#V x 3) in the world of a panel whose object carries a transform."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    ob = scenes.panel()
    scenes.look_from_above()
    scenes.transformed(ob, matrix)
    before = scenes.world(ob)
    scenes.edit_inner(ob)
    scenes.smooth(length=0.5)
    scenes.object_mode()
    return scenes.world(ob) - before


@pytest.fixture(scope="module")
def expected() -> np.ndarray:
    return smoothed(Matrix())


@pytest.mark.parametrize("name", [name for name in scenes.TRANSFORMS if name != "none"])
def test_the_transform_does_not_matter(name, expected) -> None:
    # Coordinates are rounded to float32 twice, in the object's space: about 1e-6 for these scales; that noise of the
    # surface itself is then smoothed away with the dents.
    assert np.abs(expected).max() > 1e-3
    assert np.abs(smoothed(scenes.TRANSFORMS[name]) - expected).max() < 5e-5
