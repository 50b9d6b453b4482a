"""Where pybind11 looks for the C interface of numpy 1."""
import sys

from .._core import multiarray

sys.modules[f"{__name__}.multiarray"] = multiarray
