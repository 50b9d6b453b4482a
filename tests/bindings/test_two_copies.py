"""The module twice in one process, as where a legacy add-on and an extension are both enabled in one Blender."""
import importlib.machinery
import importlib.util
import shutil
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, panel, rippled


@pytest.fixture(scope="module")
def other(tmp_path_factory: pytest.TempPathFactory) -> ModuleType:
    copy = tmp_path_factory.mktemp("copy") / Path(reflines.__file__).name
    shutil.copy(reflines.__file__, copy)
    loader = importlib.machinery.ExtensionFileLoader("copy.reflines", str(copy))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("copy.reflines", loader))
    loader.exec_module(module)
    return module


def solved(module: ModuleType) -> np.ndarray:
    positions, triangles = panel(16)
    solver = module.ShapeOptimizer(rippled(positions, amplitude=1e-3, wavelength=0.3), triangles, view_direction=VIEW,
                                   line_direction=LINE)
    assert solver.solve(module.smooth(solver, length=0.5), progress=module.Progress()).converged
    return solver.positions


def test_both_work(other):
    assert other.ShapeOptimizer is not reflines.ShapeOptimizer
    assert np.array_equal(solved(other), solved(reflines))


def test_each_raises_its_own_errors(other):
    for module, stranger in ((reflines, other), (other, reflines)):
        with pytest.raises(module.InvalidInput) as raised:
            module.image_plane(VIEW, VIEW)
        assert not isinstance(raised.value, stranger.InvalidInput)
