"""The symmetry of panels that are solved as one: all of them below a Mirror modifier about the same plane, or none."""
from collections.abc import Sequence

import numpy as np

from ..model.mirror import Mirror
from ..model.patch import Patch, compute_bounds

SAME_PLANE = 1e-5  # distance of two mirror images of a point, relative to the size of the panels


def can_join(patch: Patch) -> bool:
    """Returns whether a panel has no symmetry, or the image that a Mirror modifier adds about a known plane. One that
    is symmetric in itself would lose that beside others.
    """
    return patch.mirror is None or patch.mirror.image and patch.mirror.reflection is not None


def have_same_plane(one: Patch, other: Patch) -> bool:
    """Returns whether two panels have their images about the same plane, or none: an image moves as its panel does, and
    would leave what faces it and has no image.
    """
    if one.mirror is None or other.mirror is None:
        return one.mirror is other.mirror
    corners = np.array([corner for each in (one, other) for corner in compute_bounds(each.V)])
    size = np.ptp(corners, axis=0).max()
    turns = [corners @ each.mirror.reflection[:3, :3].T + each.mirror.reflection[:3, 3] for each in (one, other)]
    return bool(np.abs(turns[0] - turns[1]).max() <= SAME_PLANE * size)


def find_seam(patch: Patch) -> np.ndarray:
    """Finds the vertices that a Mirror modifier joins with their images: #V, bool."""
    return np.zeros(len(patch.V), dtype=bool) if patch.mirror is None else patch.mirror.seam


def find_seam_rows(patch: Patch) -> np.ndarray:
    """Finds the vertices on the seam and one edge away, which a clamped seam holds: #V, bool."""
    result = find_seam(patch)
    beside = patch.F[result[patch.F].any(axis=1)]
    result = result.copy()
    result[beside] = True
    return result


def join_mirrors(panels: Sequence[Patch], vertex: Sequence[np.ndarray], count: int) -> Mirror | None:
    """Returns the symmetry of the joined patch with so many vertices, in the object space of the first panel; its seam
    is that of all panels.
    """
    if panels[0].mirror is None:
        return None
    partner = np.full(count, -1)
    for panel, own in zip(panels, vertex, strict=True):
        on_seam = own[panel.mirror.seam & (own >= 0)]
        partner[on_seam] = on_seam
    axes = {panel.mirror.axis for panel in panels}
    axis = axes.pop() if len(axes) == 1 else -1  # with two axes handles would be mirrored about the wrong one
    scales = [measure_scale(panel) for panel in panels]
    merged = max(panel.mirror.merge_distance * scale for panel, scale in zip(panels, scales, strict=True))
    return Mirror(axis, partner, True, merged / scales[0], panels[0].mirror.reflection)


def measure_scale(patch: Patch) -> float:
    """Measures how long a distance from the mirror plane, 1 in object space, is in world space."""
    if patch.mirror.axis < 0:
        return 1.0
    return 1.0 / float(np.linalg.norm(np.linalg.inv(patch.matrix[:3, :3])[patch.mirror.axis]))
