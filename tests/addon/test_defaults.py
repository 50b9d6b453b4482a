"""What a press with the default settings does, and what a tool says and offers where it did next to nothing."""
import re

import bmesh
import bpy
import numpy as np
import pytest

import scenes

CELLS = 40
PRESSES = {
    "angle": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, direction='ANGLE', angle=0.2),
    "density": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, density=1.3),
    "turn": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, angle=np.radians(10.0)),
}


@pytest.fixture
def panel() -> bpy.types.Object:
    """A clean one, a region in its middle: no target but the tool's."""
    ob = scenes.edited_panel(height=scenes.crown, cells=CELLS, margin=8)
    bpy.ops.ed.undo_push(message="start")
    return ob


def reached(ob: bpy.types.Object) -> float:
    """The share of the target."""
    report = ob.reflection_lines.report
    return 1.0 - report.residual_after / report.residual_before


def bend(ob: bpy.types.Object) -> float:
    """The largest angle of an edge between a selected face and one beside it, degrees."""
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.normal_update()
    rim = [edge for edge in mesh.edges if len({face.select for face in edge.link_faces}) == 2]
    return float(np.degrees(max(edge.calc_face_angle() for edge in rim)))


@pytest.mark.parametrize("press", PRESSES.values(), ids=PRESSES)
def test_a_press_with_the_defaults_does_not_bend_the_rim(panel, press) -> None:
    before = bend(panel)
    press()
    assert panel.reflection_lines.report.largest_move > 1e-5
    assert bend(panel) < before + 0.1 and "border of the region bends" not in panel.reflection_lines.report.notes


@pytest.mark.parametrize("press", ["angle", "turn"])
def test_what_the_border_keeps_from_its_target_is_offered_and_what_that_bends_is_said_and_offered_back(panel,
                                                                                                       press) -> None:
    before = bend(panel)
    PRESSES[press]()
    report = panel.reflection_lines.report
    assert reached(panel) < 0.2 and report.remedy == "free"
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, border=report.remedy) == {'FINISHED'}
    assert reached(panel) > 0.5 and report.remedy == "clamped"
    said = float(re.search(r"bends by up to ([0-9.]+) degrees more", report.notes)[1])
    assert said > 3.0 and bend(panel) - before == pytest.approx(said, abs=0.3)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, border=report.remedy) == {'FINISHED'}
    assert bend(panel) < before + 0.1


def test_the_automatic_fall_off_ends_inside_a_long_region(panel) -> None:
    """At half the width: the region is 2 x 0.4."""
    results = []
    for radius in ({}, {"radius": 0.2}):
        scenes.select_faces(panel, lambda face: 16 <= face // CELLS < 24)
        bpy.ops.ed.undo_push(message="select")
        bpy.ops.reflines.direction('EXEC_DEFAULT', True, angle=np.radians(10.0), **radius)
        results.append(scenes.positions(panel))
        bpy.ops.ed.undo()
        panel = bpy.context.view_layer.objects.active
    assert np.abs(results[0] - results[1]).max() < 1e-7


@pytest.mark.parametrize(("border", "name"), [('clamped', "Tangent (G1)"), ('fixed', "Position (G0)")])
def test_a_border_in_the_way_is_named_and_the_remedy_does_it(panel, border, name) -> None:
    settings = {"angle": 0.1, "centre": 'EVERYWHERE'}
    bpy.ops.reflines.direction('EXEC_DEFAULT', True, border=border, **settings)
    report = panel.reflection_lines.report
    assert reached(panel) < 0.2 and report.remedy == "free"
    first = report.notes.splitlines()[0]
    assert first.startswith("Only ") and f"the border {name} keeps the lines' mean" in first
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, border=report.remedy) == {'FINISHED'}
    assert reached(panel) > 0.8 and report.remedy == "clamped" and "of the target" not in report.notes
    remedied = scenes.positions(panel)
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    panel = bpy.context.view_layer.objects.active
    bpy.ops.reflines.direction('EXEC_DEFAULT', True, border='free', **settings)
    assert np.array_equal(scenes.positions(panel), remedied)


def test_what_is_as_wanted_already_is_no_failure() -> None:
    panel = scenes.edited_panel(cells=CELLS)
    for _ in range(3):
        scenes.smooth()
        assert "of the target" not in panel.reflection_lines.report.notes
