"""Smooths the car's bonnet through the add-on's operator and shows it: `./run demo`, or

    blender -b blend_samples/car.blend -P tests/in_blender.py -- blend_samples/demo.py OUTPUT_FOLDER

Writes before.png, after.png and comparison.png (Cycles: the paint mirrors line lights) and the solved file.
"""
import pathlib
import sys

import bpy

import checkout
import pictures
import studio

COLOUR = (0.56, 0.66, 0.78)


def light_for_cycles() -> None:
    """Gives the render what the stripes show in a view: line lights all around, and paint that mirrors them."""
    settings = bpy.context.scene.reflection_lines
    shown = settings.stripes
    studio.light_the_room(settings.camera, settings.light, studio.Stripes(shown.count, shown.width, shown.softness))
    paint = studio.car_paint("Mirror", COLOUR)
    for ob in shown.collection.objects:
        ob.data.materials.clear()
        ob.data.materials.append(paint)


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
    print(f"demo: {report.headline()}")


def main(folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    checkout.enable_add_on()
    panel = bpy.context.view_layer.objects.active
    light_for_cycles()
    before, after = folder / "before.png", folder / "after.png"
    pictures.picture(before, "before")
    smooth(panel)
    report = panel.reflection_lines.report
    change = f"worst {report.worst_before:.2f} to {report.worst_after:.2f} degrees"
    pictures.picture(after, f"after: {change}, {1000.0 * report.seconds:.0f} ms")
    pictures.side_by_side([before, after], folder / "comparison.png")
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "car_smoothed.blend"), compress=True, copy=True)
    print(f"demo: look at {folder / 'comparison.png'}")


main(pathlib.Path(sys.argv[1]).resolve())
