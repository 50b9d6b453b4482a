"""Files whose stored texts, numbers and names somebody has changed: a sentence or nothing, no error, no crash."""
import base64
import io
import json
import sys
import time
import zipfile
from collections.abc import Callable

import bpy
import numpy as np
import pytest

import scenes

persistence = sys.modules["reflection_lines.state.persistence"]
solve_history = sys.modules["reflection_lines.state.solve_history"]
solve_record = sys.modules["reflection_lines.bridge.solve_record"]
Arrays = dict[str, np.ndarray]


@pytest.fixture
def solved() -> bpy.types.Object:
    """A smoothed panel with its record as a saved file has it."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    ob = scenes.panel()
    scenes.look_from_above()
    scenes.edit_inner(ob)
    assert scenes.smooth() == {'FINISHED'}
    scenes.object_mode()
    persistence.save_solves()
    assert ob.reflection_lines.last
    return ob


def arrays_of(text: str) -> Arrays:
    return dict(np.load(io.BytesIO(base64.b64decode(text))))


def text_of(arrays: Arrays) -> str:
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)
    return base64.b64encode(file.getvalue()).decode()


def with_value(name: str, value: float, place: int = 0) -> Callable[[Arrays], None]:
    def change(arrays: Arrays) -> None:
        arrays[name].flat[place] = value
    return change


def with_array(name: str, array: np.ndarray) -> Callable[[Arrays], None]:
    def change(arrays: Arrays) -> None:
        arrays[name] = array
    return change


CHANGES = {
    "a negative index": with_value("index", -1),
    "an index beyond the mesh": with_value("index", 10**6, -1),
    "indices out of order": with_value("index", 10**4, 3),
    "a negative corner": with_value("F", -1),
    "a corner beyond the region": with_value("F", 10**6),
    "no triangles": with_array("F", np.zeros((0, 3), np.int32)),
    "no vertices": with_array("index", np.zeros(0, np.int32)),
    "positions that are no numbers": with_value("local", np.nan),
    "a transform that is no number": with_value("matrix", np.nan),
    "an endless transform": with_value("matrix", np.inf),
    "a flat transform": with_array("matrix", np.diag([1.0, 1.0, 0.0, 1.0])),
    "a tiny transform": with_array("matrix", np.diag([1e-300, 1e-300, 1e-300, 1.0])),
    "a residual that is no number": with_value("residual", np.nan),
    "a residual of another size": with_array("residual", np.zeros(3, np.float32)),
    "positions in a plane": with_array("local", np.zeros((225, 2), np.float32)),
    "a matrix of three dimensions": with_array("matrix", np.zeros((2, 2, 4))),
    "faces of another mesh": with_array("faces", np.zeros(7, bool)),
    "indices as text": with_array("index", np.array(["1", "2"])),
    "a very long key": with_array("key", np.array("x" * 100000)),
    "Python objects": with_array("F", np.array([[{}, 1, 2]], dtype=object)),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_changed_record_is_none(solved, change) -> None:
    good = solved.reflection_lines.last
    assert solve_record.decode_solve(solved, good) is not None
    arrays = arrays_of(good)
    change(arrays)
    assert solve_record.decode_solve(solved, text_of(arrays)) is None


@pytest.mark.parametrize("text", ["x", "=" * 1000, "A" * 10**7, base64.b64encode(b"PK\x03\x04" * 50).decode(),
                                  "\u00e9"])
def test_other_text_is_no_record(solved, text) -> None:
    assert solve_record.decode_solve(solved, text) is None


def bomb(name: str, header: bytes, size: int) -> str:
    """A record with an array of zeros of so many bytes, which pack into a thousandth."""
    file = io.BytesIO()
    with (zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive,
          archive.open(name + ".npy", "w", force_zip64=True) as entry):
        entry.write(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header)
        for _ in range(size // 2**20):
            entry.write(bytes(2**20))
    return base64.b64encode(file.getvalue()).decode()


@pytest.mark.parametrize("shape", [b"(50000000,)", b"(1000000000000,)", b"(5, 10000000)"])
def test_nothing_large_is_unpacked(solved, shape) -> None:
    text = bomb("faces", b"{'descr': '|b1', 'fortran_order': False, 'shape': " + shape + b", }\n", 200 * 2**20)
    start = time.monotonic()
    assert solve_record.decode_solve(solved, text) is None
    assert time.monotonic() - start < 0.2  # unpacking takes 0.5 s and more


def test_one_bad_record_does_not_stop_the_others(solved) -> None:
    other = bpy.data.objects.new("A Panel", solved.data.copy())  # before the good one in the order of names
    bpy.context.collection.objects.link(other)
    arrays = arrays_of(solved.reflection_lines.last)
    arrays["F"].flat[0] = -5
    other.reflection_lines.last = text_of(arrays)
    solve_history.clear_history()
    persistence.load_solves()
    assert solve_history.find_last_solve(solved.name) is not None
    assert solve_history.find_last_solve(other.name) is None


RUNS = {
    "no tool": ("nonsense", "{}"),
    "another operator": ("REFLINES_OT_resolve", "{}"),
    "an operator of Blender": ("WM_OT_quit_blender", "{}"),
    "no identifier": ("REFLINES_OT_", "{}"),
    "settings that are no JSON": ("REFLINES_OT_smooth", "{"),
    "settings that are a list": ("REFLINES_OT_smooth", "[1, 2]"),
    "settings nested deeply": ("REFLINES_OT_smooth", "[" * 100000),
    "a setting that there is not": ("REFLINES_OT_smooth", json.dumps({"nonsense": 1})),
    "a setting of another type": ("REFLINES_OT_smooth", json.dumps({"border": 5})),
    "a choice that there is not": ("REFLINES_OT_smooth", json.dumps({"border": "nonsense"})),
}


@pytest.mark.parametrize("run", RUNS.values(), ids=RUNS)
def test_re_solve_says_what_cannot_be_used(solved, run, capfd) -> None:
    solved.reflection_lines.run.operator, solved.reflection_lines.run.settings = run
    before = scenes.fingerprint(solved)
    with pytest.raises(RuntimeError):
        bpy.ops.reflines.resolve()
    assert scenes.fingerprint(solved) == before
    assert "Traceback" not in capfd.readouterr().err


def test_a_live_start_whose_size_is_text(solved) -> None:
    live_start = sys.modules["reflection_lines.bridge.live_warp_start"]
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
    before = scenes.fingerprint(solved)
    with pytest.raises(RuntimeError, match="not finite numbers"):
        bpy.ops.reflines.warp()
    assert scenes.fingerprint(solved) == before


@pytest.mark.parametrize("size", [(65536, 16), (16, 65536), (4096, 2048), (1, 1)])
def test_environments_of_any_shape_have_pixels(size) -> None:
    image_pixels = sys.modules["reflection_lines.bridge.image_pixels"]
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
    before = scenes.fingerprint(solved)
    with pytest.raises(RuntimeError, match="so nothing was changed"):
        scenes.smooth(length=0.5)
    assert scenes.fingerprint(solved) == before
    scenes.object_mode()
