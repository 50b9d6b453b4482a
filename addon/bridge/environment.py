"""An environment image as the array that the stripes look it up in."""
import bpy
import numpy as np

LARGEST = 2048  # columns; finer images are averaged down


def key(image: bpy.types.Image) -> tuple:
    """Changes where another image, size or reading of the values is chosen."""
    return image.name, tuple(image.size), image.colorspace_settings.name, image.filepath


def read(image: bpy.types.Image) -> np.ndarray | None:
    """height x width x 4, linear, bottom row first; None for an image that cannot be had."""
    width, height = image.size
    if not width or not height:
        return None
    pixels = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    step = -(-width // LARGEST)
    pixels = pixels.reshape(height, width, 4)[:height // step * step, :width // step * step]
    if not image.is_float and image.colorspace_settings.name == 'sRGB':
        pixels = linear(pixels)
    if step > 1:
        pixels = pixels.reshape(height // step, step, width // step, step, 4).mean(axis=(1, 3))
    return np.ascontiguousarray(pixels, dtype=np.float32)


def linear(encoded: np.ndarray) -> np.ndarray:
    """Blender gives the pixels of 8-bit images as they are stored."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((np.maximum(encoded, 0.0) + 0.055) / 1.055) ** 2.4)
