"""Direction and density, directional smoothing and pattern, through the user's door."""
from collections.abc import Callable
from math import radians

import bpy
import numpy as np
import pytest
from reflection_lines.native import reflines

import scenes

CELLS = 16


def image(name: str, grey: np.ndarray, *, float_buffer: bool = True) -> bpy.types.Image:
    rows, columns = grey.shape
    made = bpy.data.images.new(name, columns, rows, float_buffer=float_buffer, is_data=True)
    made.pixels.foreach_set(np.dstack([grey, grey, grey, np.ones_like(grey)]).astype(np.float32).ravel())
    return made


def waves() -> bpy.types.Image:
    rows = (np.arange(64) + 0.5) / 64
    return image("Waves", np.tile(0.5 + 0.5 * np.sin(6.0 * np.pi * rows)[:, None], (1, 64)))


def lattice_at_rest() -> None:
    bpy.ops.reflines.add_warp_lattice(columns=4, rows=3)
    bpy.ops.reflines.warp('EXEC_DEFAULT', True)


def pattern(**settings: object) -> set[str]:
    return bpy.ops.reflines.pattern('EXEC_DEFAULT', True, image=waves().name, **settings)


IDENTITIES = {
    "smooth": lambda: scenes.smooth(strength=0.0, directional=True),
    "direction": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, density=3.0, strength=0.0),
    "direction as set": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True),
    "direction along lines": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, axis='ALONG'),
    "warp": lattice_at_rest,
    "pattern": lambda: pattern(strength=0.0),
    "pattern by value": lambda: pattern(strength=0.0, fit='VALUE'),
}
CLAMPED = {"border": 'clamped', "centre": 'EVERYWHERE'}
INSIDE = {"border": 'clamped', "centre": 'REGION'}
CURVE = {"centre": 'CURSOR', "shape": 'CURVE'}
CHANGES = {
    "smooth": lambda: scenes.smooth(directional=True),
    "angle": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, direction='ANGLE', angle=0.1, **CLAMPED),
    "density": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, density=1.1, axis='ACROSS', density_end=0.9,
                                                  **CLAMPED),
    "straight": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, direction='MEAN', density=1.1, axis='ALONG',
                                                   density_end=0.9, **CLAMPED),
    "density in the middle": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, density=1.2, **INSIDE),
    "curve": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, density=1.2, **(CLAMPED | CURVE)),
    "turn": lambda: bpy.ops.reflines.direction('EXEC_DEFAULT', True, angle=0.1, radius=0.7, **INSIDE),
    "pattern": pattern,
    "pattern by value": lambda: pattern(fit='VALUE'),
}


@pytest.mark.parametrize("change", IDENTITIES.values(), ids=IDENTITIES)
def test_identity_settings_move_nothing_bit_for_bit(panel, change: Callable[[], object]) -> None:
    before = scenes.positions(panel)
    change()
    assert np.array_equal(scenes.positions(panel), before)
    report = panel.reflection_lines.report
    assert (report.termination, report.largest_move, report.residual_after) == ("already_optimal", 0.0, 0.0)


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_every_tool_comes_nearer_to_what_it_was_asked_for_and_is_undone(panel, change) -> None:
    bpy.ops.ed.undo_push(message="start")
    before, start = scenes.positions(panel), scenes.fingerprint(panel)
    change()
    report = panel.reflection_lines.report
    assert report.termination == "converged"
    assert report.residual_after < report.residual_before
    moved = (scenes.positions(panel) != before).any(axis=1)
    inside = (np.abs(before[:, :2]) < 1.0 - 1.5 / CELLS * 2.0).all(axis=1)
    assert moved.any() and not moved[~inside].any()
    assert np.array_equal(scenes.positions(panel)[:, :2], before[:, :2])  # along the view only
    bpy.ops.ed.undo()
    assert scenes.fingerprint(bpy.context.view_layer.objects.active) == start


def lines_of(ob: bpy.types.Object) -> object:
    """An optimizer over the faces of the region as they are now, made without the add-on's code."""
    ob.update_from_editmode()
    ob.data.calc_loop_triangles()
    inside = scenes.inner(CELLS)
    corners = [list(t.vertices) for t in ob.data.loop_triangles if inside(t.polygon_index)]
    index, F = np.unique(np.array(corners), return_inverse=True)
    settings = bpy.context.scene.reflection_lines
    v, a = (np.array(axis.matrix_world)[:3, 2] for axis in (settings.camera, settings.light))
    return reflines.ShapeOptimizer(scenes.world(ob)[index], F.reshape(-1, 3), view_direction=v, line_direction=a)


def near(optimizer: object, radius: float) -> np.ndarray:
    return np.linalg.norm(optimizer.centers, axis=1) < radius


def test_the_angle_is_that_of_the_lines_in_the_picture(panel) -> None:
    """Seen from above with X to the right. A border that stayed would keep the lines from turning all the way."""
    bpy.ops.reflines.smooth(length=2.0)
    bpy.ops.reflines.direction(direction='ANGLE', angle=radians(8.0), border='free', centre='EVERYWHERE')
    optimizer = lines_of(panel)
    across = optimizer.field()[near(optimizer, 0.5)].mean(axis=0) @ optimizer.frame[:2]
    assert np.arctan2(across[0], -across[1]) == pytest.approx(radians(8.0), abs=radians(0.5))


def test_as_they_run_turns_the_middle_counter_clockwise(panel) -> None:
    before = lines_of(panel).field()
    bpy.ops.reflines.direction(angle=0.2, centre='REGION', radius=0.8, border='free')
    optimizer = lines_of(panel)
    inside = near(optimizer, 0.2)
    old, new = before[inside].mean(axis=0), optimizer.field()[inside].mean(axis=0)
    turn = np.arctan2(old[0] * new[1] - old[1] * new[0], old @ new)
    assert 0.05 < turn < 0.25


def test_the_cursor_is_the_centre(panel) -> None:
    bpy.context.scene.cursor.location = (0.5, 0.0, 0.0)
    before = scenes.positions(panel)
    bpy.ops.reflines.direction(angle=0.3, centre='CURSOR', radius=0.3, border='clamped')
    moved = np.abs(scenes.positions(panel) - before)[:, 2]
    assert (moved @ before[:, 0]) / moved.sum() > 0.2


def test_the_active_vertex_is_the_centre_and_missing_refused(panel) -> None:
    with pytest.raises(RuntimeError, match="no active vertex"):
        bpy.ops.reflines.direction(angle=0.3, centre='ACTIVE')


def test_settings_come_from_the_scene_unless_given(panel) -> None:
    bpy.context.scene.reflection_lines.direction.angle = 0.1
    bpy.ops.ed.undo_push(message="start")
    bpy.ops.reflines.direction('EXEC_DEFAULT', True)
    from_scene = scenes.positions(panel)
    bpy.ops.ed.undo()
    panel = bpy.context.view_layer.objects.active
    bpy.ops.reflines.direction(angle=0.1)
    assert np.array_equal(scenes.positions(panel), from_scene)


def test_the_curve_is_saved_with_the_file(panel, tmp_path) -> None:
    settings = bpy.context.scene.reflection_lines
    settings.direction.shape = 'CURVE'
    points = settings.curve.nodes[0].mapping.curves[0].points
    points[0].location = (0.0, 0.25)
    scenes.object_mode()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "curve.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "curve.blend"))
    points = bpy.context.scene.reflection_lines.curve.nodes[0].mapping.curves[0].points
    assert tuple(points[0].location) == (0.0, 0.25)


def test_a_missing_image_is_refused(panel) -> None:
    with pytest.raises(RuntimeError, match="There is no image"):
        bpy.ops.reflines.pattern()


@pytest.mark.parametrize(("depth", "kind"), [('8', 'PNG'), ('16', 'PNG'), ('32', 'OPEN_EXR')])
@pytest.mark.parametrize("packed", [False, True])
def test_an_image_means_the_same_in_any_depth(panel, tmp_path, depth, kind, packed) -> None:
    """Grey steps of 1/15 are exact in 8 and 16 bits, and within 1e-7 in 32; the result may differ by as little."""
    grey = np.tile(np.round(7.5 + 7.5 * np.sin(np.arange(30) / 3.0))[:, None] / 15.0, (1, 30))
    bpy.ops.ed.undo_push(message="start")
    bpy.ops.reflines.pattern('EXEC_DEFAULT', True, image=image("Exact", grey).name)
    expected = scenes.positions(panel)
    bpy.ops.ed.undo()
    panel = bpy.context.view_layer.objects.active
    loaded = written(grey, tmp_path / f"grey.{'png' if kind == 'PNG' else 'exr'}", depth, kind)
    if packed:
        loaded.pack()
    bpy.ops.reflines.pattern(image=loaded.name)
    assert np.abs(scenes.positions(panel) - expected).max() < 2e-7


def written(grey: np.ndarray, path: object, depth: str, kind: str) -> bpy.types.Image:
    """The image as a file of that depth, with the colour space that Blender gives it by itself."""
    scene = bpy.context.scene
    scene.render.image_settings.file_format, scene.render.image_settings.color_mode = kind, 'RGB'
    scene.render.image_settings.color_depth = depth
    scene.view_settings.view_transform = 'Raw'
    image("Source", grey).save_render(str(path))
    return bpy.data.images.load(str(path))


def test_far_moves_and_faces_turned_over_are_told_with_what_helps(panel: bpy.types.Object) -> None:
    bpy.ops.reflines.direction('EXEC_DEFAULT', True, density=20.0, border='free', limit=100.0)
    notes = panel.reflection_lines.report.notes
    assert "of the panel's size" in notes and "the border Tangent (G1), keeps it nearer" in notes
    assert "faces turn by more than 45 degrees" in notes


@pytest.mark.parametrize(("scale", "told"), [(1.0, "m"), (0.001, "mm")])
def test_lengths_are_told_in_the_scenes_unit(panel, capfd, scale, told) -> None:
    """As the sidebar's fields show them, where a Blender unit may be a millimetre."""
    bpy.context.scene.unit_settings.scale_length = scale
    scenes.smooth(length=2.0)
    report = panel.reflection_lines.report
    moved = bpy.utils.units.to_string('METRIC', 'LENGTH', report.largest_move * scale, precision=2)
    assert report.measured_length() == f"2 {told}"
    assert f"moved at most {moved} (Panel)\n" in capfd.readouterr().out


def test_lengths_without_a_unit(panel, capfd) -> None:
    bpy.context.scene.unit_settings.system = 'NONE'
    scenes.smooth(length=0.5)
    report = panel.reflection_lines.report
    assert report.measured_length() == "0.5"
    assert f"moved at most {report.largest_move:.2g} (Panel)\n" in capfd.readouterr().out
