"""Files whose stored texts, numbers and names somebody has changed: a sentence or nothing, no error, no crash."""
import json
import sys
import time

import bpy
import numpy as np
import pytest

import hostile_files
import scenes

persistence = sys.modules["reflection_lines.state.persistence"]
solve_history = sys.modules["reflection_lines.state.solve_history"]
solve_record = sys.modules["reflection_lines.write.solve_record"]


@pytest.fixture
def solved() -> bpy.types.Object:
    """A smoothed panel with its record as a saved file has it."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    ob = scenes.edited_panel()
    assert scenes.smooth() == {'FINISHED'}
    scenes.object_mode()
    persistence.save_solves()
    assert ob.reflection_lines.last
    return ob


@pytest.mark.parametrize("change", hostile_files.RECORDS.values(), ids=hostile_files.RECORDS)
def test_a_changed_record_is_none(solved, change) -> None:
    good = solved.reflection_lines.last
    assert solve_record.decode_solve(solved, good) is not None
    arrays = hostile_files.arrays_of(good)
    change(arrays)
    assert solve_record.decode_solve(solved, hostile_files.text_of(arrays)) is None


@pytest.mark.parametrize("text", hostile_files.TEXTS, ids=range(len(hostile_files.TEXTS)))
def test_other_text_is_no_record(solved, text) -> None:
    assert solve_record.decode_solve(solved, text) is None


@pytest.mark.parametrize("name", ["faces", "local"])
def test_nothing_large_is_unpacked(name) -> None:
    """Also where the mesh has as many bytes as the packed text."""
    ob = scenes.panel(cells=100)
    empty = hostile_files.text_of({each: np.zeros(0, kind) for each, kind in hostile_files.KINDS.items()})
    stored = json.dumps(json.loads(empty) | json.loads(hostile_files.bomb(name, 200 * 2**20)))
    start = time.thread_time()  # which other work on the machine does not add to
    assert solve_record.decode_solve(ob, stored) is None
    assert time.thread_time() - start < 0.1  # unpacking takes 0.3 s and more


def test_one_bad_record_does_not_stop_the_others(solved) -> None:
    other = bpy.data.objects.new("A Panel", solved.data.copy())  # before the good one in the order of names
    bpy.context.collection.objects.link(other)
    arrays = hostile_files.arrays_of(solved.reflection_lines.last)
    arrays["F"].flat[0] = -5
    other.reflection_lines.last = hostile_files.text_of(arrays)
    solve_history._solves.clear()
    persistence.load_solves()
    assert solve_history.find_last_solve(solved.name) is not None
    assert solve_history.find_last_solve(other.name) is None


@pytest.mark.parametrize("run", hostile_files.RUNS.values(), ids=hostile_files.RUNS)
def test_re_solve_says_what_cannot_be_used(solved, run, capfd) -> None:
    solved.reflection_lines.run.operator, solved.reflection_lines.run.settings = run
    before = scenes.fingerprint(solved)
    with pytest.raises(RuntimeError):
        bpy.ops.reflines.resolve()
    assert scenes.fingerprint(solved) == before
    assert "Traceback" not in capfd.readouterr().err


def test_a_live_start_whose_size_is_text(solved) -> None:
    live_start = sys.modules["reflection_lines.write.live_warp_start"]
    for value in ("text", [1, 2, 3], 5, 1.5):
        solved.data[live_start.SIZE] = value
        assert live_start.count_growth(solved) == (17 * 17, 16 * 16)
    solved.data[live_start.KEY] = 5
    assert live_start.read_live_coordinates(solved).shape == (17 * 17, 3)


def test_a_lattice_whose_scale_is_no_number(solved) -> None:
    bpy.ops.reflines.add_warp_lattice()
    lattice = bpy.context.scene.reflection_lines.warp.lattice
    lattice.scale = (float("nan"), 1.0, 1.0)
    bpy.context.view_layer.update()
    scenes.activate(solved)
    with scenes.refused(solved, "not finite numbers"):
        bpy.ops.reflines.warp()


@pytest.mark.parametrize("size", [(65536, 16), (16, 65536), (4096, 2048), (1, 1)])
def test_environments_of_any_shape_have_pixels(size) -> None:
    image_pixels = sys.modules["reflection_lines.read.image_pixels"]
    image = bpy.data.images.new("Environment", *size)
    try:
        pixels = image_pixels.read_environment(image)
        assert min(pixels.shape[:2]) >= 1
        assert max(pixels.shape[:2]) <= image_pixels.MOST_COLUMNS
    finally:
        bpy.data.images.remove(image)


@pytest.mark.parametrize("factor", [1e6, float("inf"), float("nan")])
def test_a_runaway_result_is_not_written(solved, factor, monkeypatch) -> None:
    """Also where the solver does not notice."""
    module = sys.modules["reflection_lines.state.optimizer_cache"]
    solve = module.solve_with_cache

    def far(*arguments: object) -> object:
        solution = solve(*arguments)
        solution.positions[5] += factor * 1e34
        return solution

    monkeypatch.setattr(module, "solve_with_cache", far)
    scenes.edit_inner(solved)
    with scenes.refused(solved, "so nothing was changed"):
        scenes.smooth(length=0.5)
    scenes.object_mode()
