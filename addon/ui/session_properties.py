"""Properties of the window manager that panels show of the session; never saved."""
import bpy
from bpy.props import PointerProperty, StringProperty

from .. import native
from ..interactive import live_warp_handlers
from ..overlay import shown_objects
from ..state import solve_history
from ..view import view_camera


def describe_live_warp() -> str:
    """Describes the state of the present scene's live warp; empty where there is nothing to say."""
    live = live_warp_handlers.find_live_warp(bpy.context.scene)
    return "" if live is None else live.describe_state()


class ReflinesSession(bpy.types.PropertyGroup):
    """The properties of the session that panels show, on the window manager."""
    problem: StringProperty(get=lambda _: native.STATE.problem)
    remedy: StringProperty(get=lambda _: native.STATE.remedy)
    live: StringProperty(get=lambda _: describe_live_warp())

    def is_undone(self, ob: bpy.types.Object) -> bool:
        """Returns whether undo took back the solve that the object's report describes."""
        return solve_history.is_undone(ob)

    def is_looking_through(self, context: bpy.types.Context) -> bool:
        """Returns whether the 3D view looks through the view camera."""
        return view_camera.is_looking_through(context.space_data, context.scene.reflection_lines.camera)

    def explain_stripes(self, context: bpy.types.Context) -> str:
        """Returns why the stripes are not drawn in this view as they are set, as a sentence; empty where they are."""
        return shown_objects.explain_stripes(context)


def register() -> None:
    bpy.types.WindowManager.reflection_lines = PointerProperty(type=ReflinesSession)


def unregister() -> None:
    del bpy.types.WindowManager.reflection_lines
