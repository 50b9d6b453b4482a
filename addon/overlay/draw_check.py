"""Draws the last checks of the active object and of all in Edit Mode: seams that are better than before green, worse
ones red, others grey, and a dot at each worst place, red or, where it is beyond the mark as before, orange.
"""
import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

from ..blender.app_handlers import draw_in_views
from ..state import last_checks
from ..state.last_checks import DrawnCheck
from . import handle_marks, surface_lines
from .surface_lines import SurfaceLines

COLORS = {"better": (0.15, 0.8, 0.3), "unchanged": (0.6, 0.65, 0.75), "worse": (1.0, 0.15, 0.1)}  # sRGB
BEYOND_COLOR = (1.0, 0.6, 0.1)
DOT_RADIUS, DOT_RIM = 6.0, 2.0  # pixels, times the interface's scale
DOT_RIM_COLOR = (1.0, 1.0, 1.0, 1.0)


_shown: dict[str, tuple[DrawnCheck, SurfaceLines]] = {}  # the checks drawn last, by the full name of the object


def find_drawn(context: bpy.types.Context) -> list[tuple[bpy.types.Object, DrawnCheck]]:
    """Returns the objects whose checks are drawn in this view, with these."""
    active = context.view_layer.objects.active
    if active is None or not context.space_data.overlay.show_overlays:
        return []
    found = context.objects_in_mode if active.mode == 'EDIT' else [active]
    return [(ob, check) for ob in found if ob.visible_get(viewport=context.space_data)
            and (check := last_checks.find_check(ob.name_full)) is not None]


def build_seams(check: DrawnCheck) -> SurfaceLines:
    return surface_lines.build_lines({color: check.segments[check.change == change].reshape(-1, 3)
                                      for change, color in COLORS.items()})


def draw_seams() -> None:
    """Draws the seams in a viewport (POST_VIEW), after the stripes. Lines go with their check."""
    for name in [name for name, (check, _) in _shown.items() if last_checks.find_check(name) is not check]:
        del _shown[name]
    for ob, check in find_drawn(bpy.context):
        if ob.name_full not in _shown:
            _shown[ob.name_full] = check, build_seams(check)
        surface_lines.draw_lines(bpy.context, ob, _shown[ob.name_full][1])


def draw_worst() -> None:
    """Draws the dots at the worst places in a viewport (POST_PIXEL)."""
    context = bpy.context
    scale = context.preferences.system.ui_scale
    for ob, check in find_drawn(context):
        matrix = np.array(ob.matrix_world)
        for point, worse in zip(check.worst @ matrix[:3, :3].T + matrix[:3, 3], check.worse, strict=True):
            place = location_3d_to_region_2d(context.region, context.region_data, point.tolist())
            if place is not None:
                handle_marks.draw_ring(place, 0.0, scale * (DOT_RADIUS + DOT_RIM), DOT_RIM_COLOR)
                color = COLORS["worse"] if worse else BEYOND_COLOR
                handle_marks.draw_ring(place, 0.0, scale * DOT_RADIUS, (*color, 1.0))


register, unregister = draw_in_views(((draw_seams, 'POST_VIEW'), (draw_worst, 'POST_PIXEL')), (), _shown.clear)
