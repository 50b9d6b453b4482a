"""Regions with a mirror image: below a Mirror modifier, or in themselves with Blender's option Mirror X.

Seen and lit alike on both sides of the plane, such a region has a symmetric best shape. It is solved with its image, or
as the whole that it is; what rounding and the cut of the quads left of a difference is averaged away, and at last one
side is copied to the other, so that not a bit differs. Lit unevenly, the seam of a Mirror modifier is held with its
tangents: both halves then still join smoothly.
"""
from dataclasses import dataclass

import bpy
import numpy as np

ALIKE = 1e-6  # of a unit vector, and of the region's size


@dataclass(frozen=True)
class Mirror:
    axis: int            # of the object; -1: several
    partner: np.ndarray  # #V: each vertex's image in the region, itself on the plane, -1 where it has none
    image: bool          # below a modifier that adds the image; else the region is its own

    @property
    def seam(self) -> np.ndarray:
        """#V, bool."""
        return self.partner == np.arange(len(self.partner))

    @property
    def is_whole(self) -> bool:
        """Whether the region and its image can be solved as one."""
        return self.axis >= 0 and (self.partner >= 0).all() != self.image

    @property
    def sign(self) -> np.ndarray:
        return np.where(np.arange(3) == self.axis, -1.0, 1.0)


def same(one: Mirror | None, other: Mirror | None) -> bool:
    if one is None or other is None:
        return one is other
    return (one.axis, one.image) == (other.axis, other.image) and np.array_equal(one.partner, other.partner)


def of(ob: bpy.types.Object, local: np.ndarray) -> Mirror | None:
    """`local`: #V x 3 of the region, object space."""
    shown = [modifier for modifier in ob.modifiers if modifier.show_viewport]
    mirrors = [modifier for modifier in shown if modifier.type == 'MIRROR' and modifier.mirror_object is None]
    if mirrors:
        first = mirrors[0]
        axes = [axis for axis in range(3) if first.use_axis[axis]]
        reach = first.merge_threshold / 2.0 if first.use_mirror_merge else 0.0
        seam = (np.abs(local[:, axes]) <= reach).any(axis=1)
        alone = len(mirrors) == len(axes) == 1 and shown[0] == first and not any(first.use_bisect_axis)
        return Mirror(axes[0] if alone else -1, np.where(seam, np.arange(len(local)), -1), True)
    return Mirror(0, pairs(local, 0), False) if ob.data.use_mirror_x else None


def pairs(local: np.ndarray, axis: int) -> np.ndarray:
    """#V: partners where each vertex has one to the last bit; else -1 for those without."""
    here = local.astype(np.float32) + np.float32(0.0)  # -0 is 0
    there = here * np.where(np.arange(3) == axis, -1, 1).astype(np.float32) + np.float32(0.0)
    points, number = np.unique(np.concatenate([here, there]), axis=0, return_inverse=True)
    number = number.reshape(-1)
    owner = np.full(len(points), -1)
    owner[number[:len(here)]] = np.arange(len(here))
    partner = owner[number[len(here):]]
    back = partner[partner] == np.arange(len(here))  # of vertices in one place only one has a partner
    return np.where((partner >= 0) & back, partner, -1)


def is_alike(mirror: Mirror, matrix: np.ndarray, view_direction: np.ndarray, line_direction: np.ndarray) -> bool:
    """Whether view and light are symmetric about the plane, and the object's transform (4 x 4) keeps it one."""
    sides = matrix[:3, :3] / np.linalg.norm(matrix[:3, :3], axis=0)
    normal = sides[:, mirror.axis]
    others = np.delete(sides, mirror.axis, axis=1)
    across = np.abs(normal @ np.column_stack([others, view_direction]))
    light = abs(normal @ line_direction)
    return bool(mirror.axis >= 0 and across.max() <= ALIKE and min(light, 1.0 - light) <= ALIKE)


def theta_sign(mirror: Mirror, matrix: np.ndarray, line_direction: np.ndarray) -> float:
    """What the reflection function is multiplied by across the plane, seen and lit alike on both sides."""
    normal = matrix[:3, mirror.axis] / np.linalg.norm(matrix[:3, mirror.axis])
    return 1.0 if abs(normal @ line_direction) > 0.5 else -1.0


def both(mirror: Mirror, local: np.ndarray, F: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions (object space), triangles and partners of the region followed by its image; they share the seam."""
    away = ~mirror.seam
    image = np.where(away, len(local) + np.cumsum(away) - 1, np.arange(len(local)))
    partner = np.empty(len(local) + int(away.sum()), dtype=np.int64)
    partner[:len(local)], partner[image] = image, np.arange(len(local))
    return np.concatenate([local, local[away] * mirror.sign]), np.concatenate([F, image[F][:, ::-1]]), partner


def settled(mirror: Mirror, new: np.ndarray, old: np.ndarray) -> np.ndarray:
    """#V x 3, object space, without what rounding does: the seam stays as far from the plane, pairs are copied."""
    if mirror.axis < 0:
        return new
    new[mirror.seam, mirror.axis] = old[mirror.seam, mirror.axis]
    second = np.flatnonzero((mirror.partner >= 0) & (mirror.partner < np.arange(len(new))))
    copied = new[mirror.partner[second]] * mirror.sign.astype(new.dtype)
    if np.abs(copied - new[second]).max(initial=0.0) <= ALIKE * np.ptp(new, axis=0).max():
        new[second] = copied
    return new


def remarks(mirror: Mirror, alike: bool) -> tuple[str, ...]:
    """Why the region does not stay symmetric, as sentences."""
    lone = int((mirror.partner < 0).sum())
    if mirror.image or alike and not lone:
        return ()
    if lone:
        return (f"Mirror X is on, but {lone} vertices of the region have no mirror image in it: "
                "it was solved without symmetry",)
    return ("Mirror X is on, but view or light are not symmetric about the object's X plane: "
            "each side was solved for itself",)
