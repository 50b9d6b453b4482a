"""Smooth Reflection Lines with the automatic length: the native function's result, on designed panels and flaws."""
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from reflection_lines import native
from reflection_lines.state import press_cache, solve_history

import scenes

CELLS = 36
LINE = 0.5     # where the character lines run: x = -LINE and x = LINE
DENT = (0.1, -0.2, 0.1, 0.004)  # x, y, radius, depth


def bonnet(x: float, y: float) -> float:
    """A symmetric crowned panel with two character lines, which turn by 9 degrees within a few cells."""
    return scenes.crown(x, y) - 0.04 * (np.hypot(x - LINE, 0.04) + np.hypot(x + LINE, 0.04))


def dented(x: float, y: float) -> float:
    return bonnet(x, y) - DENT[3] * np.exp(-((x - DENT[0]) ** 2 + (y - DENT[1]) ** 2) / DENT[2] ** 2)


def ready() -> bpy.types.Object:
    return scenes.edited_panel(height=dented, cells=CELLS)


def expected(ob: bpy.types.Object, **settings: object) -> np.ndarray:
    """What the native function makes of the region that the last press took."""
    patch, scene = solve_history.find_last_solve(ob.name).patch, bpy.context.scene.reflection_lines
    positions, told = native.reflines.smooth_panel(
        patch.V, patch.F, view_direction=scenes.axis_z(scene.camera), line_direction=scenes.axis_z(scene.light),
        **settings)
    assert told.applied
    return positions


@pytest.mark.parametrize(("settings", "arguments"), [
    ({}, {}),
    ({"lights": 'SINGLE', "border": 'fixed'}, {"lights": "single", "border": "fixed"}),
    ({"symmetric": False, "strength": 0.5}, {"symmetric": False, "strength": 0.5}),
    ({"flaw_size": 2.0}, {"flaw_size": 2.0}),
    ({"limit": 2.0**-10}, {"limit": 2.0**-10})])
def test_a_press_gives_the_positions_of_the_native_function_to_the_bit(settings: dict, arguments: dict) -> None:
    ob = ready()
    before = scenes.world(ob)
    assert scenes.smooth(**settings) == {'FINISHED'}
    last = solve_history.find_last_solve(ob.name)
    assert np.array_equal(last.patch.V, before[last.patch.index])
    assert len(last.patch.F) == 2 * (CELLS - 2) ** 2
    wanted = expected(ob, **arguments)
    assert np.array_equal(last.positions, wanted)
    assert np.array_equal(scenes.positions(ob)[last.patch.index], wanted.astype(np.float32))
    assert ob.reflection_lines.report.largest_move == pytest.approx(np.abs(wanted - last.patch.V).max(), rel=1e-4)


def test_another_strength_takes_what_the_first_press_found() -> None:
    """As the redo panel does: the mesh is put back, and the press repeated with another strength, limit or symmetry."""
    ob = ready()
    before = scenes.positions(ob)
    scenes.smooth()
    kept = press_cache._presses[ob.name]
    for settings in ({"strength": 0.5}, {"strength": 0.5, "limit": 2.0**-10}, {"symmetric": False}):
        scenes.object_mode()
        ob.data.vertices.foreach_set("co", before.ravel())
        scenes.edit_inner(ob, CELLS)
        assert scenes.smooth(**settings) == {'FINISHED'}
        assert (press_cache._presses[ob.name].smoother is kept.smoother) == ("symmetric" not in settings)
        assert np.array_equal(solve_history.find_last_solve(ob.name).positions, expected(ob, **settings))
    scenes.smooth()  # of the mesh as it is now
    assert press_cache._presses[ob.name].smoother is not kept.smoother
    scenes.smooth(symmetric=False)
    scenes.object_mode()
    ob.select_set(False)
    other = scenes.panel(height=dented, cells=CELLS, name="Other")
    scenes.edit_inner(other, CELLS)
    scenes.smooth(length=0.5)
    assert not press_cache._presses


def test_the_scenes_settings_are_taken() -> None:
    ob = ready()
    bpy.context.scene.reflection_lines.lights, bpy.context.scene.reflection_lines.symmetric = 'SINGLE', False
    scenes.smooth()
    last = solve_history.find_last_solve(ob.name)
    assert np.array_equal(last.positions, expected(ob, lights="single", symmetric=False))
    assert not np.array_equal(last.positions, expected(ob))


def test_the_result_says_when_the_limit_held_vertices_back() -> None:
    ob = ready()
    scenes.smooth(limit=0.001)
    report = ob.reflection_lines.report
    assert report.largest_move == pytest.approx(0.001, rel=1e-4) and report.limited > 0
    assert f"moved at most 1 mm (the limit held {report.limited} vertices back)" in report.headline()
    assert "limit" not in report.notes  # it is said once
    scenes.smooth(limit=1.0)
    assert "limit" not in report.headline()


def test_twice_the_limit_is_offered_where_it_held_vertices_back() -> None:
    ob = ready()
    scenes.smooth(limit=0.0005)
    report, run = ob.reflection_lines.report, ob.reflection_lines.run
    assert run.read_length("limit") == pytest.approx(0.0005)
    held = report.limited
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, limit=2.0 * run.read_length("limit")) == {'FINISHED'}
    assert report.largest_move == pytest.approx(0.001, rel=1e-4) and 0 < report.limited < held
    run.settings = '{"limit": "much"}'
    assert run.read_length("limit") == 0.0


def test_the_numbers_are_those_of_the_native_call() -> None:
    """The residual is that of one light: by area its root mean square is that light's unevenness over one length."""
    ob = ready()
    before = scenes.world(ob)
    scenes.smooth()
    last, report = solve_history.find_last_solve(ob.name), ob.reflection_lines.report
    corners = before[last.patch.index][last.patch.F][:, :, :2]
    edges = corners[:, 1:] - corners[:, :1]
    area = np.abs(np.linalg.det(edges))
    assert report.residual_after == pytest.approx(np.sqrt(area @ last.residual**2 / area.sum()), rel=1e-3)
    assert report.residual_after < report.residual_before


def test_a_dent_is_healed_and_the_report_says_so() -> None:
    ob = ready()
    before = scenes.positions(ob)
    scenes.smooth()
    after, report = scenes.positions(ob), ob.reflection_lines.report
    design = np.array([bonnet(x, y) for x, y in before[:, :2].astype(float)])
    assert np.abs(before[:, 2] - design).max() > 0.9 * DENT[3]
    assert np.abs(after[:, 2] - design).max() < 0.3 * DENT[3]
    assert report.termination != "not_applied"
    assert report.score_after < report.score_before and report.residual_after < report.residual_before
    assert len(report.notes.splitlines()) <= 2


def test_what_the_native_function_refuses_is_not_applied(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its judgement is tested beside it: here it is made to refuse."""
    real = native.reflines.PanelSmoother
    why = SimpleNamespace(kind="light_would_worsen", count=0, before=1.0001, after=1.0002)

    def build(V: np.ndarray, F: np.ndarray, **settings: object) -> SimpleNamespace:
        smoother = real(V, F, **settings)

        def refuse(**amount: object) -> tuple[np.ndarray, SimpleNamespace]:
            _, told = smoother.press(**amount)
            names = [name for name in dir(told) if not name.startswith("_")]
            changed = {name: getattr(told, name) for name in names} | {"applied": False, "notes": [why]}
            return V.copy(), SimpleNamespace(**changed)

        return SimpleNamespace(press=refuse)

    monkeypatch.setattr(native.reflines, "PanelSmoother", SimpleNamespace(create=build))
    ob = ready()
    before, report = scenes.positions(ob).tobytes(), ob.reflection_lines.report
    assert scenes.smooth() == {'FINISHED'}
    assert scenes.positions(ob).tobytes() == before
    told = "Nothing was changed: the lines would have become less even in one light (1.0001 to 1.0002 degrees)."
    assert report.termination == "not_applied" and report.notes.startswith(told)
    assert report.largest_move == 0.0 and report.score_after == report.score_before
    assert report.residual_after == report.residual_before


def test_a_length_and_along_the_lines_do_not_ask_the_native_function(monkeypatch: pytest.MonkeyPatch) -> None:
    """They give what they gave before: `test_smooth.py` compares that."""
    monkeypatch.delattr(native.reflines, "PanelSmoother")
    ob = ready()
    assert scenes.smooth(length=0.5) == {'FINISHED'}
    assert scenes.smooth(directional=True) == {'FINISHED'}
    assert ob.reflection_lines.report.termination == "converged"


def test_a_cage_gets_what_the_native_function_gives() -> None:
    ob = scenes.panel(height=lambda x, y: scenes.crown(x, y) + 0.004 * np.cos(17.0 * x) * np.cos(13.0 * y), cells=12)
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    scenes.look_from_above()
    scenes.edit_inner(ob, 12)
    before = scenes.positions(ob)
    assert scenes.smooth() == {'FINISHED'}
    last, report = solve_history.find_last_solve(ob.name), ob.reflection_lines.report
    cage, scene = last.patch.cage, bpy.context.scene.reflection_lines
    arguments = cage.build_arguments(symmetric=False)
    arguments["limit_surface"] = arguments.pop("limit")
    positions, told = native.reflines.smooth_cage_panel(
        **arguments, view_direction=scenes.axis_z(scene.camera), line_direction=scenes.axis_z(scene.light))
    assert told.applied and np.abs(positions - cage.V).max() > 1e-4
    assert np.array_equal(scenes.positions(ob), positions.astype(np.float32))
    assert report.largest_move == pytest.approx(told.largest_move, rel=1e-4)
    assert np.abs(scenes.positions(ob) - before)[:, 2].max() > report.largest_move
    assert last.residual.shape == (len(last.patch.F),) and last.residual.max() > 0
    assert report.cage_move == pytest.approx(told.largest_control_move, rel=1e-4)
    assert ", its cage " in report.headline()
