"""The faces around a region, from which its border takes the curvature."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Surroundings:
    """Triangles beside a region of n vertices; F names the region's by 0 .. n - 1, and those of V by n and more."""
    V: np.ndarray  # #S x 3, world space
    F: np.ndarray  # #G x 3, oriented as the region's

    def same(self, other: "Surroundings") -> bool:
        return np.array_equal(self.V, other.V) and np.array_equal(self.F, other.F)


NOTHING_AROUND = Surroundings(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))


def join_images(around: Surroundings, mirrored: np.ndarray, seam: np.ndarray, own: int, image: np.ndarray,
                joined: int) -> Surroundings:
    """Joins the surroundings of a region with their mirror images: `mirrored` are the positions of those (#S x 3),
    `seam` the vertices on the plane (#S, bool), which are their own images, `own` the number of the region's vertices,
    `image` (#own) the vertex of the joined region at each one's image, and `joined` the number of its vertices.
    """
    first = np.where(own <= around.F, around.F - own + joined, around.F)
    numbers = np.arange(len(around.V))
    second = np.where(seam, numbers, len(around.V) + np.cumsum(~seam) - 1)
    name = np.concatenate([image, joined + second])
    return Surroundings(np.concatenate([around.V, mirrored[~seam]]),
                        np.concatenate([first, name[around.F][:, ::-1]]))
