"""Reads what a picture of a panel shows, and how the view camera looks at it."""
import bpy
import numpy as np

from ..model import panel_picture
from ..model.panel_picture import Looked, Pictured
from ..model.steps import Steps
from ..read import gather, read_checked
from ..read.mesh_checks import Purpose
from ..solver import live_optimizer
from ..view import facing, view_and_light


def read_picture(context: bpy.types.Context, ob: bpy.types.Object) -> Steps[tuple[Pictured, Looked]]:
    """Reads the mesh of a panel, or the surface of its cage, as it is now; the picture is one world unit wide. Refuses
    what cannot be read. All of Blender's data is read in the first step.
    """
    context.view_layer.update()
    settings = context.scene.reflection_lines
    patch = gather.gather_patch(ob, or_all=True, purpose=Purpose.READ)
    with live_optimizer.convert_native_errors(patch):
        surface = read_checked.read_checked_surface(ob, patch, patch.V)
    seen = facing.read_patch_view(context.scene, patch)
    right = np.cross(view_and_light.read_camera_axes(settings.camera)[1], seen.view_direction)
    right /= np.linalg.norm(right)
    looked = Looked(right, np.cross(seen.view_direction, right), seen.view_direction, patch.center, 1.0,
                    seen.line_direction, settings.stripes.count)
    with live_optimizer.convert_native_errors(patch):
        shown = yield from panel_picture.cut_surface(surface.after, surface.F, surface.region)
    return shown, looked
