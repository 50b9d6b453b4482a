"""Check Panel in Blender: its table, what it says of a run, its files, and what it refuses."""
import csv
import json
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.state import last_checks


def rows(ob: bpy.types.Object) -> dict[str, bpy.types.PropertyGroup]:
    return {row.name: row for row in ob.reflection_lines.check.rows}


def check(ob: bpy.types.Object) -> dict[str, bpy.types.PropertyGroup]:
    before = scenes.fingerprint(ob)
    assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}
    assert scenes.fingerprint(ob) == before
    return rows(ob)


def solved_panel(**settings: object) -> bpy.types.Object:
    ob = scenes.edited_panel(margin=2)
    assert scenes.smooth(**settings) == {'FINISHED'}
    return ob


def test_a_clean_panel_passes_without_a_run() -> None:
    ob = scenes.panel(height=scenes.crown)
    scenes.edit_inner(ob, margin=3)
    table = check(ob)
    assert set(table) == {"border gap", "border angle", "border curvature", "deviation", "deviation of 95 %"}
    assert all(row.passes for row in table.values())
    assert table["border angle"].after < 1e-3
    assert ob.reflection_lines.check.seams == 4 * 10
    assert ob.reflection_lines.check.headline().startswith("Passes")


@pytest.mark.parametrize("name", scenes.TRANSFORMS)
def test_a_run_is_told_before_and_after(name: str) -> None:
    ob = solved_panel(length=0.6)
    scenes.object_mode()
    scenes.transformed(ob, scenes.TRANSFORMS[name])
    scenes.edit(ob)
    assert scenes.smooth(length=0.3) == {'FINISHED'}
    table, report = check(ob), ob.reflection_lines.report
    assert table["move along the view"].after == pytest.approx(report.largest_move)
    assert table["move along the view"].mark == pytest.approx(report.automatic_limit)
    assert table["lines off their course"].before == pytest.approx(report.score_before)
    assert 0.0 < table["deviation"].after <= report.largest_move * (1.0 + 1e-5)
    assert table["deviation of 95 %"].after <= table["deviation"].after
    assert table["border curvature"].after != table["border curvature"].before
    assert table["border gap"].after == 0.0


def test_the_marks_of_the_scene_decide() -> None:
    ob = solved_panel(length=0.6)
    marks = bpy.context.scene.reflection_lines.marks
    marks.curvature = 0.1
    row = check(ob)["border curvature"]
    assert not row.passes and "beyond the mark 0.1 %" in row.describe(compared=True)
    assert "border curvature" in ob.reflection_lines.check.headline()
    assert ob.reflection_lines.check.failed > 0
    marks.curvature = 1e4
    assert check(ob)["border curvature"].passes


@pytest.mark.parametrize(("system", "unit"), [('METRIC', 1.0), ('METRIC', 1e-3), ('IMPERIAL', 0.0254),
                                              ('NONE', 1e-3)])
def test_the_mark_of_the_gap_is_a_length_in_any_unit(system: str, unit: float) -> None:
    """Two hundredths of a millimetre pass at a gap of half of that, and not at twice as much."""
    scene, marks = bpy.context.scene, bpy.context.scene.reflection_lines.marks
    scene.unit_settings.system, scene.unit_settings.scale_length = system, unit
    metre = 1.0 if system == 'NONE' else 1.0 / unit
    assert marks.gap == pytest.approx(2e-5 * metre)
    steps = metre * np.linspace(0.0, 4e-3, 5)
    grid = [(x, y, 0.0) for y in steps for x in steps]
    faces = scenes.quads(5, 5)
    for gap, passes in ((1e-5, True), (4e-5, False)):
        beside = [(x + metre * (4e-3 + gap), y, z) for x, y, z in grid]
        ob = scenes.linked("Sheets", grid + beside, faces + [tuple(25 + i for i in face) for face in faces])
        scenes.edit(ob)
        scenes.select_faces(ob, lambda face: face < 16)
        assert check(ob)["border gap"].passes == passes
        scenes.object_mode()
        bpy.data.objects.remove(ob)
    marks.gap = 5e-5 * metre
    assert marks.gap == pytest.approx(5e-5 * metre)


def test_after_a_change_the_shape_is_checked_as_it_is() -> None:
    ob = solved_panel(length=0.6)
    scenes.object_mode()
    ob.data.vertices[144].co.z += 0.01
    assert "lines off their course" not in check(ob) and not ob.reflection_lines.check.compared


def test_what_was_beyond_the_mark_before_is_no_failure_of_the_press() -> None:
    """The lines become better, and the kink at the border stays."""
    ob = scenes.panel(height=lambda x, y: scenes.rippled(x, y) + 0.3 * max(0.0, x - 0.5))
    scenes.look_from_above()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face % 16 < 12)
    assert scenes.smooth() == {'FINISHED'}
    bpy.context.scene.reflection_lines.marks.curvature = 1e4
    table, said = check(ob), ob.reflection_lines.check.headline()
    angle = table["border angle"]
    assert not angle.passes and angle.change != "worse" and angle.after > 5.0
    lines, report = table["lines off their course"], ob.reflection_lines.report
    assert report.healed and (lines.before, lines.after) == (report.worst_before, report.worst_after)
    assert lines.change == "better"
    assert said.startswith("Better than before: ") and "worse" not in said
    assert said.partition("beyond the mark, as before: ")[2].startswith("border angle"), said
    drawn = last_checks.find_check(ob.name)
    assert not drawn.worse.any() and len(drawn.worst) and "worse" not in drawn.change


def find_distance(some: np.ndarray, others: np.ndarray) -> float:
    """Finds the largest distance of an edge's middle from the next of the others; their order is any."""
    apart = some.mean(axis=1)[:, np.newaxis] - others.mean(axis=1)
    return float(np.linalg.norm(apart, axis=2).min(axis=1).max())


@pytest.mark.parametrize("kind", ["mesh", "cage"])
@pytest.mark.parametrize("scale", [1.0, 1000.0, -2.0])
def test_an_object_that_moved_since_is_checked_where_it_is(kind: str, scale: float) -> None:
    ob = scenes.panel()
    if kind == "cage":
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 1
    scenes.look_from_above()
    scenes.edit_inner(ob, margin=2)
    assert scenes.smooth(length=0.6) == {'FINISHED'}
    scenes.object_mode()
    there = {name: (row.unit, row.after, row.mark) for name, row in check(ob).items()}
    drawn = last_checks.find_check(ob.name).segments
    ob.location, ob.rotation_euler, ob.scale = (0.0, 0.0, 3.0), (0.3, 0.0, 0.0), (scale, abs(scale), abs(scale))
    bpy.context.view_layer.update()
    bpy.context.scene.reflection_lines.marks.gap = 1.0
    for name, row in check(ob).items():
        unit, after, mark = there[name]
        factor = abs(scale) if unit == "length" else 1.0
        assert row.after == pytest.approx(factor * after, rel=1e-3, abs=1e-6 * abs(scale))
        assert name == "border gap" or row.mark < 0.0 or row.mark == pytest.approx(mark * factor)
    assert find_distance(last_checks.find_check(ob.name).segments, drawn) < 1e-5


def test_an_object_scaled_to_nothing_since_is_refused() -> None:
    ob = solved_panel(length=0.6)
    ob.scale.z = 0.0
    with pytest.raises(RuntimeError, match="scaled to nothing"):
        bpy.ops.reflines.check('EXEC_DEFAULT', True)


def test_a_cage_is_checked_on_its_surface() -> None:
    ob = scenes.panel(height=scenes.rippled, cells=12)
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    scenes.look_from_above()
    scenes.edit_inner(ob, cells=12, margin=3)
    assert scenes.smooth(length=0.6) == {'FINISHED'}
    table, report = check(ob), ob.reflection_lines.report
    assert 0.0 < table["deviation"].after <= report.largest_move * (1.0 + 1e-5)
    assert ob.reflection_lines.check.seams == 4 * 6 * 4  # the surface has four edges for each of the cage's
    assert table["border angle"].after < 0.1


def test_the_table_is_written_as_csv_and_json(tmp_path: Path) -> None:
    ob = solved_panel(length=0.6)
    table = check(ob)
    for name in ("table.csv", "table.JSON"):
        assert bpy.ops.reflines.export_table(filepath=str(tmp_path / name)) == {'FINISHED'}
    with (tmp_path / "table.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert [line["name"] for line in lines] == list(table)
    told = json.loads((tmp_path / "table.JSON").read_text())
    assert told["object"] == ob.name and told["passes"] == all(row.passes for row in table.values())
    assert told["worse"] == any(row.change == "worse" for row in table.values())
    for line, own in zip(lines, told["rows"], strict=True):
        assert np.isclose(float(line["after"]), own["after"], rtol=1e-6)
        assert (line["mark"] == "") == (own["mark"] is None)


@pytest.mark.parametrize(("name", "said"), [("table.txt", "does not end in .csv or .json"),
                                            ("none/table.csv", "No such file")])
def test_files_that_cannot_be_written_are_told(tmp_path: Path, name: str, said: str) -> None:
    ob = scenes.panel()
    scenes.edit_inner(ob)
    check(ob)
    with pytest.raises(RuntimeError, match=said):
        bpy.ops.reflines.export_table(filepath=str(tmp_path / name))
    assert not list(tmp_path.iterdir())


def test_a_file_beside_the_blend_file(tmp_path: Path) -> None:
    ob = scenes.panel()
    scenes.edit_inner(ob)
    check(ob)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "panel.blend"))
    assert bpy.ops.reflines.export_table(filepath="//table.csv") == {'FINISHED'}
    assert (tmp_path / "table.csv").is_file()


@pytest.mark.parametrize("kind", ["object", "mesh"])
def test_what_cannot_be_changed_can_be_checked(tmp_path: Path, kind: str) -> None:
    ob = solved_panel(length=0.6)
    scenes.object_mode()
    ob.shape_key_add(name="Basis")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (_, wanted):
        wanted.objects = ["Panel"]
    ob = wanted.objects[0] if kind == "object" else bpy.data.objects.new("Own", wanted.objects[0].data)
    bpy.context.collection.objects.link(ob)
    scenes.activate(ob)
    assert "border angle" in check(ob)


def test_no_faces_are_refused_in_a_sentence() -> None:
    ob = scenes.edited_panel()
    scenes.smooth(strength=0.0)
    scenes.object_mode()
    ob.data.vertices[140].co.z += 0.01
    scenes.edit(ob)
    scenes.select_faces(ob, lambda _: False)
    with pytest.raises(RuntimeError, match="No faces are selected: select the faces of the panel"):
        bpy.ops.reflines.check()
    assert not len(ob.reflection_lines.check.rows)
