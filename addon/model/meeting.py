"""The panels of one run that lie beside each other, and which are one region to tools that work on all of it."""
from collections.abc import Sequence

import numpy as np

from .. import native
from .patch import Patch, compute_bounds


def find_meeting(patch: Patch, panels: Sequence[Patch]) -> list[Patch]:
    """Returns a patch and all panels that its box, or that of one of them, comes as near to as a gap is wide."""
    own = {each.name for each in patch.panels}
    met, left = [patch], [each for each in panels if each.name not in own]
    for one in met:  # which grows
        beside = [each for each in left if are_near(one, each)]
        left = [each for each in left if each.name not in {found.name for found in beside}]
        met += beside
    return met


def are_near(one: Patch, other: Patch) -> bool:
    (low, high), (other_low, other_high) = compute_bounds(one.V), compute_bounds(other.V)
    gap = native.reflines.AUTOMATIC_GAP * max(one.diagonal, other.diagonal)
    return bool((low <= other_high + gap).all() and (other_low <= high + gap).all())


def find_middle(panels: Sequence[Patch]) -> np.ndarray:
    """Returns the centre of panels that are one region, with their images, in world space."""
    lows, highs = zip(*(each.bounds_with_image for each in panels), strict=True)
    return 0.5 * (np.min(lows, axis=0) + np.max(highs, axis=0))


def measure_bounds(panels: Sequence[Patch]) -> tuple[np.ndarray, np.ndarray]:
    """Returns the lowest and highest corner of the box around panels."""
    lows, highs = zip(*(compute_bounds(each.V) for each in panels), strict=True)
    return np.min(lows, axis=0), np.max(highs, axis=0)
