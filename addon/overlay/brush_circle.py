"""A circle of pixels that shows a brush."""
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

COLOR = (1.0, 0.75, 0.1, 0.9)
WIDTH = 1.5  # pixels
TURN = np.linspace(0.0, 2.0 * np.pi, 65)


def draw_brush(place: tuple[int, int], radius: float) -> None:
    """Draws a circle around a place, in pixels."""
    points = np.column_stack([place[0] + radius * np.cos(TURN), place[1] + radius * np.sin(TURN)])
    shader = gpu.shader.from_builtin('UNIFORM_COLOR')
    gpu.state.blend_set('ALPHA')
    gpu.state.line_width_set(WIDTH)
    shader.bind()
    shader.uniform_float("color", COLOR)
    batch_for_shader(shader, 'LINE_STRIP', {"pos": [(x, y, 0.0) for x, y in points.tolist()]}).draw(shader)
    gpu.state.line_width_set(1.0)
    gpu.state.blend_set('NONE')
