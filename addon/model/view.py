"""View and light: two directions in world space."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Families:
    """Lights that a solve is for, each seen by an eye of its own, in world space."""
    lines: np.ndarray   # #lights x 3, along the line lights
    eyes: np.ndarray    # #lights x 3, unit vectors to the viewers
    weight: np.ndarray  # #lights
    blockers: tuple[np.ndarray, np.ndarray] | None  # V, F of what may hide the surface


@dataclass(frozen=True)
class View:
    """The directions that define the reflection function: unit vectors in world space."""
    view_direction: np.ndarray  # 3, from the surface towards the viewer
    line_direction: np.ndarray  # 3, along the line lights
    families: Families | None = None  # take the place of the light and the crossed one

    @property
    def both_directions(self) -> np.ndarray:
        """The directions of the line lights and of those that cross them in the image plane: 2 x 3."""
        return np.stack([self.line_direction, np.cross(self.view_direction, self.line_direction)])

    def has_same_light(self, other: "View") -> bool:
        """Returns whether both directions are the same, whatever takes their place."""
        return (np.array_equal(self.view_direction, other.view_direction)
                and np.array_equal(self.line_direction, other.line_direction))
