"""Triangulated surfaces: in object space as the stripes are drawn on them, in world space as they are checked."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Topology:
    """A triangulation with the data that determine it: the triangles stay while corners, sizes and visible faces do."""
    corners: np.ndarray     # #corners: their vertices
    sizes: np.ndarray       # #faces
    shown: np.ndarray       # #faces, bool
    triangles: np.ndarray   # #F x 3
    faces: np.ndarray       # #F: the face of each

    def same(self, corners: np.ndarray, sizes: np.ndarray, shown: np.ndarray) -> bool:
        """Returns whether the triangulation still holds for these corners, sizes and visible faces."""
        return (np.array_equal(self.corners, corners) and np.array_equal(self.sizes, sizes)
                and np.array_equal(self.shown, shown))


@dataclass(frozen=True)
class Surface:
    """A surface as the viewport shows it."""
    V: np.ndarray         # #V x 3
    topology: Topology
    selected: np.ndarray  # #F, bool
    normals: np.ndarray | None = None  # #V x 3, where they are known without a fit

    @property
    def F(self) -> np.ndarray:
        return self.topology.triangles


@dataclass(frozen=True)
class CheckedSurface:
    """The triangles of a whole mesh, or of the surface of a whole cage, in world space."""
    before: np.ndarray  # #V x 3
    after: np.ndarray   # #V x 3
    F: np.ndarray       # #F x 3
    region: np.ndarray  # #F, bool
    creases: dict[str, str | np.ndarray]  # arguments of reflines.check
