"""The mirror image of a target.

Across a plane that contains view and light theta changes its sign, across one perpendicular to the light it does not;
in both cases the component of grad theta along the light's projection (the image plane's y) changes its sign.
"""
import numpy as np

from .. import native

FLIP = np.array([1.0, -1.0])


def mirror_target(wanted: "native.Target", sign: float) -> "native.Target":
    """Returns the target of a region followed by its image: the region's part, and its mirror image. `sign` is that of
    theta.
    """
    own = len(wanted.gradient) // 2
    gradient = np.concatenate([wanted.gradient[:own], wanted.gradient[:own] * FLIP])
    weight = np.tile(wanted.weight[:own], 2) if len(wanted.weight) else None
    theta = np.concatenate([wanted.theta[:own], sign * wanted.theta[:own]]) if len(wanted.theta) else None
    return native.reflines.Target(gradient, weight, theta=theta, family=wanted.family,
                                  reachable_only=wanted.reachable_only)
