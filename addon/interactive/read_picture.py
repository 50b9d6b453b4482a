"""Reads what a picture of a panel shows, and how the view camera looks at it."""
import bpy
import numpy as np

from ..model import panel_picture
from ..model.panel_picture import Looked, Pictured
from ..model.patch import Patch
from ..model.steps import Steps
from ..model.surface import CheckedSurface
from ..model.view import View
from ..read import gather, read_checked
from ..read.mesh_checks import Purpose
from ..solver import live_optimizer
from ..view import facing, view_and_light


def read_panel(context: bpy.types.Context, ob: bpy.types.Object) -> tuple[Patch, CheckedSurface, View]:
    """Reads the region, all around it, and the view; refuses what cannot be looked at."""
    context.view_layer.update()
    patch = gather.gather_patch(ob, or_all=True, purpose=Purpose.READ)
    with live_optimizer.convert_native_errors(patch):
        surface = read_checked.read_checked_surface(ob, patch, patch.V)
    return patch, surface, facing.read_patch_view(context.scene, patch)


def read_picture(context: bpy.types.Context, ob: bpy.types.Object) -> Steps[tuple[Pictured, Looked]]:
    """Reads the mesh of a panel, or the surface of its cage, as it is now; the picture is one world unit wide. Refuses
    what cannot be read. All of Blender's data is read in the first step.
    """
    settings = context.scene.reflection_lines
    patch, surface, seen = read_panel(context, ob)
    right = np.cross(view_and_light.read_camera_axes(settings.camera)[1], seen.view_direction)
    right /= np.linalg.norm(right)
    looked = Looked(right, np.cross(seen.view_direction, right), seen.view_direction, patch.center, 1.0,
                    seen.line_direction, settings.stripes.count)
    with live_optimizer.convert_native_errors(patch):
        shown = yield from panel_picture.cut_surface(surface.after, surface.F, surface.region)
    return shown, looked
