"""Inspect in Blender: the spots, what a click on one does, the file, and what is refused."""
import csv
import time
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.interactive.inspection_job import InspectionJob
from reflection_lines.model.refusal import Refusal
from reflection_lines.operators.inspect_panel import REFLINES_OT_inspect

CELLS = 60
DENTS = {(0.4, 0.3): -0.002, (-0.5, -0.2): 0.0012}  # place, and height of a dent as wide as 0.12


def dented(x: float, y: float) -> float:
    return scenes.crown(x, y) + sum(height * float(np.exp(-((x - a)**2 + (y - b)**2) / 0.06**2))
                                    for (a, b), height in DENTS.items())


def make_panel(height: scenes.Height = dented) -> bpy.types.Object:
    ob = scenes.panel(height=height, cells=CELLS)
    scenes.look_from_above()
    return ob


def inspect(ob: bpy.types.Object, **settings: float) -> bpy.types.PropertyGroup:
    before = scenes.fingerprint(ob)
    assert bpy.ops.reflines.inspect('EXEC_DEFAULT', True, **settings) == {'FINISHED'}
    assert scenes.fingerprint(ob) == before
    return ob.reflection_lines.inspection


def test_dents_are_the_spots() -> None:
    found = inspect(make_panel())
    assert len(found.spots) == 2 and found.active == -1
    for spot, ((x, y), height) in zip(found.spots, DENTS.items(), strict=True):
        assert np.allclose(tuple(spot.find_place())[:2], (x, y), atol=0.1)
        assert spot.height == pytest.approx(height, rel=0.3)
    assert found.spots[0].describe().startswith("Dent") and found.spots[1].describe().startswith("Bump")
    assert found.summary.startswith("2 spots") and not found.unseen


def test_a_clean_panel_has_none() -> None:
    found = inspect(make_panel(scenes.crown))
    assert not len(found.spots) and found.summary.startswith("No place deviates by 0.1")


@pytest.mark.parametrize("mode", ['OBJECT', 'EDIT'])
def test_a_spot_is_shown(mode: str) -> None:
    """Its faces are selected, and the light turns to it; Next Spot goes on and round."""
    ob = make_panel()
    found = inspect(ob)
    if mode == 'EDIT':
        scenes.edit(ob)
    assert bpy.ops.reflines.show_spot('EXEC_DEFAULT', True, index=1) == {'FINISHED'}
    light = bpy.context.scene.reflection_lines.light
    bpy.context.view_layer.update()
    assert abs(np.array(light.matrix_world)[:3, 2] @ np.array(found.spots[1].line)) == pytest.approx(1.0, abs=1e-5)
    scenes.object_mode()
    chosen = [face for face in ob.data.polygons if face.select]
    near = [np.linalg.norm(np.array(face.center)[:2] - (-0.5, -0.2)) for face in chosen]
    assert chosen and max(near) < found.spots[1].size and min(near) < 0.1
    assert all(ob.data.vertices[v].select for face in chosen for v in face.vertices)
    assert bpy.ops.reflines.show_spot('EXEC_DEFAULT', True) == {'FINISHED'} and found.active == 0


def test_only_the_region_is_inspected() -> None:
    ob = make_panel()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face % CELLS >= CELLS // 2)  # x > 0
    found = inspect(ob)
    assert len(found.spots) == 1 and found.spots[0].height < 0.0


def test_places_follow_the_object() -> None:
    ob = make_panel()
    for matrix in scenes.TRANSFORMS.values():
        scenes.transformed(ob, matrix)
        place = np.array(ob.matrix_world @ ob.data.vertices[0].co)
        stored = ob.reflection_lines.inspection.spots.add()
        stored.place = ob.data.vertices[0].co
        assert np.allclose(stored.find_place(), place, atol=1e-5)


def test_the_set_is_inspected_in_its_own_lights() -> None:
    """The same dents, each with the light of the set that shows it best, from where it does."""
    ob = make_panel()
    with pytest.raises(RuntimeError, match="The set has no light that can be used"):
        bpy.ops.reflines.inspect('EXEC_DEFAULT', True, lights='SET')
    bpy.ops.reflines.light_set(action='WALK')
    entries = bpy.context.scene.reflection_lines.light_set.entries
    of_all = inspect(ob)
    degrees = of_all.spots[0].degrees
    for entry in entries:
        entry.muted = not entry.name.startswith("Above")
    found = inspect(ob, lights='SET')
    assert len(found.spots) == 2 and "most in Above, " in found.summary
    spot = found.spots[0]
    assert spot.view.startswith("Above") and spot.degrees < degrees and spot.height == pytest.approx(-0.002, rel=0.3)
    assert np.allclose(spot.eye, entries[spot.view].eye) and np.allclose(spot.line, entries[spot.view].line)
    assert bpy.ops.reflines.show_spot('EXEC_DEFAULT', True, index=0) == {'FINISHED'}
    entries[spot.view].eye = (0.0, 0.0, -1.0)
    assert f"Not seen from {spot.view}" in inspect(ob, lights='SET').unseen


def test_spots_are_written_to_a_table(tmp_path: Path) -> None:
    found = inspect(make_panel())
    file = tmp_path / "spots.csv"
    assert bpy.ops.reflines.export_table('EXEC_DEFAULT', table='SPOTS', filepath=str(file)) == {'FINISHED'}
    rows = list(csv.DictReader(file.open(encoding="utf-8")))
    assert [row["number"] for row in rows] == ["1", "2"]
    assert [float(row["height"]) for row in rows] == pytest.approx([spot.height for spot in found.spots])
    assert [float(row["x"]) for row in rows] == pytest.approx([spot.find_place()[0] for spot in found.spots])
    with pytest.raises(RuntimeError, match="csv"):
        bpy.ops.reflines.export_table('EXEC_DEFAULT', table='SPOTS', filepath=str(tmp_path / "spots.txt"))


def test_unusable_input_gets_one_sentence() -> None:
    ob = make_panel()
    inspect(ob)
    with pytest.raises(RuntimeError, match="there is no number 3"):
        bpy.ops.reflines.show_spot('EXEC_DEFAULT', True, index=2)
    scenes.edit(ob)
    scenes.select_faces(ob, lambda _: False)
    with pytest.raises(RuntimeError, match="select"):
        bpy.ops.reflines.inspect('EXEC_DEFAULT', True)


class Settings:
    """The settings of the operator, without Blender's."""
    lights = 'WALK'


def begin_job(ob: bpy.types.Object) -> InspectionJob:
    return InspectionJob(REFLINES_OT_inspect.read(Settings, bpy.context, ob))


def wait_for(job: InspectionJob) -> object:
    end = time.monotonic() + 60.0
    while (outcome := job.work.take()) is None:
        assert time.monotonic() < end
        time.sleep(0.01)
    return outcome


def test_it_runs_in_the_background_and_can_be_cancelled() -> None:
    ob = make_panel()
    job = begin_job(ob)
    outcome = wait_for(job)
    assert len(outcome.spots) == 2
    assert job.progress.fraction > 0.5 and job.describe().endswith("Esc: cancel")
    job.work.end()
    job = begin_job(ob)
    job.progress.cancel()
    assert isinstance(wait_for(job), Refusal)
    job.work.end()
