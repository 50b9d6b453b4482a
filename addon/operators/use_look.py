"""The operator Use Look."""
import bpy
from bpy.props import EnumProperty

from ..model.looks import LOOKS


class REFLINES_OT_use_look(bpy.types.Operator):
    """Give the stripes a look that comes with the add-on; where and from where they are seen stays"""
    bl_idname = "reflines.use_look"
    bl_label = "Use Look"
    bl_options = {'REGISTER', 'UNDO'}

    look: EnumProperty(name="Look", items=[(key, name, about) for key, (name, about, _) in LOOKS.items()],
                       default='ZEBRA', options={'SKIP_SAVE'})

    def execute(self, context: bpy.types.Context) -> set[str]:
        for name, value in LOOKS[self.look][2].items():
            setattr(context.scene.reflection_lines.stripes, name, value)
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_use_look])
