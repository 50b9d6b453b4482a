"""View and light: two directions in world space."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class View:
    """The directions that define the reflection function: unit vectors in world space."""
    view_direction: np.ndarray  # 3, from the surface towards the viewer
    line_direction: np.ndarray  # 3, along the line lights

    @property
    def both_directions(self) -> np.ndarray:
        """The directions of the line lights and of those that cross them in the image plane: 2 x 3."""
        return np.stack([self.line_direction, np.cross(self.view_direction, self.line_direction)])
