"""A MatCap with the stripes of the reflection function, for Blender's solid shading."""
import tempfile
from pathlib import Path

import bpy
import numpy as np

from .refusal import Refusal
from .view import View

NAME = "reflection_lines.png"
SIZE, FINER = 512, 4  # pixels a side, and points a side of each


def ball(pixels: int) -> np.ndarray:
    """pixels x pixels x 3: normals of a ball seen along -z, bottom row first; those of its rim beyond it."""
    place = (2.0 * np.arange(pixels) + 1.0) / pixels - 1.0
    x, y = np.meshgrid(place, place)
    radius = np.maximum(np.hypot(x, y), 1e-9)
    inside = np.minimum(radius, 1.0)
    return np.stack([x / radius * inside, y / radius * inside, np.sqrt(1.0 - inside**2)], axis=2)


def theta(normals: np.ndarray, line: np.ndarray) -> np.ndarray:
    """The solver's, of normals (... x 3) in the camera's axes, where the view direction is +z."""
    v = np.array([0.0, 0.0, 1.0])
    v_a = v - line[2] * line
    v_a = v_a / np.linalg.norm(v_a)
    mirrored = 2.0 * normals[..., 2:] * normals - v
    return np.arctan2(mirrored @ np.cross(line, v_a), mirrored @ v_a)


def picture(view: View, up: np.ndarray, settings: bpy.types.PropertyGroup) -> np.ndarray:
    """SIZE x SIZE x 4, linear, of the ball as the view camera sees it; `up` is the camera's, a world direction."""
    right = np.cross(up, view.view_direction)
    line = np.array([view.line_direction @ axis for axis in (right, up, view.view_direction)])
    if np.hypot(*line[:2]) < 1e-6:
        raise Refusal("The light direction is parallel to the view: turn the light")
    period = theta(ball(SIZE * FINER), line) * settings.count / (2.0 * np.pi)
    lit = (np.abs(period - np.round(period)) <= 0.5 * settings.width).astype(np.float64)
    light = lit.reshape(SIZE, FINER, SIZE, FINER).mean(axis=(1, 3))[:, :, None]
    color = light * np.array(settings.color) + (1.0 - light) * np.array(settings.gap_color)
    color[:, :, 3] = 1.0
    return color


def encoded(linear: np.ndarray) -> np.ndarray:
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0) ** (1.0 / 2.4) - 0.055)


def install(color: np.ndarray) -> None:
    """Among the user's MatCaps, over an earlier one."""
    color = color.copy()
    color[:, :, :3] = encoded(color[:, :, :3])
    image = bpy.data.images.new(NAME, SIZE, SIZE)
    with tempfile.TemporaryDirectory() as folder:
        image.pixels.foreach_set(np.ascontiguousarray(color, np.float32).ravel())
        image.filepath_raw, image.file_format = str(Path(folder) / NAME), 'PNG'
        image.save()
        bpy.data.images.remove(image)
        for old in [light for light in bpy.context.preferences.studio_lights if light.name == NAME]:
            bpy.context.preferences.studio_lights.remove(old)
        bpy.ops.preferences.studiolight_install(files=[{"name": NAME}], directory=folder, type='MATCAP')
