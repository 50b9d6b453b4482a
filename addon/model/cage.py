"""The control mesh of a Catmull-Clark surface (the cage) as arrays, and the patch that is solved for it."""
from dataclasses import dataclass

import numpy as np

from .mirror import number_images
from .patch import Patch
from .same import are_same
from .triangulation import list_edges

IN_PLANE_TOLERANCE = 1e-6  # relative to a unit view direction

Option = str | int | bool  # value of an option of the native module


@dataclass(frozen=True)
class Cage:
    """The control mesh that the modifier subdivides, in world space; with a Mirror modifier the other half follows the
    mesh's own.
    """
    V: np.ndarray          # #V x 3
    sizes: np.ndarray      # #faces: corners of each
    corners: np.ndarray    # all corners, counter-clockwise seen from outside
    region: np.ndarray     # #faces, bool
    creases: np.ndarray    # #C x 2
    sharpness: np.ndarray  # #C
    sharp_corners: np.ndarray      # #K
    corner_sharpness: np.ndarray   # #K
    partner: np.ndarray    # #V: mirror images, -1 where there is none
    own_faces: int         # number of the mesh's own faces, which are the first
    rules: tuple[tuple[str, Option], ...]  # the modifier's options as arguments of reflines.CageOptimizer

    def find_vertices(self, faces: np.ndarray) -> np.ndarray:
        """Returns the vertices of faces (#faces, bool): #V, bool."""
        found = np.zeros(len(self.V), dtype=bool)
        found[self.corners[np.repeat(faces, self.sizes)]] = True
        return found

    def find_faces(self, vertices: np.ndarray) -> np.ndarray:
        """Returns the faces that have one of the vertices (#V, bool): #faces, bool."""
        return np.logical_or.reduceat(vertices[self.corners], np.cumsum(self.sizes) - self.sizes)

    def cut_out(self, window: np.ndarray) -> tuple["Cage", np.ndarray]:
        """Cuts out the faces around a window (#faces, bool), on which its surface depends. Returns the cage, whose
        region is the window and which is mirrored nowhere, and the vertices behind its own.
        """
        kept = self.find_faces(self.find_vertices(window))
        vertices = np.flatnonzero(self.find_vertices(kept))
        number = np.full(len(self.V), -1)
        number[vertices] = np.arange(len(vertices))
        sizes, corners = self.sizes[kept], number[self.corners[np.repeat(kept, self.sizes)]]
        creases, sharp = number[self.creases], number[self.sharp_corners]
        edges = np.isin(compute_edge_keys(creases), compute_edge_keys(list_edges(corners, sizes)))
        edges &= (creases >= 0).all(axis=1)
        own = Cage(self.V[vertices], sizes, corners, window[kept], creases[edges], self.sharpness[edges],
                   sharp[sharp >= 0], self.corner_sharpness[sharp >= 0], np.full(len(vertices), -1), len(sizes),
                   self.rules)
        return own, vertices

    def build_topology_arguments(self) -> dict[str, Option | np.ndarray]:
        """Builds the arguments of reflines.Subdivision but the count of vertices."""
        names = ("face_offsets", "face_vertices", "creases", "crease_sharpness", "corners", "corner_sharpness",
                 "level", "limit", "boundary")
        arguments = self.build_arguments(True)
        return {name: arguments[name] for name in names}

    def build_arguments(self, symmetric: bool) -> dict[str, Option | np.ndarray | None]:
        """Builds the arguments of reflines.CageOptimizer.

        Where the view is not in the mirror plane only the mesh's own half is solved; its seam is then a border across
        which the surface stays smooth.
        """
        region = self.region & (symmetric | (np.arange(len(self.region)) < self.own_faces))
        offsets = np.append(0, np.cumsum(self.sizes))
        return dict(self.rules, V=self.V, face_offsets=offsets, face_vertices=self.corners, region=region,
                    creases=self.creases, crease_sharpness=self.sharpness, corners=self.sharp_corners,
                    corner_sharpness=self.corner_sharpness, partner=self.partner if symmetric else None,
                    image_of=np.arange(len(self.sizes)) % self.own_faces)


@dataclass(frozen=True)
class CagePatch(Patch):
    """The region of a cage, with all of the cage around it."""
    cage: Cage
    mirror_axis: int  # axis of the object normal to the mirror plane; -1: none

    def same(self, other: Patch) -> bool:
        return super().same(other) and are_same(self.cage, other.cage)

    def is_symmetric_for(self, view_direction: np.ndarray) -> bool:
        """Returns whether moves along the view keep the cage symmetric."""
        along = np.linalg.solve(self.matrix[:3, :3], view_direction)
        return self.mirror_axis >= 0 and abs(along[self.mirror_axis]) <= IN_PLANE_TOLERANCE * np.linalg.norm(along)


def mirror_cage(local: np.ndarray, axis: int, merge: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mirrors positions as the modifier does: both halves, the image of each vertex of the first, and the images in
    both.

    Vertices within `merge` of the plane are merged with their image.
    """
    seam = 2.0 * np.abs(local[:, axis]) <= merge
    sign = np.where(np.arange(3) == axis, -1.0, 1.0)
    own = np.where(seam[:, None] & (sign < 0.0), 0.0, local)
    return np.concatenate([own, own[~seam] * sign]), *number_images(seam)


def reverse_faces(corners: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Reverses the order of every face's corners."""
    starts = np.repeat(np.cumsum(sizes) - sizes, sizes)
    ends = starts + np.repeat(sizes, sizes) - 1
    return corners[starts + ends - np.arange(len(corners))]


def compute_edge_keys(edges: np.ndarray) -> np.ndarray:
    """Returns a number for each edge (#E x 2), equal for those of the same two vertices."""
    low, high = edges.min(axis=1), edges.max(axis=1)
    return low.astype(np.int64) * 2**32 + high
