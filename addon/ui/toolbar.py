"""The tools in the toolbar of the 3D view: gizmos, settings in the header, and keys. Each is there in Edit Mode and in
Object Mode.
"""
import bpy

from ..overlay import tool_circle
from . import automatic_values, gizmos, handle_gizmos

LOOK_THROUGH = ("reflines.look_through", {"type": 'NUMPAD_0', "value": 'PRESS'}, None)  # of all tools
PRESS = {"type": 'LEFTMOUSE', "value": 'PRESS'}
SETTINGS = "scene.reflection_lines.brush"


class ReflectionLinesTool:
    """The tool with gizmos. While it is active, Numpad 0 looks through the view camera; clicks select as always."""
    bl_idname = "reflection_lines.tool"
    bl_label = "Reflection Lines"
    bl_description = ("Drag the arrow beside the panel to smooth its lines, and the ring to turn the light.\n"
                      "Numpad 0 looks through the view camera")
    bl_icon = "ops.mesh.vertices_smooth"
    bl_widget = gizmos.VIEW3D_GGT_reflines.bl_idname
    bl_options = {'KEYMAP_FALLBACK'}
    bl_keymap = (LOOK_THROUGH,)

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, _tool: object) -> None:
        """Draws the settings of Smooth that a drag begins with, in the header and in the tab Tool."""
        settings = context.scene.reflection_lines
        layout.prop(settings, "strength")
        layout.prop(settings, "border")
        layout.menu("VIEW3D_MT_reflines_drag", icon='ARROW_LEFTRIGHT')


class PullLineTool:
    """The tool whose press on the panel begins a session by pulling the line there, or a kept handle's dot."""
    bl_idname = "reflection_lines.pull_line"
    bl_label = "Pull Line"
    bl_description = ("Drag a reflection line: the panel follows. Further presses take other lines.\n"
                      "Alt click pins a line, Enter applies, Esc takes all back")
    bl_icon = "ops.transform.push_pull"
    bl_widget = handle_gizmos.VIEW3D_GGT_reflines_handles.bl_idname
    bl_keymap = (("reflines.pull_line", PRESS, None), ("reflines.pull_line", {**PRESS, "alt": True}, None),
                 LOOK_THROUGH)

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, _tool: object) -> None:
        """Draws the settings that new handles get, in the header and in the tab Tool."""
        settings = context.scene.reflection_lines
        automatic_values.draw_value(layout, settings.pull, "radius")
        layout.prop(settings, "border")


class DrawHighlightTool(PullLineTool):
    """The tool whose press on the panel begins a session by drawing a line there."""
    bl_idname = "reflection_lines.draw_highlight"
    bl_label = "Draw Highlight"
    bl_description = ("Draw how a reflection line is to run: the line at the start of the stroke is laid along it.\n"
                      "Its dots can be moved, Enter applies, Esc takes all back")
    bl_icon = "ops.curve.draw"
    bl_keymap = (("reflines.pull_line", PRESS, {"properties": [("draws", True)]}), LOOK_THROUGH)


class FairBrushTool:
    """The tool that paints smoother lines."""
    bl_idname = "reflection_lines.fair_brush"
    bl_label = "Fair Brush"
    bl_description = ("Paint over flaws: the lines under the brush become smoother, the rest stays.\n"
                      "F changes the size, Shift F the strength, Shift paints with less")
    bl_icon = "ops.sculpt.mesh_filter"
    bl_cursor = 'CROSSHAIR'
    bl_keymap = (("reflines.fair_brush", PRESS, None), ("reflines.fair_brush", {**PRESS, "shift": True}, None),
                 ("wm.radial_control", {"type": 'F', "value": 'PRESS'},
                  {"properties": [("data_path_primary", f"{SETTINGS}.size")]}),
                 ("wm.radial_control", {"type": 'F', "value": 'PRESS', "shift": True},
                  {"properties": [("data_path_primary", f"{SETTINGS}.strength")]}), LOOK_THROUGH)

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, _tool: object) -> None:
        """Draws the settings of the brush, in the header and in the tab Tool."""
        settings = context.scene.reflection_lines
        layout.prop(settings.brush, "size")
        layout.prop(settings.brush, "strength")
        automatic_values.draw_value(layout, settings, "length")

    @staticmethod
    def draw_cursor(context: bpy.types.Context, _tool: object, place: tuple[int, int]) -> None:
        """Draws the brush around the mouse; nothing once the add-on is disabled, which Blender goes on to call."""
        settings = getattr(context.scene, "reflection_lines", None)
        if settings is not None:
            tool_circle.draw_brush(place, settings.brush.size)


def add_modes(tool: type) -> list[type]:
    """Returns a tool's class for each mode that it is used in."""
    return [type(f"{name}{tool.__name__}", (tool, bpy.types.WorkSpaceTool),
                 {"bl_space_type": 'VIEW_3D', "bl_context_mode": mode})
            for name, mode in (("EditMode", 'EDIT_MESH'), ("ObjectMode", 'OBJECT'))]


TOOLS = [add_modes(tool) for tool in (ReflectionLinesTool, PullLineTool, DrawHighlightTool, FairBrushTool)]


def register() -> None:
    """Registers the tools one below the other, after Blender's."""
    above = "builtin.measure"
    for modes in TOOLS:
        for tool in modes:
            bpy.utils.register_tool(tool, after={above}, separator=modes is TOOLS[0])
        above = modes[0].bl_idname


def unregister() -> None:
    for modes in reversed(TOOLS):
        for tool in reversed(modes):
            bpy.utils.unregister_tool(tool)
