"""The patch: the region of one mesh as arrays, and the way back to the mesh."""
from dataclasses import dataclass, field

import numpy as np

from . import mirror
from .beside import Beside
from .creases import Creases
from .mirror import Mirror
from .refusal import Refusal
from .same import are_same
from .surroundings import Surroundings

# What of a patch an optimizer is built from; the rest is the way back to the mesh.
SOLVED = ("V", "F", "mirror", "matrix", "creases", "border", "around", "limit_range", "beside")


@dataclass(frozen=True)
class Patch:
    """The region of one object as the solver takes it, and what writing the result needs."""
    name: str            # name of the object
    faces: np.ndarray    # #mesh faces, bool: the region
    index: np.ndarray    # #V: the mesh vertex behind each vertex of the region
    local: np.ndarray    # #V x 3, object space
    V: np.ndarray        # #V x 3, world space
    F: np.ndarray        # #F x 3, oriented so that normals point outwards in world space
    face_of_triangle: np.ndarray  # #F: the mesh's face that each was cut from
    matrix: np.ndarray   # 4 x 4, object to world
    key: str             # the shape key that the result goes to; empty for the mesh itself
    mirror: Mirror | None
    creases: Creases
    border: np.ndarray   # #V: codes of the border's own conditions, border.UNSET where the tool's holds
    around: Surroundings
    limit_range: np.ndarray | None  # #V x 2: lowest (-1 to 0) and highest move, fractions of the limit; None: all of it
    beside: Beside | None = field(default=None, kw_only=True)  # what the border can follow, where it is to

    @property
    def panels(self) -> "tuple[Patch, ...]":
        """The patches of single objects that this one stands for."""
        return (self,)

    @property
    def center(self) -> np.ndarray:
        """The centre of the bounding box, with the image that a Mirror modifier adds.

        Unlike the mean of the vertices it does not depend on how densely the mesh is subdivided.
        """
        return 0.5 * sum(self.bounds_with_image)

    @property
    def bounds_with_image(self) -> tuple[np.ndarray, np.ndarray]:
        """The lowest and highest corner of the box around it, with the image that a Mirror modifier adds."""
        own = compute_bounds(self.V)
        if self.mirror is None or not self.mirror.image or self.mirror.axis < 0:
            return own
        image = compute_bounds(self.to_world(self.local * self.mirror.sign))
        return np.minimum(own[0], image[0]), np.maximum(own[1], image[1])

    @property
    def local_center(self) -> np.ndarray:
        """The centre in object space."""
        return np.linalg.solve(self.matrix, np.append(self.center, 1.0))[:3]

    @property
    def diagonal(self) -> float:
        """The length of the bounding box's diagonal, without the image."""
        low, high = compute_bounds(self.V)
        return float(np.linalg.norm(high - low))

    def measure_area(self) -> float:
        """Measures the area of the triangles, square world units."""
        a, b, c = (self.V[self.F[:, k]] for k in range(3))
        return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())

    def to_world(self, local: np.ndarray) -> np.ndarray:
        """Transforms #points x 3 from object space to world space."""
        return local @ self.matrix[:3, :3].T + self.matrix[:3, 3]

    def to_local(self, points: np.ndarray) -> np.ndarray:
        """Transforms #points x 3 from world space to object space."""
        return (points - self.matrix[:3, 3]) @ np.linalg.inv(self.matrix[:3, :3]).T

    def mirror_points(self, points: np.ndarray) -> np.ndarray:
        """Returns the mirror images of points in world space: #points x 3."""
        return self.to_world(self.to_local(points) * self.mirror.sign)

    def round_start_positions(self) -> np.ndarray:
        """Returns the positions that the mesh had, as Blender stores them: #V x 3 float32, object space."""
        return self.local.astype(np.float32)

    def to_object_space(self, positions: np.ndarray) -> np.ndarray:
        """Transforms solved positions to object space: #V x 3 float32.

        The move is transformed and added to the old coordinates, so that rounding moves no vertex across the view.
        Refuses what float32 cannot hold.
        """
        move = (positions - self.V) @ np.linalg.inv(self.matrix[:3, :3]).T
        exact = self.local + move
        if not (np.abs(exact) < np.finfo(np.float32).max).all():
            raise Refusal(f"{self.name}: the result lies too far away to be stored, so nothing was changed: "
                          "ask for less, or apply the object's scale")
        new = exact.astype(np.float32)
        return new if self.mirror is None else mirror.restore_symmetry(self.mirror, new, self.local)

    def same(self, other: "Patch") -> bool:
        """Returns whether an optimizer built for one patch serves the other."""
        return type(self) is type(other) and all(are_same(getattr(self, name), getattr(other, name)) for name in SOLVED)


def compute_bounds(V: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the lowest and highest corner of the bounding box, by columns, which is ten times faster in numpy than by
    rows.
    """
    columns = np.ascontiguousarray(V.T)
    return columns.min(axis=1), columns.max(axis=1)
