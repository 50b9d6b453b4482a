"""Pin Lines."""
import bpy
from bpy.props import BoolProperty

from ..read import pinned_faces, scene_objects


class REFLINES_OT_pin_lines(bpy.types.Operator):
    """Pin the reflection lines on the selected faces: Pull Line leaves them where they are"""
    bl_idname = "reflines.pin_lines"
    bl_label = "Pin Lines"
    bl_options = {'REGISTER', 'UNDO'}

    unpin: BoolProperty(name="Unpin", options={'HIDDEN', 'SKIP_SAVE'},
                        description="Let the lines on the selected faces go again")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Returns the tooltip of the button that unpins; empty for the other, which has the docstring."""
        return "Let the lines on the selected faces go again" if properties.unpin else ""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("Select faces of a panel in Edit Mode")
        return scene_objects.has_edited_selection(context, "total_face_sel")

    def execute(self, context: bpy.types.Context) -> set[str]:
        done = 'no longer pinned' if self.unpin else 'pinned'
        for ob in scene_objects.list_edited_meshes(context):
            if ob.data.total_face_sel > 0:
                count = pinned_faces.pin_selected_faces(ob.data, pinned=not self.unpin)
                self.report({'INFO'}, f"{ob.name}: the lines on {count} faces are {done}")
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_pin_lines])
