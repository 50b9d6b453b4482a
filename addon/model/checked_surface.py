"""A surface that is checked: its shape before and after, with what lies around the region."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class CheckedSurface:
    """The triangles of a whole mesh, or of the surface of a whole cage, in world space."""
    before: np.ndarray  # #V x 3
    after: np.ndarray   # #V x 3
    F: np.ndarray       # #F x 3
    region: np.ndarray  # #F, bool
    creases: dict[str, str | np.ndarray]  # arguments of reflines.check
