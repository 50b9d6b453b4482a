"""The mesh of one object as arrays, with what the artist marked on it: all that a press takes of it, read once."""
from dataclasses import dataclass

import numpy as np

from . import triangulation
from .mirror import Mirror


@dataclass(frozen=True)
class Connectivity:
    """The faces and edges of a mesh."""
    corners: np.ndarray  # vertices of all faces, corner by corner
    sizes: np.ndarray    # #faces: corners of each
    edges: np.ndarray    # #E x 2
    creases: np.ndarray  # #E, 0 to 1


@dataclass(frozen=True)
class MeshSnapshot:
    """The mesh as it was when the press began."""
    name: str            # of the object
    key: str             # the shape key that the result goes to; empty for the mesh itself
    matrix: np.ndarray   # 4 x 4, object to world
    local: np.ndarray    # #vertices x 3, object space: the shape that is solved
    mesh: Connectivity
    triangles: tuple[np.ndarray, np.ndarray] | None  # Blender's, and their faces; None without n-gons
    visible: np.ndarray  # #faces, bool
    region: np.ndarray   # #faces, bool: those that are solved
    marked: np.ndarray   # #E, bool: sharp edges and creases
    crease_rule: str     # "automatic", "marked" or "none"
    border: np.ndarray   # #vertices: codes of the border's own conditions, border.UNSET or border.WRONG
    limit_range: np.ndarray  # #vertices x 2: lowest (-1 to 0) and highest move, fractions of the limit
    mirror: Mirror | None    # of the region's vertices

    @property
    def is_turned(self) -> bool:
        """True where the transform mirrors: it turns triangles over, but not what Blender calls their front."""
        return bool(np.linalg.det(self.matrix[:3, :3]) < 0.0)

    @property
    def world(self) -> np.ndarray:
        """The vertices in world space: #vertices x 3."""
        return self.local @ self.matrix[:3, :3].T + self.matrix[:3, 3]

    def cut_faces(self, faces: np.ndarray, V: np.ndarray) -> np.ndarray:
        """Cuts the faces (#faces, bool) into triangles as Blender does, with the vertices at V: #triangles x 3. Fans
        would give those without area where a corner lies on a line with its neighbours.
        """
        around, sizes = self.mesh.corners[np.repeat(faces, self.mesh.sizes)], self.mesh.sizes[faces]
        if sizes.max() <= 4:
            return triangulation.triangulate_short_faces(around, sizes, V)
        triangles, owners = self.triangles
        return triangles[faces[owners]]
