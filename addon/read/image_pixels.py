"""Reads Blender images as arrays: environments for the stripes, grey values for the pattern tool."""
import bpy
import numpy as np

from ..model.refusal import Refusal

MOST_COLUMNS = 2048  # columns and rows; finer images are averaged down


def identify_image(image: bpy.types.Image) -> tuple:
    """Returns a key that changes where another image, size or colour space is chosen."""
    return image.name, tuple(image.size), image.colorspace_settings.name, image.filepath


def read_environment(image: bpy.types.Image) -> np.ndarray | None:
    """Reads an environment image: height x width x 4, linear, bottom row first; None where it has no pixels."""
    width, height = image.size
    if not width or not height:
        return None
    pixels = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    across = -(-width // MOST_COLUMNS)
    up = max(min(across, height), -(-height // MOST_COLUMNS))
    pixels = pixels.reshape(height, width, 4)[:height // up * up, :width // across * across]
    if not image.is_float and image.colorspace_settings.name == 'sRGB':
        pixels = decode_srgb(pixels)
    if across > 1 or up > 1:
        pixels = pixels.reshape(height // up, up, width // across, across, 4).mean(axis=(1, 3))
    return np.ascontiguousarray(pixels, dtype=np.float32)


def decode_srgb(encoded: np.ndarray) -> np.ndarray:
    """Returns linear values of sRGB ones (IEC 61966-2-1). Blender gives the pixels of 8-bit images as they are stored.
    """
    return np.where(encoded <= 0.04045, encoded / 12.92, ((np.maximum(encoded, 0.0) + 0.055) / 1.055) ** 2.4)


LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709


def read_grey(image: bpy.types.Image) -> np.ndarray:
    """Reads the grey values of an image as they stand in its file: #rows x #columns, bottom row first, 0 black to 1
    white.
    """
    columns, rows = image.size
    if columns == 0 or rows == 0:
        raise Refusal(f"The image {image.name} has no pixels: its file is missing or cannot be read")
    if not is_converted(image):
        return read_luminance(image)
    plain = image.copy()
    try:
        plain.colorspace_settings.name = 'Non-Color'
        return read_luminance(plain)
    finally:
        bpy.data.images.remove(plain)


def is_converted(image: bpy.types.Image) -> bool:
    """Returns whether Blender converted the numbers of the file to scene linear, as it does for more than 8 bits."""
    return (image.is_float and image.source == 'FILE' and not image.is_dirty
            and image.colorspace_settings.name not in {'Non-Color', 'Raw'})


def read_luminance(image: bpy.types.Image) -> np.ndarray:
    """Reads the luminance of every pixel: #rows x #columns."""
    columns, rows = image.size
    channels = image.channels
    values = np.empty(columns * rows * channels, dtype=np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(rows, columns, channels).astype(np.float64)
    return values[:, :, 0] if channels < 3 else values[:, :, :3] @ LUMINANCE
