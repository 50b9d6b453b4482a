"""A MatCap with the stripes of the reflection function, for Blender's solid shading."""
import tempfile
from pathlib import Path

import bpy
import numpy as np

from .. import native
from ..model.refusal import Refusal
from ..model.view import View

NAME = "reflection_lines.png"
SIZE, FINER = 512, 4  # pixels a side of the picture, and samples a side of each pixel
TOWARDS_CAMERA = np.array([0.0, 0.0, 1.0])  # the view direction in the axes of the camera


def sample_ball_normals(pixels: int) -> np.ndarray:
    """Samples the unit normals of a ball seen along -z at the centres of a square picture's pixels.

    pixels^2 x 3, bottom row first; pixels outside the ball take the normal of the nearest point of its rim."""
    place = (2.0 * np.arange(pixels) + 1.0) / pixels - 1.0
    x, y = np.meshgrid(place, place)
    radius = np.maximum(np.hypot(x, y), 1e-9)
    inside = np.minimum(radius, 1.0)
    return np.stack([x / radius * inside, y / radius * inside, np.sqrt(1.0 - inside**2)], axis=2).reshape(-1, 3)


def render_matcap(view: View, up: np.ndarray, settings: bpy.types.PropertyGroup) -> np.ndarray:
    """Renders a ball with the stripes as the view camera sees it: SIZE x SIZE x 4, linear.

    `up` is the world direction of the camera's vertical."""
    right = np.cross(up, view.view_direction)
    line = np.array([view.line_direction @ axis for axis in (right, up, view.view_direction)])
    if np.hypot(*line[:2]) < 1e-6:
        raise Refusal("The light direction is parallel to the view: turn the light")
    theta = native.reflines.theta(sample_ball_normals(SIZE * FINER), TOWARDS_CAMERA, line)
    lit = compute_band(theta.reshape(SIZE * FINER, -1), settings.count, settings.width, settings.softness)
    light = lit.reshape(SIZE, FINER, SIZE, FINER).mean(axis=(1, 3))[:, :, None]
    color = light * np.array(settings.color) + (1.0 - light) * np.array(settings.gap_color)
    color[:, :, 3] = 1.0
    return color


def compute_band(theta: np.ndarray, count: int, width: float, softness: float) -> np.ndarray:
    """Computes the light of the stripes at every sample of a picture of theta, with edges at least a sample wide, and
    their mean where they are finer than samples: as the shader of the stripes does.
    """
    rate = count / (2.0 * np.pi)
    c, s = np.cos(theta), np.sin(theta)  # their derivatives have no branch cut
    pixel = rate * sum(np.abs(c * np.gradient(s, axis=axis) - s * np.gradient(c, axis=axis)) for axis in (0, 1))
    from_center = np.abs(theta * rate - np.round(theta * rate))
    edge = np.maximum(np.maximum(0.7 * pixel, 0.5 * softness * min(width, 1.0 - width)), 1e-5)
    light = 1.0 - smoothstep((from_center - 0.5 * width + edge) / (2.0 * edge))
    fine = smoothstep((pixel - 0.4) / 0.4)
    return (1.0 - fine) * light + fine * width


def smoothstep(x: np.ndarray) -> np.ndarray:
    t = np.clip(x, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def encode_srgb(linear: np.ndarray) -> np.ndarray:
    """Returns the sRGB values of linear ones (IEC 61966-2-1)."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0) ** (1.0 / 2.4) - 0.055)


def install_matcap(color: np.ndarray) -> None:
    """Adds the picture to the user's MatCaps, in place of an earlier one."""
    color = color.copy()
    color[:, :, :3] = encode_srgb(color[:, :, :3])
    image = bpy.data.images.new(NAME, SIZE, SIZE)
    with tempfile.TemporaryDirectory() as folder:
        image.pixels.foreach_set(np.ascontiguousarray(color, np.float32).ravel())
        image.filepath_raw, image.file_format = str(Path(folder) / NAME), 'PNG'
        image.save()
        bpy.data.images.remove(image)
        for old in [light for light in bpy.context.preferences.studio_lights if light.name == NAME]:
            bpy.context.preferences.studio_lights.remove(old)
        bpy.ops.preferences.studiolight_install(files=[{"name": NAME}], directory=folder, type='MATCAP')
