"""Lines along a surface, in colours that a dark rim sets off from any stripes."""
from dataclasses import dataclass

import bpy
import gpu
import numpy as np

from . import draw_cage

RIM_COLOR = (0.0, 0.0, 0.0, 0.7)
WIDTH, RIM = 3.5, 1.0  # pixels

Color = tuple[float, float, float]  # sRGB


@dataclass(frozen=True)
class SurfaceLines:
    """The batches of one object: all lines, and those of each colour."""
    whole: gpu.types.GPUBatch | None
    colored: tuple[tuple[Color, gpu.types.GPUBatch], ...]


NOTHING = SurfaceLines(None, ())


def build_lines(points: dict[Color, np.ndarray]) -> SurfaceLines:
    """Builds the batches from the points of each colour's line segments, two a segment (#P x 3, object space)."""
    used = {color: own for color, own in points.items() if len(own)}
    if not used:
        return NOTHING
    return SurfaceLines(build_segments(np.concatenate(list(used.values()))),
                        tuple((color, build_segments(own)) for color, own in used.items()))


def build_segments(points: np.ndarray) -> gpu.types.GPUBatch:
    return draw_cage.build_batch('LINES', points, np.arange(len(points)).reshape(-1, 2))


def draw_lines(context: bpy.types.Context, ob: bpy.types.Object, shown: SurfaceLines) -> None:
    """Draws the lines nearer to the eye than the stripes (POST_VIEW)."""
    if shown.whole is None:
        return
    painter = draw_cage.SurfacePainter(context, ob)
    gpu.state.depth_test_set('NONE' if painter.xray else 'LESS_EQUAL')
    gpu.state.depth_mask_set(False)
    gpu.state.blend_set('ALPHA')
    with painter.nearer(painter.measure_pixels(0.5 * WIDTH + RIM)):
        shader = gpu.shader.from_builtin('POLYLINE_UNIFORM_COLOR')
        shader.bind()
        shader.uniform_float("viewportSize", painter.size)
        for batch, color, width in ((shown.whole, RIM_COLOR, WIDTH + 2.0 * RIM),
                                    *((batch, (*color, 1.0), WIDTH) for color, batch in shown.colored)):
            shader.uniform_float("color", color)
            shader.uniform_float("lineWidth", width)
            batch.draw(shader)
    gpu.state.blend_set('NONE')
    gpu.state.depth_test_set('NONE')
