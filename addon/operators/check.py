"""The operator Check Panel."""
import bpy
import numpy as np

from ..interactive import check_job
from ..interactive.beside_blender import PanelWork
from ..interactive.check_job import CheckInput, CheckJob, CheckOutcome, CheckRequest
from ..model import check_table
from ..model.check_table import TableRow
from ..model.patch import Patch, compute_bounds
from ..model.refusal import Refusal
from ..model.steps import Steps, finish
from ..model.view import View
from ..native_call import run_now
from ..read import gather, mesh_checks, read_beside, read_checked, read_mesh, scene_objects
from ..read.mesh_checks import Purpose
from ..solver import live_optimizer, panel_check
from ..solver.panel_check import Checked
from ..solver.shut_lines import ShutLineMarks
from ..state import last_checks, solve_history
from ..state.last_checks import DrawnCheck
from ..view import view_and_light


class REFLINES_OT_check(PanelWork[CheckOutcome], bpy.types.Operator):
    """Measure borders, creases, gap and flush of shut lines and the deviation: what is better or worse than before the
last run, or beyond its mark; without a run the selected faces alone. Esc cancels"""
    bl_idname = "reflines.check"
    bl_label = "Check Panel"
    bl_options = {'REGISTER', 'UNDO'}
    verb = "check"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return scene_objects.has_panel(cls, context)

    def find_panels(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Returns the active object, or all in Edit Mode that have selected faces or a last run, that one last."""
        active = scene_objects.read_active_object(context)
        edited = scene_objects.list_edited_meshes(context) if active.mode == 'EDIT' else ()
        found = [ob for ob in edited if ob.data.total_face_sel > 0 or solve_history.find_last_solve(ob.name_full)]
        return sorted(found, key=lambda ob: (ob == active, ob.name)) or [active]

    def look_at(self, context: bpy.types.Context, ob: bpy.types.Object) -> CheckOutcome:
        return run_now(check_job.measure(*finish(self.read(context.scene, ob))))

    def build_job(self, context: bpy.types.Context, ob: bpy.types.Object) -> CheckJob:
        return CheckJob(self.read(context.scene, ob))

    def read(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> Steps[CheckInput]:
        """Reads the panel in the first step, and then what lies around and beside it; refuses what cannot be checked.
        """
        patch, positions, own = self.find_subject(ob)
        yield
        with live_optimizer.convert_native_errors(patch):
            surface = read_checked.read_checked_surface(ob, patch, positions)
        yield
        inside = np.zeros(len(surface.after), dtype=bool)
        inside[surface.F[surface.region]] = True
        V, settings = surface.after[inside], scene.reflection_lines
        marks = panel_check.Marks(settings.marks.gap, settings.marks.angle, settings.marks.curvature, find_limit(own))
        shut_line_marks = ShutLineMarks(find_view(scene, V), 2.0 * np.pi / settings.stripes.count,
                                        settings.marks.shut_line)
        neighbors = yield from read_beside.read_neighbors(ob, V)
        return CheckRequest(ob.name, patch, surface, own, marks, shut_line_marks), neighbors

    def describe_end(self) -> str:
        return "Check Panel was cancelled: the last check stays"

    def store(self, ob: bpy.types.Object, outcome: CheckOutcome) -> None:
        """Stores the table and what is drawn."""
        found, shut, own = outcome.found, outcome.shut, outcome.own
        stored = ob.reflection_lines.check
        stored.fill([*found.rows, *own, *shut.rows], len(found.passes), int((~found.passes).sum()),
                    compared=bool(own))
        last_checks.remember_check(ob.name_full, build_drawn(ob, found.join(shut), self.panel.shape,
                                                             compared=bool(own)))
        self.report({'INFO'}, f"{ob.name}: {stored.headline()}")

    def find_subject(self, ob: bpy.types.Object) -> tuple[Patch, np.ndarray, list[TableRow]]:
        """Returns the patch, its positions now, and the lines of the table that tell of the last run."""
        last = solve_history.find_last_solve(ob.name_full)
        if last is not None and ob.mode == 'EDIT':
            ob.update_from_editmode()
        if last is not None and read_mesh.read_shape_before(ob, last.patch, last.positions) is not None:
            mesh_checks.refuse_flat(ob)
            patch, positions, growth = read_checked.follow_object(ob, last.patch, last.positions)
            report = ob.reflection_lines.report
            return patch, positions, check_table.describe_solve(report.lines_off(), growth * report.largest_move,
                                                                growth * report.automatic_limit or None)
        patch = gather.gather_patch(ob, as_mesh=True, or_all=True, purpose=Purpose.READ)
        return patch, patch.V, []


def find_limit(rows: list[TableRow]) -> float | None:
    """Returns the limit of the last run, which is the mark of its deviation, too; None where there is none."""
    return next((row.mark for row in rows if row.name == "move along the view"), None)


def find_view(scene: bpy.types.Scene, V: np.ndarray) -> View | None:
    """Returns the view and light of a scene for a panel with these vertices, None where it has none."""
    try:
        return view_and_light.read_scene_view(scene, np.mean(compute_bounds(V), axis=0))
    except Refusal:
        return None


def build_drawn(ob: bpy.types.Object, found: Checked, shape: np.ndarray, *, compared: bool) -> DrawnCheck:
    """Takes to object space what is drawn of a check of a mesh with these coordinates; without a run what passes counts
    as better, the rest as worse.
    """
    inverse = np.linalg.inv(np.array(ob.matrix_world, dtype=np.float64))
    segments, worst = (points @ inverse[:3, :3].T + inverse[:3, 3] for points in (found.segments, found.worst))
    change = found.change if compared else np.where(found.passes, "better", "worse")
    worse = found.worse if compared else np.ones(len(worst), dtype=bool)
    return DrawnCheck(segments, change, worst, worse, shape)
