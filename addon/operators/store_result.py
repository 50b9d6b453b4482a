"""Store Result."""
import bpy
import numpy as np

from .. import session
from ..bridge import apply, gather


class REFLINES_OT_store_result(bpy.types.Operator):
    """Store what the last solve moved (reflines_deviation) and could not reach (reflines_residual) as attributes of the
mesh's vertices, for shaders, modifiers and other programs"""
    bl_idname = "reflines.store_result"
    bl_label = "Store Result as Attributes"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        cls.poll_message_set("Make a panel active on which a tool has run since the file was opened")
        return ob is not None and ob.type == 'MESH' and session.last_solution(ob.name) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = context.view_layer.objects.active
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        solution, V = session.last_solution(ob.name), gather.coordinates(ob)
        index = solution.panel.index
        left = apply.local(solution.panel, solution.positions)
        if len(V) <= index.max() or not np.array_equal(V[index].astype(np.float32), left):
            self.report({'ERROR'}, f"{ob.name} is not as the last solve left it: run the tool again")
            return {'CANCELLED'}
        for name, values in session.vertex_values(solution).items():
            everywhere = np.zeros(len(V))
            everywhere[index] = values
            apply.store_vertex_values(ob, f"reflines_{name}", everywhere)
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_store_result])
