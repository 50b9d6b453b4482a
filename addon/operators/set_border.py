"""Set Border."""
import bpy
from bpy.props import EnumProperty

from ..bridge import border_segments
from ..model.refusal import Refusal
from ..ui.tool_properties import BORDERS

UNSET = ('unset', "As the Tool", "The selected vertices have no border of their own: that of the tool holds")


class REFLINES_OT_set_border(bpy.types.Operator):
    """Set what happens at the selected edges or vertices where they are the border of a region, whatever tool is used;
of selected faces it is set at their rim"""
    bl_idname = "reflines.set_border"
    bl_label = "Set Border"
    bl_options = {'REGISTER', 'UNDO'}

    border: EnumProperty(name="Border", items=(*BORDERS, UNSET), default='clamped',
                         description="What happens at the selected vertices where they are a region's border")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Returns the tooltip of the button for one border."""
        return next(item[2] for item in (*BORDERS, UNSET) if item[0] == properties.border)

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        cls.poll_message_set("Select edges or vertices of a panel's border in Edit Mode")
        return ob is not None and ob.type == 'MESH' and ob.mode == 'EDIT' and ob.data.total_vert_sel > 0

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            counts = {ob.name: border_segments.set_selected_border(ob, self.border)
                      for ob in context.objects_in_mode_unique_data if ob.type == 'MESH'}
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        label = next(item[1] for item in (*BORDERS, UNSET) if item[0] == self.border)
        told = (f"{name}: {count} vertices" for name, count in counts.items() if count)
        self.report({'INFO'}, f"Border {label}, {'; '.join(told)}")
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_set_border])
