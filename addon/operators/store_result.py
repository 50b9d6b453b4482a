"""Store Result."""
from collections.abc import Iterable

import bpy
import numpy as np

from .. import session, solving
from ..bridge import apply
from ..bridge.refusal import Refusal


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
        values = {f"reflines_{name}": each for name, each in solving.vertex_values(solution).items()}
        try:
            self.refuse_unfit(ob, solution, values)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        for name, each in values.items():
            everywhere = np.zeros(len(ob.data.vertices))
            everywhere[solution.panel.index] = each
            apply.store_vertex_values(ob, name, everywhere)
        return {'FINISHED'}

    def refuse_unfit(self, ob: bpy.types.Object, solution: solving.Last, names: Iterable[str]) -> None:
        if apply.before(ob, solution.panel, solution.positions) is None:
            raise Refusal(f"{ob.name} is not as the last solve left it: run the tool again")
        for name in names:
            apply.refuse_taken(ob, name)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_store_result])
