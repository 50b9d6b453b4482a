"""Shut lines in Check: gap and flush of objects beside each other, the table, its file and what is drawn."""
import csv
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.model.steps import finish
from reflection_lines.read import read_beside
from reflection_lines.state import last_checks
from test_across_gap import MATRICES, bent, half, start

GAP, STEP = 0.004, 0.0008


def check(ob: bpy.types.Object) -> dict[str, bpy.types.PropertyGroup]:
    before = scenes.fingerprint(ob)
    assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}
    assert scenes.fingerprint(ob) == before
    return {row.name: row for row in ob.reflection_lines.check.rows if row.shut_line}


def raised(x: float, y: float) -> float:
    return scenes.crown(x, y) + STEP


def start_halves(height: object = scenes.crown, matrix: str = "plain", gap: float = GAP) -> bpy.types.Object:
    half("Right", 0.5 * gap, 1.0, raised, 17, MATRICES[matrix])
    left = half("Left", -1.0, -0.5 * gap, height)
    start(left)
    return left


@pytest.mark.parametrize("matrix", list(MATRICES))
def test_gap_and_step_towards_another_object(matrix: str) -> None:
    ob = start_halves(matrix=matrix)
    table = check(ob)
    assert len(table) == 8 and {row.beside for row in table.values()} == {"Right"}
    assert table["smallest gap of shut line 1"].after == pytest.approx(GAP, rel=1e-3)
    assert table["largest gap of shut line 1"].after == pytest.approx(GAP, rel=1e-3)
    for name in ("lowest", "highest"):
        row = table[f"{name} flush of shut line 1"]
        assert row.after == pytest.approx(STEP, rel=0.02) and not row.passes and row.mark == pytest.approx(5e-4)
    assert table["kink of shut line 1"].passes and table["line offset of shut line 1"].passes
    shown, = ob.reflection_lines.check.list_shut_lines()
    assert shown.find_change(compared=False) == "worse"
    said = shown.describe()
    assert said.startswith("Shut line 1, Right: gap 4 mm to 4 mm, flush 0.78") and "to 0.8 mm, kink 0.00\u00b0" in said
    assert said.endswith("and 0.1 % off (beyond the mark: lowest flush, highest flush)")


def test_the_mark_of_the_scene_decides_and_its_line_is_drawn() -> None:
    ob = start_halves()
    check(ob)
    drawn = last_checks.find_check(ob.name)
    assert set(drawn.change) == {"worse"} and len(drawn.segments) == 48 and len(drawn.worst) == 2
    assert np.allclose(np.abs(drawn.segments[:, :, 0]), 0.5 * GAP, atol=1e-6)
    marks = bpy.context.scene.reflection_lines.marks
    marks.shut_line = 1e-3
    assert all(row.passes for row in check(ob).values())
    assert set(last_checks.find_check(ob.name).change) == {"better"}


def test_a_press_that_heals_the_kink_is_told() -> None:
    ob = start_halves(bent)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    kink = check(ob)["kink of shut line 1"]
    assert kink.before > 2.5 and kink.after < 0.3 and kink.change == "better"
    assert "kink of shut line 1" in ob.reflection_lines.check.headline()
    assert {"better"} <= set(last_checks.find_check(ob.name).change)


def test_the_file_has_the_shut_line_its_object_and_the_places(tmp_path: Path) -> None:
    ob = start_halves()
    table = check(ob)
    assert bpy.ops.reflines.export_table(filepath=str(tmp_path / "table.csv")) == {'FINISHED'}
    with (tmp_path / "table.csv").open(newline="") as file:
        lines = [line for line in csv.DictReader(file) if line["shut_line"] != "0"]
    assert [line["name"] for line in lines] == list(table) and {line["beside"] for line in lines} == {"Right"}
    place = [float(lines[0][axis]) for axis in "xyz"]
    assert place[0] == pytest.approx(-0.5 * GAP, abs=1e-6)
    assert place[2] == pytest.approx(scenes.crown(*place[:2]), abs=1e-3)


def test_without_view_and_light_gap_and_flush_are_told_alone() -> None:
    ob = start_halves()
    bpy.data.objects.remove(bpy.context.scene.reflection_lines.light)
    table = check(ob)
    assert len(table) == 6 and table["largest gap of shut line 1"].after == pytest.approx(GAP, rel=1e-3)


@pytest.mark.parametrize("scale", [1.0, -2.0])
def test_a_cage_is_measured_on_its_surface(scale: float) -> None:
    right, left = half("Right", 0.5 * GAP, 1.0, raised, 8), half("Left", -1.0, -0.5 * GAP, scenes.crown, 8)
    for ob in (right, left):
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    bpy.data.objects["Parent"].scale = (scale, abs(scale), abs(scale))
    bpy.context.view_layer.update()
    start(left)
    row = check(left)["smallest gap of shut line 1"]
    assert row.after == pytest.approx(GAP * abs(scale), rel=0.02) and row.beside == "Right"


def test_neighbors_are_the_same_read_at_once_or_object_by_object(monkeypatch: pytest.MonkeyPatch) -> None:
    ob = start_halves()
    for number in range(3):
        half(f"Other {number}", 0.5 * GAP, 1.0, raised, 5 + number)
    scenes.object_mode()
    V = scenes.world(ob)
    whole = finish(read_beside.read_neighbors(ob, V))
    monkeypatch.setattr(read_beside, "STEP", -1.0)
    steps = list(read_beside.read_neighbors(ob, V))
    parts = finish(read_beside.read_neighbors(ob, V))
    assert len(steps) >= 4 and parts.names == whole.names == ["Right", "Other 0", "Other 1", "Other 2"]
    assert all(np.array_equal(getattr(parts, name), getattr(whole, name)) for name in ("V", "F", "label"))
