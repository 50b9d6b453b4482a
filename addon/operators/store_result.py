"""The operator Store Result."""
from collections.abc import Iterable

import bpy
import numpy as np

from ..model.refusal import Refusal, report_refusals
from ..model.solution import LastSolve
from ..read import mesh_checks, read_mesh, scene_objects
from ..solver import solve
from ..state import solve_history
from ..write import vertex_attributes


class REFLINES_OT_store_result(bpy.types.Operator):
    """Store what the last solve moved (reflines_deviation) and could not reach (reflines_residual) as attributes of the
mesh's vertices, for shaders, modifiers and other programs"""
    bl_idname = "reflines.store_result"
    bl_label = "Store Result as Attributes"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        cls.poll_message_set("Make a panel active that is as a tool left it")
        return ob is not None and ob.type == 'MESH' and solve_history.find_last_solve(ob.name_full) is not None

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = scene_objects.read_active_object(context)
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        solution = solve_history.find_last_solve(ob.name_full)
        values = {f"reflines_{name}": each for name, each in solve.compute_vertex_values(solution).items()}
        self.refuse_unfit(ob, solution, values)
        for name, each in values.items():
            everywhere = np.zeros(len(ob.data.vertices))
            everywhere[solution.patch.index] = each
            vertex_attributes.store_vertex_values(ob, name, everywhere)
        return {'FINISHED'}

    def refuse_unfit(self, ob: bpy.types.Object, solution: LastSolve, names: Iterable[str]) -> None:
        if read_mesh.read_shape_before(ob, solution.patch, solution.positions) is None:
            raise Refusal(f"{ob.name} is not as the last solve left it: run the tool again")
        for name in names:
            mesh_checks.refuse_taken_attribute(ob, name)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_store_result])
