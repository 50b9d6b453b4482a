"""What restrains every tool: the limit of the move, faces that would turn far, and the lines of the crossed light."""
import bpy
import numpy as np
import pytest
from reflection_lines import native
from reflection_lines.model.solution import SolveReport
from reflection_lines.solver import remarks

import scenes


def press(tool: str, **options: object) -> tuple[bpy.types.Object, np.ndarray, np.ndarray]:
    """A tool on a new panel: the panel, and its vertices before and after."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    panel = scenes.edited_panel()
    before = scenes.positions(panel)
    assert getattr(bpy.ops.reflines, tool)(**options) == {'FINISHED'}
    return panel, before, scenes.positions(panel)


def largest_move(before: np.ndarray, after: np.ndarray) -> float:
    return float(np.abs(after - before)[:, 2].max())


def read_fields(panel: bpy.types.Object, V: np.ndarray) -> tuple[np.ndarray, ...]:
    """Gradients of the reflection function in the light of the solve and in the crossed one."""
    quads = np.array([tuple(face.vertices) for face in panel.data.polygons])
    F = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    settings = bpy.context.scene.reflection_lines
    view, line = (np.array(ob.matrix_world)[:3, 2] for ob in (settings.camera, settings.light))
    optimizer = native.reflines.ShapeOptimizer(V.astype(float), F, view_direction=view, border="free",
                                               line_direction=[line, np.cross(view, line)])
    return optimizer.field(0), optimizer.field(1)


def test_no_vertex_moves_beyond_a_twentieth_of_the_region_unasked() -> None:
    panel, before, after = press("direction", density=20.0, border='free')
    moved = (after != before).any(axis=1)
    limit, report = 0.05 * np.linalg.norm(np.ptp(before[moved], axis=0)), panel.reflection_lines.report
    assert largest_move(before, after) == pytest.approx(limit, rel=0.01)
    assert report.limited > 0 and f"holds {report.limited} vert" in report.notes and "raise Limit" in report.notes
    assert report.automatic_limit == pytest.approx(report.largest_move, rel=1e-6)


@pytest.mark.parametrize(("tool", "options"), [("direction", {"density": 2.0, "border": 'free'}),
                                               ("smooth", {"length": 1.0})])
def test_a_limit_of_the_artist_holds_for_every_tool(tool, options) -> None:
    _, before, after = press(tool, **options)
    free = largest_move(before, after)
    panel, before, after = press(tool, **options, limit=0.5 * free)
    assert largest_move(before, after) == pytest.approx(0.5 * free, rel=1e-3)
    assert panel.reflection_lines.report.limited > 0


def test_a_limit_holds_for_the_surface_of_a_cage() -> None:
    """Its own vertices move further; both moves are told."""
    moves = []
    for limit in (0.0, 0.01):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        cage = scenes.panel(cells=8)
        cage.modifiers.new("Subdivision", 'SUBSURF').levels = 2
        scenes.look_from_above()
        scenes.edit_inner(cage, 8)
        before = scenes.positions(cage)
        assert bpy.ops.reflines.direction(density=3.0, border='free', limit=limit) == {'FINISHED'}
        moves.append(largest_move(before, scenes.positions(cage)))
    assert moves[0] > 0.02
    report = cage.reflection_lines.report
    assert report.largest_move == pytest.approx(0.01, rel=1e-3) and report.limited > 0
    assert moves[1] == pytest.approx(report.cage_move, rel=1e-3) and 0.01 < moves[1] < 0.5 * moves[0]


def test_the_crossed_light_counts_unless_it_is_left_out() -> None:
    changes = {}
    for lights in ('SINGLE', 'CROSSED'):
        panel, before, after = press("direction", angle=0.3, border='free', lights=lights)
        now, then = read_fields(panel, after), read_fields(panel, before)
        changes[lights] = [np.linalg.norm(now[k] - then[k]) for k in (0, 1)]
    assert 0.0 < changes['CROSSED'][1] < 0.95 * changes['SINGLE'][1]
    assert changes['CROSSED'][0] > 0.9 * changes['SINGLE'][0]


@pytest.mark.parametrize(("termination", "told"), [("converged", 0), ("already_optimal", 0), ("iteration_limit", 1),
                                                   ("no_progress", 1)])
def test_a_solve_that_stopped_early_is_told(termination, told) -> None:
    report = SolveReport(termination, "", 100, 1.0, 10, 0.1)
    assert len(remarks.describe_unfinished(report)) == told
