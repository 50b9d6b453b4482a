"""What tools ask for is what their settings say: density along or across the lines, fall-offs, greys."""
import bpy
import numpy as np
import pytest
from reflection_lines import native_call
from reflection_lines.read import image_pixels
from reflection_lines.native import reflines
from reflection_lines.targets import direction, falloff


@pytest.fixture
def surface() -> "reflines.ShapeOptimizer":
    """A quarter of a bowl, whose lines run slanted."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(0.0, 1.0, 13), np.linspace(0.0, 1.0, 13)))
    first = (np.arange(12)[:, None] * 13 + np.arange(12)).ravel()
    F = np.concatenate([np.stack([first, first + 1, first + 14], 1), np.stack([first, first + 14, first + 13], 1)])
    V = np.stack([x, y, -0.2 * (x - 0.3 * y) ** 2 - 0.05 * y**2], 1)
    return reflines.ShapeOptimizer(V, F, view_direction=(0.0, 0.0, 1.0), line_direction=(0.2, 1.0, 0.1))


@pytest.mark.parametrize(("axis", "varies"), [('ALONG', (0.0, 1.0)), ('ACROSS', (1.0, 0.0))])
def test_the_density_varies_along_or_across_the_lines(surface, axis: str, varies: tuple[float, float]) -> None:
    """From 1 at the first triangle to 2 at the last, and not at all along the other direction. The lines run along y;
    in the picture that is (0, 1) up to the light's slant."""
    asked = direction.Direction(np.array([0.0, 1.0, 0.0]), density=1.0, density_end=2.0, axis=axis)
    wanted = native_call.run_now(direction.build_direction_target(surface, asked)).gradient
    density = np.linalg.norm(wanted, axis=1)
    density /= density.min()
    world = surface.centers @ surface.frame[:2, :2]
    share = world @ varies
    share = (share - share.min()) / np.ptp(share)
    rises = density[share.argmax()] > density[share.argmin()]
    assert np.abs(density - (1.0 + (share if rises else 1.0 - share))).max() < 1e-6
    if axis == 'ALONG':
        assert rises
    else:  # towards larger theta
        steepest = wanted.mean(axis=0) @ (surface.centers[density.argmax()] - surface.centers[density.argmin()])
        assert steepest > 0.0


SHAPES = {"SMOOTH": (1.0, 27 / 32, 1 / 2, 5 / 32, 0.0), "LINEAR": (1.0, 3 / 4, 1 / 2, 1 / 4, 0.0),
          "SPHERE": (1.0, np.sqrt(15) / 4, np.sqrt(3) / 2, np.sqrt(7) / 4, 0.0),
          "SHARP": (1.0, 9 / 16, 1 / 4, 1 / 16, 0.0)}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_fall_off_has_its_shape(shape: str) -> None:
    """At the centre, a quarter, half and three quarters of the radius, and at the radius."""
    curve = falloff.tabulate_preset(shape)
    assert curve[::len(curve) // 4] == pytest.approx(SHAPES[shape])


def test_the_influence_is_the_curves_at_the_distance_from_the_centre(surface) -> None:
    place = falloff.Falloff(np.array([0.5, 0.5, 9.0]), 0.4, falloff.tabulate_preset('SMOOTH'))
    influence = native_call.run_now(falloff.compute_influence(surface, place, 0.8))
    away = np.linalg.norm(surface.centers - surface.frame[:2] @ place.centre, axis=1) / place.radius
    t = np.clip(1.0 - away, 0.0, 1.0)
    assert np.abs(influence - 0.8 * t * t * (3.0 - 2.0 * t)).max() < 1e-4
    assert influence.max() > 0.7 and influence.min() == 0.0


def test_colours_are_weighed_as_the_eye_does() -> None:
    """Red, green and blue of ITU-R BT.709; white is 1."""
    image = bpy.data.images.new("Colours", 4, 1, float_buffer=True)
    image.pixels.foreach_set(np.array([1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1], np.float32))
    assert image_pixels.read_grey(image)[0] == pytest.approx([0.2126, 0.7152, 0.0722, 1.0])
