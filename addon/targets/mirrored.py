"""What is wanted of a region, of its mirror image too.

Across a plane through view and light theta changes its sign, across one that the light is perpendicular to it does not;
in both cases of grad theta the part along the light's projection (the image plane's y) changes its sign.
"""
import numpy as np

from .. import native

FLIP = np.array([1.0, -1.0])


def target(wanted: object, sign: float) -> object:
    """Of a region followed by its image; what `wanted` says of the image does not count. `sign` is that of theta."""
    own = len(wanted.gradient) // 2
    gradient = np.concatenate([wanted.gradient[:own], wanted.gradient[:own] * FLIP])
    weight = np.tile(wanted.weight[:own], 2) if len(wanted.weight) else None
    theta = np.concatenate([wanted.theta[:own], sign * wanted.theta[:own]]) if len(wanted.theta) else None
    return native.reflines.Target(gradient, weight, theta=theta, family=wanted.family)
