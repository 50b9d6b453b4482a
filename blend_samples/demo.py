"""Smooths the bonnet through the add-on's operator and shows it: `./run demo`, or

    blender -b blend_samples/hood.blend -P blend_samples/demo.py -- OUTPUT_FOLDER

Writes before.png, after.png and comparison.png (Cycles: the paint mirrors line lights) and the solved file.
"""
import pathlib
import sys

import bpy
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import checkout  # noqa: E402  (Blender puts no script's own folder on the path)

GUTTER = 16   # pixels between the two pictures


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


def side_by_side(left: pathlib.Path, right: pathlib.Path, path: pathlib.Path) -> None:
    first, second = pixels(left), pixels(right)
    joined = np.concatenate([first, np.ones((len(first), GUTTER, 4), np.float32), second], axis=1)
    image = bpy.data.images.new("comparison", joined.shape[1], joined.shape[0])
    image.pixels.foreach_set(joined.ravel())
    image.filepath_raw, image.file_format = str(path), 'PNG'
    image.save()


def smooth(panel: bpy.types.Object) -> None:
    """One press of the button; says what it did."""
    try:
        bpy.ops.reflines.smooth()
    except RuntimeError as refused:
        sys.exit(f"demo: {refused}")
    report = panel.reflection_lines.report
    print(f"demo: {report.termination}: {report.message}")
    print(f"demo: {report.unknowns} free vertices, {report.iterations} iterations, {report.seconds:.2f} s, "
          f"largest move {1000.0 * report.largest_move:.2f} mm")
    print(f"demo: wobble of the lines {report.score_before:.3f} degrees before, {report.score_after:.3f} after")


def main(folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    checkout.enable_add_on()
    panel = bpy.context.view_layer.objects.active
    before, after = folder / "before.png", folder / "after.png"
    picture(before, "before")
    smooth(panel)
    report = panel.reflection_lines.report
    change = f"wobble {report.score_before:.2f} to {report.score_after:.2f} degrees"
    picture(after, f"after: {change}, {report.seconds:.1f} s")
    side_by_side(before, after, folder / "comparison.png")
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "hood_smoothed.blend"), compress=True, copy=True)
    print(f"demo: look at {folder / 'comparison.png'}")


main(pathlib.Path(sys.argv[sys.argv.index("--") + 1]).resolve())
