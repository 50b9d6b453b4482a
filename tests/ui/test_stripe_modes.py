"""Every mode, eye and scope of the stripes in a real window: pixels against theta or the formula of the mode."""
import sys
from collections.abc import Callable, Generator
from math import exp, pi, tanh

import bpy
import numpy as np
from mathutils import Euler

import scenes
import window
from picture import CELLS, Steps, captured, expected_light, fresh_panel, prepare, samples, striped_panel, triangles


class Sample:
    """Pixels of the panel: what they show, and the surface behind them in world space."""

    def __init__(self, shown: np.ndarray, normals: np.ndarray, points: np.ndarray) -> None:
        settings = bpy.context.scene.reflection_lines
        self.shown, self.points = shown, points
        self.normals = normals / np.linalg.norm(normals, axis=1)[:, None]
        self.v, self.a = (np.array(ob.matrix_world)[:3, 2] for ob in (settings.camera, settings.light))
        across = self.v - self.v @ self.a * self.a
        self.v_a = across / np.linalg.norm(across)
        self.a_perp = np.cross(self.a, self.v_a)

    def views(self, eye: np.ndarray) -> np.ndarray:
        return (eye - self.points) / np.linalg.norm(eye - self.points, axis=1)[:, None]

    def theta(self, views: np.ndarray) -> np.ndarray:
        """The solver's theta in these views, of lights that stand where the view camera has them."""
        reflines = sys.modules["reflection_lines"].native.reflines
        return reflines.theta(self.normals, views, self.a) + np.arctan2(views @ self.a_perp, views @ self.v_a)

    def mirrored(self) -> np.ndarray:
        return 2.0 * (self.normals @ self.v)[:, None] * self.normals - self.v

    def agree(self, light: np.ndarray, tolerance: float = 4.0 / 255.0, share: float = 0.999,
              spread: float = 0.5) -> None:
        difference = np.abs(self.shown - light)
        good = (difference < tolerance).mean()
        print(f"{len(light)} pixels, {good:.4%} agree, largest difference {difference.max():.4f}")
        assert len(light) > 1000
        assert np.ptp(light) > spread
        assert good >= share


def sampled(driver: window.Window, ob: bpy.types.Object) -> Generator[float, None, Sample]:
    picture = yield from captured(driver)
    reflines = sys.modules["reflection_lines"].native.reflines
    F, V = triangles(ob), scenes.world(ob)
    pixel, triangle, barycentric = samples(driver, V, F)
    normals, points = ((array[F[triangle]] * barycentric[:, :, None]).sum(axis=1)
                       for array in (reflines.NormalFit(V, F).normals(V), V))
    return Sample(picture[pixel[:, 1], pixel[:, 0]], normals, points)


def stripes() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines.stripes


def mode_agrees(driver: window.Window, mode: str, angle: Callable[[Sample], np.ndarray]) -> Steps:
    ob = striped_panel(driver, mode)
    stripes().mode, stripes().count = mode, 60
    sample = yield from sampled(driver, ob)
    sample.agree(expected_light(angle(sample), 60))


def test_highlight_lines(driver: window.Window) -> Steps:
    yield from mode_agrees(driver, 'HIGHLIGHT',
                           lambda at: 2.0 * np.arctan2(at.normals @ at.a_perp, at.normals @ at.v_a))


def test_isophotes(driver: window.Window) -> Steps:
    yield from mode_agrees(driver, 'ISOPHOTE', lambda at: 2.0 * np.arccos(at.normals @ at.a))


def equirectangular(width: int = 256, height: int = 128) -> np.ndarray:
    """height x width, smooth, and with a seam that only wrapping hides."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    return 0.5 + 0.45 * np.cos(2.0 * pi * (3.0 * u + 0.2)) * np.cos(pi * (4.0 * v - 0.3))


def looked_up(values: np.ndarray, directions: np.ndarray, rotation: float) -> np.ndarray:
    height, width = values.shape
    x, y, z = directions.T
    column = ((0.5 - np.arctan2(y, x) / (2.0 * pi) + rotation / (2.0 * pi)) % 1.0) * width - 0.5
    row = np.clip((np.arctan2(z, np.hypot(x, y)) / pi + 0.5) * height - 0.5, 0.0, height - 1.0)
    low, left = np.floor(row).astype(int), np.floor(column).astype(int)
    up, right = row - low, column - left
    high = np.minimum(low + 1, height - 1)
    return ((1.0 - up) * ((1.0 - right) * values[low, left % width] + right * values[low, (left + 1) % width])
            + up * ((1.0 - right) * values[high, left % width] + right * values[high, (left + 1) % width]))


def test_environment_image(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Image")
    values = equirectangular()
    image = bpy.data.images.new("Surroundings", values.shape[1], values.shape[0], float_buffer=True, is_data=True)
    image.pixels.foreach_set(np.repeat(values[:, :, None], 4, axis=2).astype(np.float32).ravel())
    ob.rotation_euler = (0.5, 0.3, 0.2)
    with driver.override():
        bpy.context.view_layer.update()
    for rotation in (0.0, pi):  # one of them looks across the seam
        stripes().mode, stripes().image, stripes().image_rotation = 'IMAGE', image, rotation
        sample = yield from sampled(driver, ob)
        sample.agree(looked_up(values, sample.mirrored(), rotation), tolerance=0.02)


def test_no_image_is_no_error(driver: window.Window) -> Steps:
    striped_panel(driver, "No Image")
    stripes().mode, stripes().image = 'IMAGE', None
    picture = yield from captured(driver)
    assert abs(np.median(picture) - 0.2) < 0.02


def perspective_view(driver: window.Window, ob: bpy.types.Object, tilt: float = 0.3) -> np.ndarray:
    """Looks at the object from near by; returns the eye."""
    region_3d = driver.region_3d()
    region_3d.view_perspective = 'PERSP'
    region_3d.view_rotation = Euler((tilt, 0.0, 0.4)).to_quaternion()
    region_3d.view_location, region_3d.view_distance = ob.matrix_world.translation, 3.0
    region_3d.update()
    return np.array(region_3d.view_matrix.inverted().translation)


def test_this_view_in_perspective(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Perspective")
    stripes().eye = 'VIEWPORT'
    eye = perspective_view(driver, ob)
    sample = yield from sampled(driver, ob)
    sample.agree(expected_light(sample.theta(sample.views(eye))))


def test_a_perspective_camera_is_one_direction(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Camera")
    camera = bpy.context.scene.reflection_lines.camera
    camera.data.type, camera.location = 'PERSP', (0.3, 0.2, 2.5)
    with driver.override():
        bpy.context.view_layer.update()
    sample = yield from sampled(driver, ob)
    place = np.array(camera.matrix_world.translation)
    center = 0.5 * (np.array(ob.bound_box).min(axis=0) + np.array(ob.bound_box).max(axis=0))
    seen = (place - center) / np.linalg.norm(place - center)
    sample.v_a = seen - seen @ sample.a * sample.a
    sample.v_a /= np.linalg.norm(sample.v_a)
    sample.a_perp = np.cross(sample.a, sample.v_a)
    sample.agree(expected_light(sample.theta(np.tile(seen, (len(sample.points), 1)))))


def test_a_frozen_eye_stays_while_the_view_turns(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Frozen")
    eye = perspective_view(driver, ob)
    with driver.override():
        bpy.context.scene.reflection_lines.stripes.eye = 'FROZEN'
    perspective_view(driver, ob, tilt=-0.4)
    sample = yield from sampled(driver, ob)
    sample.agree(expected_light(sample.theta(sample.views(eye))))


def test_edges_are_soft_at_any_zoom(driver: window.Window) -> Steps:
    """Far away, where many lines share a pixel, the picture is their mean; near by, an edge is about a pixel wide."""
    striped_panel(driver, "Zoom")
    stripes().softness, stripes().count, stripes().width = 0.0, 2000, 0.3
    driver.region_3d().view_distance = 30.0
    far = yield from captured(driver)
    height, width = far.shape
    middle = far[height // 2 - 8:height // 2 + 8, width // 2 - 8:width // 2 + 8]
    print(f"far: {middle.mean():.3f} +- {middle.std():.3f}")
    assert abs(middle.mean() - 0.3) < 0.02
    assert middle.std() < 0.05
    stripes().count = 200
    driver.region_3d().view_distance = 1.0
    near = yield from captured(driver)
    column = near[:, width // 2]
    between = ((column > 0.03) & (column < 0.97)).sum()
    edges = (np.diff((column > 0.5).astype(int)) != 0).sum()
    print(f"near: {between} pixels between light and dark at {edges} edges")
    assert edges >= 2
    assert edges <= between <= 4 * edges


def test_only_the_selected_faces(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Part")
    stripes().mode, stripes().scope = 'IMAGE', 'SELECTION'
    stripes().image = None
    with driver.override():
        scenes.edit(ob)
        scenes.select_faces(ob, lambda face: face % CELLS < CELLS // 2)
    yield 0.3
    half = yield from captured(driver)
    height, width = half.shape
    middle = half[height // 2 - 20:height // 2 + 20]
    assert np.abs(middle[:, width // 2 - 60:width // 2 - 10] - 0.2).max() < 0.02
    assert np.abs(middle[:, width // 2 + 10:width // 2 + 60] - 0.2).min() > 0.02
    with driver.override():
        scenes.select_faces(ob, lambda face: face % CELLS >= CELLS // 2)
    yield 0.3
    other = yield from captured(driver)
    assert np.abs(other[height // 2 - 20:height // 2 + 20, width // 2 + 10:width // 2 + 60] - 0.2).max() < 0.02


def test_a_part_has_the_normals_of_the_whole(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Part of the Whole")
    with driver.override():
        scenes.edit(ob)
        scenes.select_faces(ob, lambda face: (face // CELLS) % 2 == 0)
    whole = yield from captured(driver)
    stripes().scope = 'SELECTION'
    part = yield from captured(driver)
    F, V = triangles(ob), scenes.world(ob)
    pixel, triangle, _ = samples(driver, V, F)
    chosen = (triangle // 2 // CELLS) % 2 == 0
    rows, columns = pixel[chosen, 1], pixel[chosen, 0]
    assert np.abs(whole[rows, columns] - part[rows, columns]).max() < 2.0 / 255.0


def test_a_collection(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "One")
    with driver.override():
        other = scenes.panel("Other", cells=8)
        other.location.x = 2.5
        both = bpy.data.collections.new("Both")
        both.objects.link(ob)
        both.objects.link(other)
        bpy.context.scene.collection.children.link(both)
    stripes().mode, stripes().image = 'IMAGE', None
    driver.region_3d().view_distance = 5.0
    yield from captured(driver)
    active = yield from captured(driver)
    stripes().scope, stripes().collection = 'COLLECTION', both
    picture = yield from captured(driver)
    one, two = ((np.abs(shot - 0.2) < 0.01).sum() for shot in (active, picture))
    print(f"{one} pixels of the active object, {two} of the collection")
    assert 1.8 * one < two < 2.2 * one


def solved_panel(driver: window.Window, name: str) -> Generator[float, None, tuple]:
    """A panel after a solve: (object, where its vertices were, the session's solution)."""
    ob = striped_panel(driver, name)
    with driver.override():
        scenes.edit_inner(ob, CELLS)
        before = scenes.world(ob)
        scenes.smooth(length=1.0)
        scenes.object_mode()
    yield 0.2
    return ob, before, sys.modules["reflection_lines"].state.solve_history.find_last_solve(name)


def test_deviation_map(driver: window.Window) -> Steps:
    ob, before, _ = yield from solved_panel(driver, "Deviation")
    moved = (scenes.world(ob) - before)[:, 2]  # along the view from above, where the normals point
    stripe_arrays = sys.modules["reflection_lines"].overlay.stripes
    stripes().mode = 'DEVIATION'
    picture = yield from captured(driver)
    pixel, triangle, barycentric = samples(driver, before, triangles(ob))
    share = (moved[triangles(ob)[triangle]] * barycentric).sum(axis=1) / np.abs(moved).max()
    inner = scenes.inner(CELLS)
    chosen = np.array([inner(face) for face in triangle // 2])
    Sample(picture[pixel[:, 1], pixel[:, 0]][chosen], np.ones((chosen.sum(), 3)), before).agree(
        stripe_arrays.compute_ramp(0.5 + 0.5 * share[chosen], stripe_arrays.SIGNED_RAMP)[:, 1], spread=0.1)


def test_residual_map(driver: window.Window) -> Steps:
    ob, before, solution = yield from solved_panel(driver, "Residual")
    stripes().mode = 'RESIDUAL'
    picture = yield from captured(driver)
    patch = solution.patch
    pixel, triangle, _ = samples(driver, scenes.world(ob)[patch.index], patch.F)
    share = solution.residual[triangle] / solution.residual.max()
    light = sys.modules["reflection_lines"].overlay.stripes.compute_ramp(share)[:, 1]
    Sample(picture[pixel[:, 1], pixel[:, 0]], np.ones((len(share), 3)), before).agree(light, share=0.99, spread=0.1)


def dented_beside_a_line(x: float, y: float) -> float:
    """A crowned panel with a dent on its left half and a character line on its right one."""
    return (-0.15 * x * x - 0.1 * y * y - 0.003 * exp(-((x + 0.4)**2 + y * y) / 0.008)
            + 0.02 * tanh((x - 0.5) / 0.05))


def test_verdict_map(driver: window.Window) -> Steps:
    """The dent is drawn as healed and the line as kept; after another tool nothing is drawn, and it is said why."""
    cells, shown_objects = 64, sys.modules["reflection_lines"].overlay.shown_objects
    fresh_panel(driver, "Before").hide_set(True)
    with driver.override():
        ob = scenes.panel("Verdict", height=dented_beside_a_line, cells=cells)
    prepare(driver, ob)
    with driver.override():
        scenes.edit_inner(ob, cells)
        scenes.smooth()
        scenes.object_mode()
    stripes().mode = 'VERDICT'
    picture = yield from captured(driver)
    yield from window.take_picture(driver, "verdict")
    patch, verdict = (lambda last: (last.patch, last.verdict))(
        sys.modules["reflection_lines"].state.solve_history.find_last_solve("Verdict"))
    pixel, triangle, _ = samples(driver, scenes.world(ob)[patch.index], patch.F)
    stripe_arrays = sys.modules["reflection_lines"].overlay.stripes
    light = stripe_arrays.compute_ramp(0.5 + 0.5 * verdict[triangle], stripe_arrays.VERDICT_RAMP)[:, 1]
    Sample(picture[pixel[:, 1], pixel[:, 0]], np.ones((len(triangle), 3)), scenes.world(ob)).agree(
        light, share=0.98, spread=0.1)
    x, y = patch.V[patch.F].mean(axis=1)[:, :2].T
    assert verdict[np.hypot(x + 0.4, y) < 0.05].min() > 0.9 and verdict[abs(x - 0.5) < 0.03].max() < -0.9
    with driver.override():
        scenes.edit_inner(ob, cells)
        scenes.smooth(length=1.0)
        scenes.object_mode()
    yield from captured(driver)
    with driver.override():
        assert "press Smooth Lines" in shown_objects.explain_solve(stripes(), [ob])


def test_a_map_of_a_changed_mesh_is_not_shown(driver: window.Window) -> Steps:
    ob, _, _ = yield from solved_panel(driver, "Changed")
    stripes().mode = 'DEVIATION'
    shown = yield from captured(driver)
    ob.data.vertices[CELLS * CELLS // 2].co.z += 0.1
    ob.data.update()
    yield 0.2
    gone = yield from captured(driver)
    assert (np.abs(shown - gone) > 0.05).sum() > 10000


def test_before_the_last_solve(driver: window.Window) -> Steps:
    ob, before, _ = yield from solved_panel(driver, "Before")
    stripes().before, stripes().side_by_side = True, False
    picture = yield from captured(driver)
    stripes().before = False
    reflines = sys.modules["reflection_lines"].native.reflines
    F = triangles(ob)
    pixel, triangle, barycentric = samples(driver, before, F)
    normals = (reflines.NormalFit(before, F).normals(before)[F[triangle]] * barycentric[:, :, None]).sum(axis=1)
    sample = Sample(picture[pixel[:, 1], pixel[:, 0]], normals, before)
    sample.agree(expected_light(reflines.theta(normals, sample.v, sample.a)))


def test_before_and_after_side_by_side(driver: window.Window) -> Steps:
    """Left of the middle it is the picture before the last solve, right of it the present one, to the pixel."""
    yield from solved_panel(driver, "Sides")
    after = yield from captured(driver)
    stripes().before, stripes().side_by_side = True, False
    before = yield from captured(driver)
    stripes().side_by_side = True
    both = yield from captured(driver)
    yield from window.take_picture(driver, "sides")
    middle = round(sys.modules["reflection_lines"].state.compared.find_divider(driver.region()))
    stripes().before = False
    assert np.array_equal(both[:, :middle - 1], before[:, :middle - 1])
    assert np.array_equal(both[:, middle + 1:], after[:, middle + 1:])
    for side in (slice(None, middle), slice(middle, None)):
        assert (before[:, side] != after[:, side]).mean() > 0.05


def test_the_legend_has_units_and_sign(driver: window.Window) -> Steps:
    ob, before, solution = yield from solved_panel(driver, "Legend")
    legend = sys.modules["reflection_lines"].overlay.legend
    moved = np.abs((scenes.world(ob) - before)[:, 2]).max()
    found = {}
    for mode in ('DEVIATION', 'RESIDUAL', 'REFLECTION'):
        stripes().mode = mode
        yield from captured(driver)
        with driver.override():
            found[mode] = legend.find_full_value(bpy.context, stripes())
    assert abs(found['DEVIATION'] - moved) < 1e-6 and found['REFLECTION'] is None
    assert abs(found['RESIDUAL'] - solution.residual.max()) < 1e-9
    units = bpy.context.scene.unit_settings
    units.system, units.scale_length = 'METRIC', 0.001
    assert legend.describe_ends(bpy.context.scene, 'DEVIATION', 1.7) == ("\u22121.7 mm", "0", "+1.7 mm")
    assert legend.describe_ends(bpy.context.scene, 'RESIDUAL', 0.2) == ("0", "100", "200 rad/m")
    units.scale_length = 1.0
    stripes().mode = 'DEVIATION'
    yield from window.take_picture(driver, "legend")


LARGE = 160  # cells a side of a panel that is fitted in a thread


def test_a_large_panel_is_drawn_at_once_and_then_better(driver: window.Window) -> Steps:
    with driver.override():
        scenes.remove_all()
        ob = scenes.panel("Large", cells=LARGE)
        scenes.look_from_above(light_degrees=60.0)
        bpy.context.view_layer.update()
    draw = sys.modules["reflection_lines"].overlay.draw
    prepare(driver, ob)
    yield from captured(driver)
    while draw.is_waiting():
        yield 0.1
    builds = draw._cache.builds
    sample = yield from sampled(driver, ob)
    sample.agree(expected_light(sample.theta(sample.v[None])), share=0.99)
    ob.data.vertices[LARGE * LARGE // 2].co.z += 0.01
    ob.data.update()
    yield from captured(driver)
    while draw.is_waiting():
        yield 0.1
    sample = yield from sampled(driver, ob)
    sample.agree(expected_light(sample.theta(sample.v[None])), share=0.99)
    assert draw._cache.builds == builds + 2  # at once with what normals there are, then with better ones
