"""Cycles pictures of a sample, two or more of them side by side, and small copies."""
import pathlib

import bpy
import numpy as np

GUTTER = 16   # pixels between two pictures
QUALITY = 72  # of small copies, per cent: some 45 kB each


def picture(path: pathlib.Path, caption: str) -> None:
    """Renders what the scene's camera sees, with the caption below."""
    render = bpy.context.scene.render
    for name in dir(render):
        if name.startswith("use_stamp_"):
            setattr(render, name, name == "use_stamp_note")
    render.use_stamp, render.stamp_note_text, render.stamp_font_size = True, caption, 36
    render.stamp_background = (0.0, 0.0, 0.0, 0.0)
    render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def pixels(path: pathlib.Path) -> np.ndarray:
    """A picture as height x width x 4 floats, from the bottom up."""
    image = bpy.data.images.load(str(path))
    values = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


def side_by_side(pictures: list[pathlib.Path], path: pathlib.Path) -> None:
    """A PNG, or a JPEG where the name of `path` says so."""
    parts = [pixels(picture) for picture in pictures]
    gutter = np.ones((len(parts[0]), GUTTER, 4), np.float32)
    joined = np.concatenate([piece for part in parts for piece in (part, gutter)][:-1], axis=1)
    image = bpy.data.images.new("comparison", joined.shape[1], joined.shape[0])
    image.pixels.foreach_set(joined.ravel())
    image.filepath_raw, image.file_format = str(path), 'JPEG' if path.suffix == ".jpg" else 'PNG'
    image.save()


def shrink(path: pathlib.Path, small: pathlib.Path, width: int, quality: int = QUALITY) -> None:
    """Writes a JPEG, or a WebP where its name says so, `width` pixels wide. Changes the scene's output settings, so it
    comes after all rendering.
    """
    scene = bpy.context.scene
    scene.view_settings.view_transform = 'Standard'
    output = scene.render.image_settings
    output.file_format = 'WEBP' if small.suffix == ".webp" else 'JPEG'
    output.color_mode, output.quality = 'RGB', quality
    image = bpy.data.images.load(str(path))
    image.scale(width, round(image.size[1] * width / image.size[0]))
    image.save_render(str(small), scene=scene)
