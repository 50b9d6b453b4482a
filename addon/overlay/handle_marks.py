"""The marks of a session with handles in the 3D view: lines, ghosts of lines, and a dot for each handle."""
from collections.abc import Callable
from dataclasses import dataclass, field

import bpy
import gpu
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from gpu_extras.batch import batch_for_shader

LINE_COLOR, HOVER_COLOR = (1.0, 0.75, 0.1, 1.0), (1.0, 1.0, 0.55, 1.0)
GHOST_COLOR, PIN_COLOR = (0.75, 0.8, 0.9, 0.6), (0.2, 0.85, 1.0, 1.0)
RIM_COLOR = (0.05, 0.05, 0.05, 1.0)
LINE_WIDTH, GHOST_WIDTH = 2.5, 1.5  # pixels
DOT_RADIUS, RIM = 5.0, 1.5          # pixels, times the interface's scale
HOLE = 0.6                          # of a hollow dot's radius
TURN = np.linspace(0.0, 2.0 * np.pi, 25)

Color = tuple[float, float, float, float]


@dataclass(frozen=True)
class Curve:
    """A line on the surface."""
    points: np.ndarray  # #P x 3, world space
    color: Color
    width: float = LINE_WIDTH


@dataclass(frozen=True)
class Dot:
    """The mark of a handle, which is larger where the mouse can take it, and hollow where the handle is muted."""
    point: np.ndarray  # 3, world space
    color: Color
    large: bool = False
    hollow: bool = False


@dataclass(frozen=True)
class Marks:
    """The curves and dots that are drawn."""
    curves: tuple[Curve, ...] = ()
    dots: tuple[Dot, ...] = field(default=())


def add_marks(area: bpy.types.Area, read: Callable[[], Marks]) -> tuple[object, object]:
    """Draws the marks that `read` returns in one 3D view, until `remove_marks` gets the returned handles."""
    add, where = bpy.types.SpaceView3D.draw_handler_add, (area, read)
    return add(draw_curves, where, 'WINDOW', 'POST_VIEW'), add(draw_dots, where, 'WINDOW', 'POST_PIXEL')


def remove_marks(handles: tuple[object, object]) -> None:
    for handle in handles:
        bpy.types.SpaceView3D.draw_handler_remove(handle, 'WINDOW')


def draw_curves(area: bpy.types.Area, read: Callable[[], Marks]) -> None:
    if bpy.context.area != area:
        return
    gpu.state.blend_set('ALPHA')
    for curve in read().curves:
        if len(curve.points) > 1:
            gpu.state.line_width_set(curve.width)
            draw_shape('LINE_STRIP', curve.points, curve.color)
    gpu.state.line_width_set(1.0)
    gpu.state.blend_set('NONE')


def draw_dots(area: bpy.types.Area, read: Callable[[], Marks]) -> None:
    context = bpy.context
    if context.area != area:
        return
    gpu.state.blend_set('ALPHA')
    scale = context.preferences.system.ui_scale
    for dot in read().dots:
        place = location_3d_to_region_2d(context.region, context.region_data, dot.point.tolist())
        if place is not None:
            radius = scale * DOT_RADIUS * (1.4 if dot.large else 1.0)
            hole = HOLE * radius if dot.hollow else 0.0
            draw_ring(place, max(hole - RIM * scale, 0.0), radius + RIM * scale, RIM_COLOR)
            draw_ring(place, hole, radius, dot.color)
    gpu.state.blend_set('NONE')


def draw_ring(place: tuple[float, float], inner: float, outer: float, color: Color) -> None:
    """Draws a ring, which is a disc where its inner radius is 0."""
    way = np.column_stack([np.cos(TURN), np.sin(TURN), np.zeros(len(TURN))])
    corners = np.stack([inner * way, outer * way], axis=1).reshape(-1, 3)
    draw_shape('TRI_STRIP', corners + [place[0], place[1], 0.0], color)


def draw_shape(kind: str, points: np.ndarray, color: Color) -> None:
    shader = gpu.shader.from_builtin('UNIFORM_COLOR')
    shader.bind()
    shader.uniform_float("color", color)
    batch_for_shader(shader, kind, {"pos": points.astype(np.float32).tolist()}).draw(shader)
