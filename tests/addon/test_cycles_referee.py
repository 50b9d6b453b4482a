"""An independent referee: a path tracer that knows nothing of the solver looks into a mirror and reports what it sees.

Cycles renders a perfect mirror of a known smooth surface under a world that shines (cos theta, sin theta), theta being
the angle of the looked-up direction about the line lights. What arrives in a pixel is compared with the solver's theta
of the analytic normal at the pixel's surface point, and with equation 1 of the paper in numpy. The samples are lit by
the same nodes.
"""
import pathlib

import bpy
import numpy as np
import pytest
from reflection_lines import native

import studio

PIXELS = 160
CELLS = 320          # cells a side of the mesh over [-1, 1]^2
PICTURE_WIDTH = 1.1  # scene units across the picture; all rays meet the surface inside the mesh

# View direction, line direction: none along an axis of the grid; alpha is negative, about zero and positive.
SITUATIONS = [
    ((0.10, -0.70, 1.00), (0.00, 1.00, 0.12)),
    ((0.30, 0.20, 1.00), (1.00, -0.40, -0.20)),
    ((-0.45, 0.35, 1.00), (-0.30, 0.80, 0.60)),
]

# Three errors add up. (1) The mesh's vertex normals, averaged from faces, and their interpolation: of second order,
# h^2 |D^3 f| / 8 = 6.3e-3^2 * 0.9 / 8 = 4e-6, doubled by the reflection. (2) The sample lies up to half the smallest
# filter width (0.005 pixel = 3.5e-5 units) beside the pixel's centre, times |grad theta| < 2 / unit. (3) Single
# precision: some 1e-6. Together below 1e-4 rad (measured: 2.8e-5); a wrong sign, axis or factor is off by > 1e-2.
TOLERANCE = 1e-4


# theta, normals, v, a, and the camera's axes and place
Seen = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return 0.22 * np.cos(1.3 * x + 0.4) + 0.10 * np.sin(1.7 * y + 0.8 * x)


def slopes(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    wave = 0.10 * np.cos(1.7 * y + 0.8 * x)
    return -0.286 * np.sin(1.3 * x + 0.4) + 0.8 * wave, 1.7 * wave


def normals(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    f_x, f_y = slopes(x, y)
    n = np.stack([-f_x, -f_y, np.ones_like(x)], axis=-1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True)


def unit(direction: tuple[float, float, float]) -> np.ndarray:
    return np.array(direction) / np.linalg.norm(direction)


def add_mirror() -> bpy.types.Object:
    x, y = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-1.0, 1.0, CELLS + 1)] * 2))
    corner = (np.arange(CELLS)[:, None] * (CELLS + 1) + np.arange(CELLS)).ravel()
    quads = np.stack([corner, corner + 1, corner + CELLS + 2, corner + CELLS + 1], axis=1)
    panel = studio.add_panel("Mirror", np.stack([x, y, height(x, y)], axis=1), quads)
    material = bpy.data.materials.new("Mirror")
    material.use_nodes = True
    nodes = studio.NodeChain(material.node_tree)
    mirror = nodes.add('ShaderNodeBsdfGlossy', (1.0, 1.0, 1.0, 1.0), 0.0, distribution='GGX')  # roughness 0: a mirror
    nodes.add('ShaderNodeOutputMaterial', mirror.outputs[0])
    panel.data.materials.append(material)
    return panel


def light_by_angle(view: np.ndarray, line: np.ndarray) -> None:
    """A world that shines 0.5 + 0.5 (cos theta, sin theta, 0) from every direction."""
    world = bpy.data.worlds.new("Angle")
    world.use_nodes = True
    bpy.context.scene.world = world
    nodes = studio.NodeChain(world.node_tree)
    theta = studio.theta_of_direction(nodes, studio.Vector(view), studio.Vector(line))
    channels = [nodes.math('MULTIPLY_ADD', nodes.math(wave, theta), 0.5, 0.5) for wave in ('COSINE', 'SINE')]
    colour = nodes.add('ShaderNodeCombineColor', *channels, 0.5)
    background = nodes.add('ShaderNodeBackground', colour.outputs[0], 1.0)
    nodes.add('ShaderNodeOutputWorld', background.outputs[0])


def render(path: pathlib.Path) -> np.ndarray:
    """The picture, PIXELS x PIXELS x 4, as the floats that Cycles computed; rows from the bottom up."""
    studio.set_up_render(PIXELS, PIXELS, samples=1)
    scene = bpy.context.scene
    scene.render.film_transparent = True   # so that alpha tells where the mirror is
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = 'BLACKMAN_HARRIS', 0.01
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = 'OPEN_EXR', '32'
    scene.render.image_settings.color_mode = 'RGBA'
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(str(path))
    picture.colorspace_settings.name = 'Non-Color'
    values = np.empty(PIXELS * PIXELS * 4, np.float32)
    picture.pixels.foreach_get(values)
    return values.reshape(PIXELS, PIXELS, 4).astype(float)


def surface_points(camera: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """x, y where the ray through each pixel's centre meets the analytic surface: Newton's method along the ray."""
    frame = np.array(camera.matrix_world)
    offset = ((np.arange(PIXELS) + 0.5) / PIXELS - 0.5) * PICTURE_WIDTH
    right, up = np.meshgrid(offset, offset)
    start = frame[:3, 3] + right[..., None] * frame[:3, 0] + up[..., None] * frame[:3, 1]
    back = frame[:3, 2]
    depth = start[..., 2] / back[2]
    for _ in range(12):
        point = start - depth[..., None] * back
        f_x, f_y = slopes(point[..., 0], point[..., 1])
        miss = point[..., 2] - height(point[..., 0], point[..., 1])
        depth += miss / (back[2] - f_x * back[0] - f_y * back[1])
    return point[..., 0], point[..., 1]


def equation_1(n: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """The paper's definition: reflect the view in the normal, drop the part along the lights, measure from v_a."""
    reflected = 2.0 * (n @ v)[..., None] * n - v
    flat = reflected - (reflected @ a)[..., None] * a
    flat /= np.linalg.norm(flat, axis=-1, keepdims=True)
    v_a = v - (v @ a) * a
    v_a /= np.linalg.norm(v_a)
    return np.arctan2(flat @ np.cross(a, v_a), flat @ v_a)


def difference(theta: np.ndarray, other: np.ndarray) -> np.ndarray:
    """|theta - other| on the circle."""
    return np.abs(np.angle(np.exp(1j * (theta - other))))


def set_the_scene(v: np.ndarray) -> bpy.types.Object:
    """The mirror before its camera."""
    studio.empty_scene()
    add_mirror()
    camera = studio.add_view_camera(v, centre=(0.0, 0.0, 0.2), width=PICTURE_WIDTH)
    bpy.context.view_layer.update()
    return camera


@pytest.fixture(scope="module", params=SITUATIONS, ids=["lamps along y", "lamps along x", "lamps aslant"])
def seen(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Seen:
    """theta as Cycles sees it, the analytic normals at the same points, v, a and the camera's matrix."""
    v, a = map(unit, request.param)
    camera = set_the_scene(v)
    light_by_angle(v, a)
    picture = render(tmp_path_factory.mktemp("referee") / "angle.exr")
    assert picture[..., 3].min() > 0.999, "the camera must see the mirror in every pixel"
    cosine, sine = 2.0 * picture[..., 0] - 1.0, 2.0 * picture[..., 1] - 1.0
    assert np.abs(np.hypot(cosine, sine) - 1.0).max() < 1e-5, "the mirror must show the lights and nothing else"
    return np.arctan2(sine, cosine), normals(*surface_points(camera)), v, a, np.array(camera.matrix_world)


def test_mirror_shows_equation_1(seen: Seen) -> None:
    theta, n, v, a, _ = seen
    assert difference(theta, equation_1(n, v, a)).max() < TOLERANCE
    assert np.ptp(theta) > 0.5, "the surface must turn the lines enough for the comparison to mean something"


def test_mirror_shows_the_solvers_theta(seen: Seen) -> None:
    theta, n, v, a, _ = seen
    solver = native.reflines.theta(n.reshape(-1, 3), v, a).reshape(theta.shape)
    assert difference(theta, solver).max() < TOLERANCE


def sample(picture: np.ndarray, frame: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """theta of a picture at points (#P x 3), between its pixels' centres, and which of them it shows."""
    place = ((points - frame[:3, 3]) @ frame[:3, :2] / PICTURE_WIDTH + 0.5) * PIXELS - 0.5
    shown = ((place > 0.0) & (place < PIXELS - 1.0)).all(axis=1)
    low = np.clip(place.astype(int), 0, PIXELS - 2)
    right, up = (place - low).T
    wave = sum(np.exp(1j * picture[low[:, 1] + j, low[:, 0] + i]) * abs(1 - i - right) * abs(1 - j - up)
               for i in (0, 1) for j in (0, 1))
    return np.angle(wave), shown


def find_theta(V: np.ndarray, F: np.ndarray, **light: object) -> np.ndarray:
    """The solver's theta of each quad that two triangles make, from above: the mean, whose error is of second order."""
    theta = native.reflines.ShapeOptimizer(V, F, view_direction=(0.0, 0.0, 1.0), **light).theta()
    return np.angle(np.exp(1j * theta).reshape(2, -1).sum(axis=0))


def test_a_camera_sees_the_theta_of_a_family_with_its_eye(seen: Seen) -> None:
    """The solve's view is another: it looks from above. Between pixels theta is off by the square of its change from
    one to the next, and a facet's by the square of its size."""
    theta, _, v, a, frame = seen
    cells = CELLS // 2
    x, y = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-1.0, 1.0, cells + 1)] * 2))
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    halves = [np.stack([corner, corner + one, corner + other], axis=1)
              for one, other in ((1, cells + 2), (cells + 2, cells + 1))]
    V, F = np.stack([x, y, height(x, y)], axis=1), np.concatenate(halves)
    middle = 0.5 * (V[corner] + V[corner + cells + 2])
    told, shown = sample(theta, frame, middle)
    assert shown.sum() > 5000
    own = find_theta(V, F, line_direction=a, eye_directions=v)
    assert difference(own, told)[shown].max() < 5e-4
    assert np.median(difference(find_theta(V, F, line_direction=a), told)[shown]) > 0.01


def test_the_mirror_tells_wrong_definitions_apart(seen: Seen) -> None:
    theta, n, v, a, _ = seen
    mirrored = n * (-1.0, -1.0, 1.0)   # the normal of -f, as the paper prints it
    wrong = [-equation_1(n, v, a), 0.5 * equation_1(n, v, a), equation_1(mirrored, v, a),
             equation_1(n, v, unit(tuple(np.cross(v, a))))]
    for other in wrong:
        assert np.median(difference(theta, other)) > 100.0 * TOLERANCE


def test_line_lights_of_the_samples_stand_at_whole_turns_over_count(tmp_path: pathlib.Path) -> None:
    v, a = map(unit, SITUATIONS[0])
    camera = set_the_scene(v)
    light = studio.add_light_direction(a, location=(0.0, 0.0, 1.0))
    bpy.context.view_layer.update()
    stripes = studio.Stripes(count=40, width=0.3, softness=0.5)
    studio.light_the_room(camera, light, stripes)
    brightness = render(tmp_path / "stripes.exr")[..., 0]
    turn = equation_1(normals(*surface_points(camera)), v, a) * stripes.count / (2.0 * np.pi)
    from_lamp = np.abs(turn - np.round(turn))
    expected = np.clip((0.15 - from_lamp) / 0.15 + 0.5, studio.GAP, 1.0)
    # The blurred edge multiplies the error of theta by 40 / (2 pi) / 0.15.
    assert np.abs(brightness - expected).max() < 43.0 * TOLERANCE
    assert np.ptp(turn) > 3.0
