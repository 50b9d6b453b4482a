"""Draws the picture of a set of lights in the manual: the bonnet of the car from three sides, before and after a press.
Run it as

    blender -b --factory-startup -P tests/in_blender.py -- blend_samples/light_set_picture.py FOLDER

It writes FOLDER/light_set.jpg, which is kept in addon/manual/pictures.
"""
import pathlib
import sys
from dataclasses import replace

import bpy
import numpy as np

import checkout
import pictures

HERE = pathlib.Path(__file__).resolve().parent
FOLDER = pathlib.Path(sys.argv[1]).resolve()
SIDES = ("Its left, light", "The view, light", "Its right, light")  # of the walk around
SIZE = (620, 400)     # pixels of each view
GUTTER, CAPTION = 16, 52
STRIPES = 60
ROOM = 1.05           # of a view to the panel's extent
WIDTH, QUALITY = 880, 60


def main() -> None:
    add_on = checkout.enable_add_on()
    bpy.ops.wm.open_mainfile(filepath=str(HERE / "car.blend"), load_ui=False)
    ob, context = bpy.context.view_layer.objects.active, bpy.context
    bpy.ops.reflines.light_set(action='WALK')
    rows = [draw_row(add_on, context, ob, "Before")]
    bpy.ops.reflines.smooth(lights='SET')
    print(f"light set: {ob.reflection_lines.report.headline()}")
    rows.append(draw_row(add_on, context, ob, "After one press with the set"))
    FOLDER.mkdir(parents=True, exist_ok=True)
    large = FOLDER / "light_set.png"
    large.write_bytes(add_on.write.png.encode_png(np.concatenate(rows)))
    pictures.shrink(large, FOLDER / "light_set.jpg", WIDTH, QUALITY)
    large.unlink()


def draw_row(add_on: object, context: bpy.types.Context, ob: bpy.types.Object, name: str) -> np.ndarray:
    """Draws the panel as it is now from each side, with a caption below each."""
    shown, looked = add_on.model.steps.finish(add_on.interactive.read_picture.read_picture(context, ob))
    panel_picture = add_on.model.panel_picture
    canvas = add_on.model.canvas.Canvas(3 * SIZE[0] + 2 * GUTTER, SIZE[1] + CAPTION,
                                        add_on.read.text_outlines.read_outlines)
    for index, side in enumerate(SIDES):
        light = context.scene.reflection_lines.light_set.entries[side]
        eye = np.array(light.eye)
        right, up = panel_picture.turn_to(looked, eye)
        own = replace(looked, right=right, up=up, eye=eye, line=np.array(light.line), count=STRIPES)
        left = index * (SIZE[0] + GUTTER)
        canvas.paste(panel_picture.draw_panel(shown, fit(shown, own), *SIZE), left, 0)
        canvas.write(f"{name}: {side.split(',')[0].lower()}", left + 2, SIZE[1] + 34, 26)
    return canvas.to_bytes()


def fit(shown: object, looked: object) -> object:
    """Returns the view with all of the panel in it, in its middle."""
    panel = shown.V[np.unique(shown.F[shown.region])] - looked.center
    x, y = panel @ looked.right, panel @ looked.up
    center = looked.center + 0.5 * (x.min() + x.max()) * looked.right + 0.5 * (y.min() + y.max()) * looked.up
    return replace(looked, center=center, width=ROOM * max(np.ptp(x), np.ptp(y) * SIZE[0] / SIZE[1]))


main()
