"""Pull Line in the toolbar of the 3D view: a press on the panel begins a session by pulling the line there."""
import bpy

from . import toolbar

IDNAME = "reflection_lines.pull_line"
PRESS = {"type": 'LEFTMOUSE', "value": 'PRESS'}
PINNING = {**PRESS, "alt": True}


class PullLineTool:
    """The tool in one mode."""
    bl_space_type = 'VIEW_3D'
    bl_idname = IDNAME
    bl_label = "Pull Line"
    bl_description = ("Drag a reflection line: the panel follows. Further presses take other lines.\n"
                      "Alt click pins a line, Enter applies, Esc takes all back")
    bl_icon = "ops.transform.push_pull"
    bl_keymap = (("reflines.pull_line", PRESS, None), ("reflines.pull_line", PINNING, None),
                 toolbar.LOOK_THROUGH)

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, _tool: object) -> None:
        """Draws the settings that new handles get, in the header and in the tab Tool."""
        settings = context.scene.reflection_lines.pull
        layout.prop(settings, "radius")
        layout.prop(settings, "border")


class EditModePullLineTool(PullLineTool, bpy.types.WorkSpaceTool):
    bl_context_mode = 'EDIT_MESH'


class ObjectModePullLineTool(PullLineTool, bpy.types.WorkSpaceTool):
    bl_context_mode = 'OBJECT'


TOOLS = (EditModePullLineTool, ObjectModePullLineTool)


def register() -> None:
    for tool in TOOLS:
        bpy.utils.register_tool(tool, after={toolbar.IDNAME})


def unregister() -> None:
    for tool in reversed(TOOLS):
        bpy.utils.unregister_tool(tool)
