"""The target of lines bent by the grey values of an image."""
from dataclasses import dataclass

import numpy as np

from .. import native
from ..native_call import call
from .falloff import project_to_plane


@dataclass(frozen=True)
class Pattern:
    """The image lies in the image plane, its bottom edge along `right` turned by `angle`."""
    grey: np.ndarray          # #rows x #columns, first row at the bottom, 0 black to 1 white
    centre: np.ndarray        # 3, world space
    right: np.ndarray         # 3, world space
    width: float              # of the picture, world units
    angle: float = 0.0        # radians, counter-clockwise as the viewer sees it
    strength: float = 1.0     # radians of theta from black to white
    blur: float = 0.0         # pixels
    by_value: bool = False    # fits theta itself, where black leaves the lines in place


async def build_pattern_target(optimizer: "native.ShapeOptimizer", settings: Pattern) -> "native.Target":
    """Builds the target of the present lines plus the gradient of the image."""
    x, y = project_to_plane(optimizer, settings.right)
    return await call(
        native.reflines.pattern, optimizer, image=settings.grey, strength=settings.strength, blur=settings.blur,
        centre=project_to_plane(optimizer, settings.centre), width=settings.width,
        angle=settings.angle + np.arctan2(y, x), by_value=settings.by_value)
