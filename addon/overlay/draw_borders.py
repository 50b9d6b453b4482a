"""Draws the borders that were set by segment: along the mesh's edges, in one colour for each condition."""
import bpy
import numpy as np

from ..blender.app_handlers import draw_in_views
from ..model import border
from ..read import border_segments
from ..read.border_segments import BorderEdges
from . import surface_lines
from .surface_lines import SurfaceLines

COLORS = {"free": (0.25, 0.85, 0.3), "fixed": (1.0, 0.55, 0.05), "clamped": (0.2, 0.5, 1.0),
          "curvature": (0.75, 0.3, 1.0), "flow": (1.0, 0.15, 0.45), "follow": (0.1, 0.9, 0.9)}  # sRGB


_shown: dict[tuple[str, str], SurfaceLines] = {}  # by name and mode of the object; none where a mesh may have changed


def split_edges(edges: BorderEdges) -> dict[str, np.ndarray]:
    """Splits edges at their middles: the points of each condition's line segments, two a segment (#P x 3)."""
    first, second = edges.V[edges.ends[:, 0]], edges.V[edges.ends[:, 1]]
    middle = 0.5 * (first + second)
    points = np.concatenate([np.stack([first, middle], axis=1), np.stack([middle, second], axis=1)])
    codes = np.concatenate([edges.codes[edges.ends[:, 0]], edges.codes[edges.ends[:, 1]]])
    return {name: points[codes == code].reshape(-1, 3) for name, code in border.CODES.items()}


def build_borders(ob: bpy.types.Object) -> SurfaceLines:
    edges = border_segments.read_border_edges(ob)
    if edges is None:
        return surface_lines.NOTHING
    return surface_lines.build_lines({COLORS[name]: points for name, points in split_edges(edges).items()})


def find_objects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Returns the meshes whose borders are drawn: those in Edit Mode, else the active one."""
    active = context.view_layer.objects.active
    found = context.objects_in_mode if active is not None and active.mode == 'EDIT' else [active]
    return [ob for ob in found if ob is not None and ob.type == 'MESH' and ob.mode in {'EDIT', 'OBJECT'}
            and ob.visible_get(viewport=context.space_data)]


def draw_borders() -> None:
    """Draws the borders in a viewport (POST_VIEW), after the stripes."""
    context = bpy.context
    if not (context.scene.reflection_lines.show_borders and context.space_data.overlay.show_overlays):
        return
    for ob in find_objects(context):
        key = ob.name_full, ob.mode
        if key not in _shown:
            _shown[key] = build_borders(ob)
        surface_lines.draw_lines(context, ob, _shown[key])


@bpy.app.handlers.persistent
def note_changes(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Forgets the borders where a mesh changed."""
    if any(isinstance(update.id, (bpy.types.Mesh, bpy.types.Object)) and update.is_updated_geometry
           for update in depsgraph.updates):
        _shown.clear()


@bpy.app.handlers.persistent
def clear_cache(*_: object) -> None:
    _shown.clear()


HANDLERS = (("depsgraph_update_post", note_changes), ("frame_change_post", note_changes), ("undo_post", clear_cache),
            ("redo_post", clear_cache), ("load_post", clear_cache))


register, unregister = draw_in_views([(draw_borders, 'POST_VIEW')], HANDLERS, clear_cache)
