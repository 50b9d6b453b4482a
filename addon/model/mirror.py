"""The mirror symmetry of a region: with the image that a Mirror modifier adds, or in itself by Blender's option Mirror
X.

Where view and light are symmetric about the plane too, the best shape is symmetric. A region below a modifier is then
solved together with its image, one that is symmetric in itself as it is. The native solver moves mirror images alike;
one side is copied to the other at last, since object space rounds them differently. Where view or light are not
symmetric, the seam of a Mirror modifier is clamped: both halves then still join smoothly.
"""
from dataclasses import dataclass, field

import numpy as np

SYMMETRY_TOLERANCE = 1e-6  # relative to a unit vector, and to the size of the region


@dataclass(frozen=True)
class Mirror:
    """The symmetry plane and the pairs of vertices."""
    axis: int            # axis of the object normal to the plane; -1: several planes
    partner: np.ndarray  # #V: each vertex's image in the region, itself on the plane, -1 where it has none
    image: bool          # True: a modifier adds the image; False: the region contains it
    merge_distance: float = 0.0  # object space: vertices no further from the plane are joined with their images
    # 4 x 4, world space: takes what has one plane of a modifier to its image.
    reflection: np.ndarray | None = field(default=None, compare=False)

    @property
    def seam(self) -> np.ndarray:
        """The mask of vertices on the plane: #V, bool."""
        return self.partner == np.arange(len(self.partner))

    @property
    def is_whole(self) -> bool:
        """True where the region and its image can be solved as one."""
        return self.axis >= 0 and (self.partner >= 0).all() != self.image

    @property
    def sign(self) -> np.ndarray:
        """The signs of an object-space vector's components after mirroring: 3."""
        return np.where(np.arange(3) == self.axis, -1.0, 1.0)


def find_seam(mirror: Mirror, local: np.ndarray) -> np.ndarray:
    """Finds the vertices on the plane: #V, bool, from coordinates in object space (#V x 3), which may be rounded."""
    rounding = np.finfo(np.float32).eps * np.abs(local).max(initial=0.0)  # float32, and world space
    return np.abs(local[:, mirror.axis]) <= mirror.merge_distance + rounding


def find_pairs(local: np.ndarray, axis: int) -> np.ndarray:
    """Returns the mirror image of each vertex: #V, -1 where no vertex has its coordinates to the last bit."""
    here = local.astype(np.float32) + np.float32(0.0)  # -0 is 0
    there = here * np.where(np.arange(3) == axis, -1, 1).astype(np.float32) + np.float32(0.0)
    points, number = np.unique(np.concatenate([here, there]), axis=0, return_inverse=True)
    number = number.reshape(-1)
    owner = np.full(len(points), -1)
    owner[number[:len(here)]] = np.arange(len(here))
    partner = owner[number[len(here):]]
    back = partner[partner] == np.arange(len(here))  # of coincident vertices only one has a partner
    return np.where((partner >= 0) & back, partner, -1)


def is_symmetric_setup(mirror: Mirror, matrix: np.ndarray, view_direction: np.ndarray,
                       line_direction: np.ndarray) -> bool:
    """Returns whether view and light are symmetric about the plane, and the object's transform (4 x 4) keeps it a
    mirror plane.
    """
    sides = matrix[:3, :3] / np.linalg.norm(matrix[:3, :3], axis=0)
    normal = sides[:, mirror.axis]
    others = np.delete(sides, mirror.axis, axis=1)
    across = np.abs(normal @ np.column_stack([others, view_direction]))
    light = abs(normal @ line_direction)
    largest = max(across.max(), min(light, 1.0 - light))
    return bool(mirror.axis >= 0 and largest <= SYMMETRY_TOLERANCE)


def compute_theta_sign(mirror: Mirror, matrix: np.ndarray, line_direction: np.ndarray) -> float:
    """Returns the factor of the reflection function across the plane, for a symmetric view and light."""
    normal = matrix[:3, mirror.axis] / np.linalg.norm(matrix[:3, mirror.axis])
    return 1.0 if abs(normal @ line_direction) > 0.5 else -1.0


def join_with_image(mirror: Mirror, local: np.ndarray, F: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Joins the region and its image along the seam: positions (object space), triangles, and mirror images."""
    image, partner = number_images(mirror.seam)
    return (np.concatenate([local, local[~mirror.seam] * mirror.sign]), np.concatenate([F, image[F][:, ::-1]]), partner)


def number_images(seam: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Numbers points and after them their images, those on the seam (#points, bool) being their own: returns the image
    of each point, and those of both in both.
    """
    own = np.arange(len(seam))
    image = np.where(seam, own, len(seam) + np.cumsum(~seam) - 1)
    partner = np.empty(len(seam) + int((~seam).sum()), dtype=np.int64)
    partner[:len(seam)], partner[image] = image, own
    return image, partner


def restore_symmetry(mirror: Mirror, new: np.ndarray, old: np.ndarray) -> np.ndarray:
    """Removes rounding errors from new positions (#V x 3, object space): the seam keeps its distance from the plane,
    and the second of each pair becomes the image of the first. A region that is symmetric in itself may have been
    solved without symmetry, its seam moved along a view beside the plane: that is no rounding, and stays.
    """
    if mirror.axis < 0:
        return new
    rounding = SYMMETRY_TOLERANCE * np.ptp(new, axis=0).max()
    away = np.abs(new[mirror.seam, mirror.axis] - old[mirror.seam, mirror.axis])
    if mirror.image or away.max(initial=0.0) <= rounding:
        new[mirror.seam, mirror.axis] = old[mirror.seam, mirror.axis]
    second = np.flatnonzero((mirror.partner >= 0) & (mirror.partner < np.arange(len(new))))
    copied = new[mirror.partner[second]] * mirror.sign.astype(new.dtype)
    if np.abs(copied - new[second]).max(initial=0.0) <= rounding:
        new[second] = copied
    return new


def describe_asymmetry(mirror: Mirror, alike: bool) -> tuple[str, ...]:
    """Describes, in a sentence, why a region with Mirror X was not solved symmetrically; `alike` says whether view and
    light are symmetric.
    """
    lone = int((mirror.partner < 0).sum())
    if mirror.image or alike and not lone:
        return ()
    if lone:
        return (f"Mirror X is on, but {lone} vertices of the region have no mirror image in it: "
                "it was solved without symmetry",)
    return ("Mirror X is on, but view or light are not symmetric about the object's X plane: "
            "each side was solved for itself",)
