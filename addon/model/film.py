"""The frames of a film of a panel: the light turns around the view, or the view walks around the panel."""
from dataclasses import dataclass, replace

import numpy as np

from .panel_picture import Looked, Pictured, draw_in_bands
from .steps import Steps

LOOKS = 24  # frames that tell how much room the panel takes
UPWARDS = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Film:
    """A film of a panel. Its last frame is followed by its first without a jump."""
    shown: Pictured
    looked: Looked  # how it begins
    kind: str       # 'LIGHT': the light turns around the view once; 'VIEW': see `swing`
    swing: float    # radians to each side, of the view around the vertical
    frames: int
    width: int      # pixels
    height: int

    def look(self, frame: int) -> Looked:
        """Returns how the panel is looked at in a frame, from 0."""
        fraction = frame / self.frames
        if self.kind == 'LIGHT':
            return replace(self.looked, line=rotate(self.looked.line, self.looked.eye, 2.0 * np.pi * fraction))
        angle = self.swing * np.sin(2.0 * np.pi * fraction)
        right, up, eye = (rotate(each, UPWARDS, angle) for each in (self.looked.right, self.looked.up, self.looked.eye))
        return replace(self.looked, right=right, up=up, eye=eye)

    def measure_width(self) -> float:
        """Measures how wide a picture has to be, in world units, for all of the panel in every frame."""
        away = self.shown.V[np.unique(self.shown.F[self.shown.region])] - self.looked.center
        looks = [self.look(frame) for frame in range(0, self.frames, max(self.frames // LOOKS, 1))]
        x, y = (max(float(np.abs(away @ getattr(each, name)).max()) for each in looks) for name in ("right", "up"))
        return 2.0 * max(x, y * self.width / self.height)

    def draw_frame(self, frame: int) -> Steps[np.ndarray]:
        """Draws a frame: height x width x 3, uint8."""
        drawn = yield from draw_in_bands(self.shown, self.look(frame), self.width, self.height)
        return np.round(255.0 * drawn).astype(np.uint8)


def rotate(direction: np.ndarray, axis: np.ndarray, angle: float) -> np.ndarray:
    """Rotates a direction about a unit axis, counter-clockwise."""
    along = (axis @ direction) * axis
    return along + np.cos(angle) * (direction - along) + np.sin(angle) * np.cross(axis, direction)
