"""Circles around what a tool changes: of a dragged one in space, of a brush in pixels."""
from collections.abc import Callable

import bpy
import gpu
import numpy as np

from .handle_marks import Color, draw_shape

COLOR, BRUSH_COLOR = (1.0, 1.0, 1.0, 0.8), (1.0, 0.75, 0.1, 0.9)
WIDTH = 1.5  # pixels
TURN = np.linspace(0.0, 2.0 * np.pi, 97)
ROUND = np.stack([np.cos(TURN), np.sin(TURN)], axis=1)


def sample_circle(centre: np.ndarray, radius: float, frame: np.ndarray) -> np.ndarray:
    """Samples a circle along the first two rows of `frame`: #P x 3."""
    return centre + radius * ROUND @ frame[:2]


def add_circle(points: Callable[[], np.ndarray | None]) -> object:
    """Draws the line strip that `points` returns in all 3D views, until `remove_circle` gets the returned handle."""
    return bpy.types.SpaceView3D.draw_handler_add(draw_circle, (points,), 'WINDOW', 'POST_VIEW')


def remove_circle(handle: object) -> None:
    bpy.types.SpaceView3D.draw_handler_remove(handle, 'WINDOW')


def draw_circle(points: Callable[[], np.ndarray | None]) -> None:
    positions = points()
    if positions is not None:
        draw_strip(positions, COLOR)


def draw_brush(place: tuple[int, int], radius: float) -> None:
    """Draws a circle around a place, in pixels."""
    draw_strip(sample_circle(np.array([*place, 0.0]), radius, np.eye(3)), BRUSH_COLOR)


def draw_strip(points: np.ndarray, color: Color) -> None:
    """Draws a line through points (#P x 3)."""
    gpu.state.blend_set('ALPHA')
    gpu.state.line_width_set(WIDTH)
    draw_shape('LINE_STRIP', points, color)
    gpu.state.line_width_set(1.0)
    gpu.state.blend_set('NONE')
