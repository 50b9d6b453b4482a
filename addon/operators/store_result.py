"""Store Result."""
import bpy
import numpy as np

from .. import session, solving
from ..bridge import apply


class REFLINES_OT_store_result(bpy.types.Operator):
    """Store what the last solve moved (reflines_deviation) and could not reach (reflines_residual) as attributes of the
mesh's vertices, for shaders, modifiers and other programs"""
    bl_idname = "reflines.store_result"
    bl_label = "Store Result as Attributes"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        cls.poll_message_set("Make a panel active that is as a tool left it")
        return ob is not None and ob.type == 'MESH' and session.last_solution(ob.name) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = context.view_layer.objects.active
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        solution = session.last_solution(ob.name)
        if apply.before(ob, solution.panel, solution.positions) is None:
            self.report({'ERROR'}, f"{ob.name} is not as the last solve left it: run the tool again")
            return {'CANCELLED'}
        for name, values in solving.vertex_values(solution).items():
            everywhere = np.zeros(len(ob.data.vertices))
            everywhere[solution.panel.index] = values
            apply.store_vertex_values(ob, f"reflines_{name}", everywhere)
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_store_result])
