"""Grey values of a Blender image, whatever its depth and wherever it comes from."""
import bpy
import numpy as np

from .refusal import Refusal

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709


def grey(image: bpy.types.Image) -> np.ndarray:
    """#rows x #columns, first row at the bottom: the numbers in the file, 0 black to 1 white."""
    columns, rows = image.size
    if columns == 0 or rows == 0:
        raise Refusal(f"The image {image.name} has no pixels: its file is missing or cannot be read")
    if not is_converted(image):
        return luminance(image)
    plain = image.copy()
    try:
        plain.colorspace_settings.name = 'Non-Color'
        return luminance(plain)
    finally:
        bpy.data.images.remove(plain)


def is_converted(image: bpy.types.Image) -> bool:
    """Whether Blender changed the numbers of the file as it read them, which it does for more than 8 bits."""
    return (image.is_float and image.source == 'FILE' and not image.is_dirty
            and image.colorspace_settings.name not in {'Non-Color', 'Raw'})


def luminance(image: bpy.types.Image) -> np.ndarray:
    columns, rows = image.size
    channels = image.channels
    values = np.empty(columns * rows * channels, dtype=np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(rows, columns, channels).astype(np.float64)
    return values[:, :, 0] if channels < 3 else values[:, :, :3] @ LUMINANCE
