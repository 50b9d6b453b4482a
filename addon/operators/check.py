"""The operator Check Panel."""
import bpy
import numpy as np

from ..model import check_table
from ..model.check_table import TableRow
from ..model.checked_surface import CheckedSurface
from ..model.patch import Patch, compute_bounds
from ..model.refusal import Refusal, report_refusals
from ..read import mesh_checks, read_beside, read_checked, read_mesh, read_patch, scene_objects
from ..read.mesh_checks import Purpose
from ..solver import live_optimizer, panel_check, shut_lines
from ..solver.panel_check import Checked
from ..state import last_checks, solve_history
from ..state.last_checks import DrawnCheck
from ..view import view_and_light


class REFLINES_OT_check(bpy.types.Operator):
    """Measure borders, creases, gap and flush of shut lines and the deviation: what is better or worse than before the
last run, or beyond its mark; without a run the selected faces alone"""
    bl_idname = "reflines.check"
    bl_label = "Check Panel"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        cls.poll_message_set("Make a panel's mesh active, in Edit Mode or Object Mode")
        return ob is not None and ob.type == 'MESH' and ob.mode in {'EDIT', 'OBJECT'}

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        ob, settings = scene_objects.read_active_object(context), context.scene.reflection_lines.marks
        patch, positions, own = self.find_subject(ob)
        marks = panel_check.Marks(settings.gap, settings.angle, settings.curvature, find_limit(own))
        with live_optimizer.convert_native_errors(patch):
            surface = read_checked.read_checked_surface(ob, patch, positions)
            found = panel_check.check_surface(surface, marks)
            shut = check_shut_lines(context.scene, ob, surface)
        stored = ob.reflection_lines.check
        stored.fill([*found.rows, *own, *shut.rows], len(found.passes), int((~found.passes).sum()),
                    compared=bool(own))
        last_checks.remember_check(ob.name_full, build_drawn(ob, found.join(shut), compared=bool(own)))
        self.report({'INFO'}, f"{ob.name}: {stored.headline()}")
        return {'FINISHED'}

    def find_subject(self, ob: bpy.types.Object) -> tuple[Patch, np.ndarray, list[TableRow]]:
        """Returns the patch, its positions now, and the lines of the table that tell of the last run."""
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        last = solve_history.find_last_solve(ob.name_full)
        if last is not None and read_mesh.read_shape_before(ob, last.patch, last.positions) is not None:
            mesh_checks.refuse_flat(ob)
            patch, positions, growth = read_checked.follow_object(ob, last.patch, last.positions)
            report = ob.reflection_lines.report
            return patch, positions, check_table.describe_solve(report.lines_off(), growth * report.largest_move,
                                                                growth * report.automatic_limit or None)
        patch = read_patch.gather_mesh_patch(ob, or_all=True, purpose=Purpose.READ)
        return patch, patch.V, []


def find_limit(rows: list[TableRow]) -> float | None:
    """Returns the limit of the last run, which is the mark of its deviation, too; None where there is none."""
    return next((row.mark for row in rows if row.name == "move along the view"), None)


def check_shut_lines(scene: bpy.types.Scene, ob: bpy.types.Object, surface: CheckedSurface) -> Checked:
    """Measures the shut lines of an object's surface; how lines run across where the scene has view and light."""
    V = surface.after[surface.F[surface.region]].reshape(-1, 3)
    try:
        seen = view_and_light.read_scene_view(scene, np.mean(compute_bounds(V), axis=0))
    except Refusal:
        seen = None
    settings = scene.reflection_lines
    return shut_lines.check_shut_lines(surface, ob.name, read_beside.read_neighbors(ob, V), seen,
                                       2.0 * np.pi / settings.stripes.count, settings.marks.shut_line)


def build_drawn(ob: bpy.types.Object, found: Checked, *, compared: bool) -> DrawnCheck:
    """Takes to object space what is drawn of a check; without a run what passes counts as better, the rest as worse."""
    inverse = np.linalg.inv(np.array(ob.matrix_world, dtype=np.float64))
    segments, worst = (points @ inverse[:3, :3].T + inverse[:3, 3] for points in (found.segments, found.worst))
    change = found.change if compared else np.where(found.passes, "better", "worse")
    worse = found.worse if compared else np.ones(len(worst), dtype=bool)
    return DrawnCheck(segments, change, worst, worse, read_mesh.read_shown_coordinates(ob))


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_check])
