"""Set Border."""
import bpy
from bpy.props import EnumProperty

from ..blender.tooltips import tell_by
from ..model.refusal import report_refusals
from ..read import scene_objects
from ..ui.tool_properties import BORDERS
from ..write import set_borders

UNSET = ('unset', "As the Tool", "The selected vertices have no border of their own: that of the tool holds")


class REFLINES_OT_set_border(bpy.types.Operator):
    """Set what happens at the selected edges or vertices where they are the border of a region, whatever tool is used;
of selected faces it is set at their rim"""
    bl_idname = "reflines.set_border"
    bl_label = "Set Border"
    bl_options = {'REGISTER', 'UNDO'}

    border: EnumProperty(name="Border", items=(*BORDERS, UNSET), default='clamped', options={'HIDDEN'},
                         description="What happens at the selected vertices where they are a region's border")

    description = tell_by("border", {item[0]: item[2] for item in (*BORDERS, UNSET)})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("Select edges or vertices of a panel's border in Edit Mode")
        return scene_objects.has_selected_vertices(context)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        objects = [ob for ob in scene_objects.list_edited_meshes(context) if ob.data.total_vert_sel > 0]
        counts = set_borders.set_selected_borders(objects, self.border)
        label = next(item[1] for item in (*BORDERS, UNSET) if item[0] == self.border)
        counted = (f"{ob.name}: {count} vertices" for ob, count in zip(objects, counts, strict=True) if count)
        self.report({'INFO'}, f"Border {label}, {'; '.join(counted)}")
        return {'FINISHED'}
