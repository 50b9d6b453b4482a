"""The legends of a 3D view: of a map the bar of its colours, with unit and sign, and of the shapes before and after the
last solve the divider between them, with their names.
"""
import blf
import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..blender import units
from ..state import compared, solve_history
from ..view import view_region
from . import handle_marks, shown_objects, solve_maps, stripe_scene, stripes

WIDTH, HEIGHT, MARGIN, STEPS = 220.0, 12.0, 16.0, 64  # pixels at a scale of 1; and pieces of the bar
LOW, KNOB = 72.0, 9.0  # pixels at a scale of 1: height of the knob above the redo panel, and its radius
LINE_COLOR, TAKEN_COLOR = (1.0, 1.0, 1.0, 1.0), (1.0, 0.75, 0.1, 1.0)
FONT, SIZE = 0, 11.0
TITLES = {'DEVIATION': "Moved by the last solve, + outwards", 'RESIDUAL': "Lines off the wanted ones",
          'VERDICT': "What the last press did"}


def find_full_value(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> float | None:
    """Returns the value with the last colour, of the first mesh shown with a map; None where none is."""
    if not settings.show or settings.mode not in stripe_scene.MAPS or not context.space_data.overlay.show_overlays:
        return None
    for ob in shown_objects.find_shown_objects(context, settings):
        solution = solve_history.find_last_solve(ob.name_full)
        if solution is not None:
            values = solve_maps.compute_values(solution, settings.mode)
            return float(np.abs(values).max(initial=0.0))
    return None


def describe_ends(scene: bpy.types.Scene, mode: str, full: float) -> tuple[str, str, str]:
    """Describes the values at the ends and in the middle of the bar, left, middle and right, in the scene's units."""
    if mode == 'VERDICT':
        return "kept as design", "as it was", "healed"
    if mode == 'DEVIATION':
        length = units.format_length(full, scene)
        return f"\u2212{length}", "0", f"+{length}"
    system = scene.unit_settings
    per, scale = ("unit", 1.0) if system.system == 'NONE' else ("m", system.scale_length)
    return "0", f"{full / scale / 2.0:.3g}", f"{full / scale:.3g} rad/{per}"


def draw_legend() -> None:
    """Draws the legend of a map, or of the two sides of a view, in a viewport (POST_PIXEL)."""
    context = bpy.context
    settings = context.scene.reflection_lines.stripes
    divider = compared.find_divider(context.region)
    if divider is not None:
        draw_sides(context, round(divider))
    full = find_full_value(context, settings)
    if full is None:
        return
    scale = context.preferences.system.ui_scale
    left = view_region.find_view_left(context.area, context.region) - context.region.x + MARGIN * scale
    low = LOW * scale
    draw_bar(settings.mode, left, low, scale)
    ends = describe_ends(context.scene, settings.mode, full)
    start_text(scale)
    for text, fraction in zip(ends, (0.0, 0.5, 1.0), strict=True):
        draw_text(text, left + fraction * (WIDTH * scale - blf.dimensions(FONT, text)[0]), low - 1.2 * SIZE * scale)
    draw_text(TITLES[settings.mode], left, low + (HEIGHT + 5.0) * scale)
    blf.disable(FONT, blf.SHADOW)


def draw_sides(context: bpy.types.Context, x: float) -> None:
    """Draws the line between the shapes before and after the last solve, their names, and what drags the line."""
    scale, height = context.preferences.system.ui_scale, float(context.region.height)
    low = LOW * scale
    color = TAKEN_COLOR if compared.NOW.taken else LINE_COLOR
    handle_marks.draw_shape('LINES', np.array([(x, 0.0, 0.0), (x, height, 0.0)]), color)
    if context.space_data.show_gizmo:
        draw_knob(x, low, scale, color)
    start_text(scale)
    below = low - 0.35 * SIZE * scale
    draw_text("Before", x - blf.dimensions(FONT, "Before")[0] - MARGIN * scale, below)
    draw_text("After", x + MARGIN * scale, below)
    blf.disable(FONT, blf.SHADOW)


def draw_knob(x: float, y: float, scale: float, color: tuple[float, float, float, float]) -> None:
    """Draws a disc with an arrow to each side, which says that the line can be dragged."""
    gpu.state.blend_set('ALPHA')
    handle_marks.draw_ring((x, y), 0.0, (KNOB + 1.5) * scale, handle_marks.RIM_COLOR)
    handle_marks.draw_ring((x, y), 0.0, KNOB * scale, color)
    for side in (-1.0, 1.0):
        arrow = np.array([(2.0, 3.5), (2.0, -3.5), (6.5, 0.0)]) * (side, 1.0) * scale + (x, y)
        handle_marks.draw_shape('TRIS', np.column_stack([arrow, np.zeros(3)]), handle_marks.RIM_COLOR)
    gpu.state.blend_set('NONE')


def start_text(scale: float) -> None:
    """Begins white text with a shadow, which is read on any stripes; ends with blf.disable."""
    blf.size(FONT, SIZE * scale)
    blf.color(FONT, 1.0, 1.0, 1.0, 1.0)
    blf.enable(FONT, blf.SHADOW)
    blf.shadow(FONT, 3, 0.0, 0.0, 0.0, 1.0)


def draw_text(text: str, x: float, y: float) -> None:
    blf.position(FONT, x, y, 0.0)
    blf.draw(FONT, text)


def draw_bar(mode: str, left: float, low: float, scale: float) -> None:
    fraction = np.repeat(np.linspace(0.0, 1.0, STEPS + 1), 2)
    colors = encode_color(stripes.compute_ramp(fraction, stripes.RAMPS[mode]))
    places = np.column_stack([left + fraction * WIDTH * scale,
                              low + np.tile([0.0, HEIGHT * scale], STEPS + 1)]).astype(np.float32)
    shader = gpu.shader.from_builtin('SMOOTH_COLOR')
    points = [(x, y, 0.0) for x, y in places.tolist()]
    batch_for_shader(shader, 'TRI_STRIP', {"pos": points, "color": [(*color, 1.0) for color in colors.tolist()]}
                     ).draw(shader)


def encode_color(linear: np.ndarray) -> np.ndarray:
    """Returns sRGB values of linear ones (IEC 61966-2-1), which Blender's own shaders take."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0) ** (1.0 / 2.4) - 0.055)
