"""The tool in the toolbar of the 3D view: its gizmos, its settings in the header, and its keys."""
import bpy

from . import gizmos

IDNAME = "reflection_lines.tool"
LOOK_THROUGH = ("reflines.look_through", {"type": 'NUMPAD_0', "value": 'PRESS'}, None)  # of all tools of the add-on


class ReflectionLinesTool:
    """The tool in one mode. While it is active, Numpad 0 looks through the view camera; clicks select as always."""
    bl_space_type = 'VIEW_3D'
    bl_idname = IDNAME
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


class EditModeTool(ReflectionLinesTool, bpy.types.WorkSpaceTool):
    bl_context_mode = 'EDIT_MESH'


class ObjectModeTool(ReflectionLinesTool, bpy.types.WorkSpaceTool):
    bl_context_mode = 'OBJECT'


TOOLS = (EditModeTool, ObjectModeTool)


def register() -> None:
    for tool in TOOLS:
        bpy.utils.register_tool(tool, after={"builtin.measure"}, separator=True)


def unregister() -> None:
    for tool in reversed(TOOLS):
        bpy.utils.unregister_tool(tool)
