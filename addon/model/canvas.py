"""A sheet of paper on which pictures, triangles and text are laid."""
from collections.abc import Callable

import numpy as np

from .. import native

FINE = 3  # samples of a pixel each way, for smooth edges
ReadText = Callable[[str], tuple[np.ndarray, np.ndarray]]  # vertices (#V x 2) and triangles of a text of size 1

Color = tuple[float, float, float]  # sRGB, 0 to 1


class Canvas:
    """A white sheet. Places are pixels to the right and down."""

    def __init__(self, width: int, height: int, read_text: ReadText) -> None:
        self.pixels = np.ones((height, width, 3), dtype=np.float32)
        self.read_text = read_text

    def paste(self, picture: np.ndarray, left: int, top: int) -> None:
        """Lays a picture (height x width x 3) down, whole."""
        height, width, _ = picture.shape
        self.pixels[top:top + height, left:left + width] = picture

    def fill(self, V: np.ndarray, F: np.ndarray, color: Color) -> None:
        """Fills triangles (#F x 3) of points (#V x 2)."""
        if not len(F):
            return
        low = np.maximum(np.floor(V.min(axis=0)).astype(int), 0)
        high = np.minimum(np.ceil(V.max(axis=0)).astype(int), self.pixels.shape[1::-1])
        if (high <= low).any():
            return
        width, height = (high - low).tolist()
        points = np.column_stack([FINE * (V - low), np.zeros(len(V))])
        seen = native.reflines.rasterize(points, F, width=FINE * width, height=FINE * height)[0] >= 0
        cover = seen.reshape(height, FINE, width, FINE).mean(axis=(1, 3))[..., None].astype(np.float32)
        part = self.pixels[low[1]:high[1], low[0]:high[0]]
        part += cover * (np.array(color, dtype=np.float32) - part)

    def write(self, text: str, left: float, base: float, size: float, color: Color = (0.0, 0.0, 0.0), *,
              align: float = 0.0) -> float:
        """Writes a text on a base line; returns its width. `align` 0: from `left` on, 1: up to it, 0.5: around it."""
        V, F = self.read_text(text)
        if not len(V):
            return 0.0
        width = float(V[:, 0].max()) * size
        self.fill(np.array([left - align * width, base]) + V * (size, -size), F, color)
        return width

    def fill_box(self, left: float, top: float, width: float, height: float, color: Color) -> None:
        corners = np.array([left, top]) + np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * (width, height)
        self.fill(corners, np.array([[0, 1, 2], [0, 2, 3]]), color)

    def draw_ring(self, center: np.ndarray, radius: float, width: float, color: Color) -> None:
        """Draws a circle as a line of this width; a whole disk where that is the radius."""
        steps = 48
        turn = np.linspace(0.0, 2.0 * np.pi, steps, endpoint=False)
        around = np.column_stack([np.cos(turn), np.sin(turn)])
        V = np.asarray(center) + np.concatenate([radius * around, (radius - width) * around])
        k, following = np.arange(steps), (np.arange(steps) + 1) % steps
        self.fill(V, np.concatenate([np.column_stack([k, following, steps + k]),
                                     np.column_stack([following, steps + following, steps + k])]), color)

    def to_bytes(self) -> np.ndarray:
        """Returns the sheet as height x width x 3, uint8."""
        return np.round(255.0 * np.clip(self.pixels, 0.0, 1.0)).astype(np.uint8)
