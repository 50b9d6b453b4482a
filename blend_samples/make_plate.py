"""Makes plate.blend beside this script: ./run samples"""
import pathlib

import bpy
import numpy as np

import checkout
import panel_shapes
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(0.0, 0.0, 1.0), line_direction=(1.0, 0.0, 0.2), centre=(0.0, 0.0, 0.0),
                   width=1.35, lamp=(0.55, 0.0, 0.2), stripes=studio.Stripes(count=110),
                   colour=(0.35, 0.45, 0.60))


def star() -> bpy.types.Image:
    grey = panel_shapes.star()
    image = bpy.data.images.new("Star", *grey.shape, float_buffer=True, is_data=True)
    image.pixels.foreach_set(np.dstack([grey, grey, grey, np.ones_like(grey)]).astype(np.float32).ravel())
    image.pack()   # what is not packed comes back empty
    return image


def main() -> None:
    checkout.enable_add_on()
    V, quads = panel_shapes.plate()
    plate = studio.stage("Plate", V, quads, np.ones(len(V), bool), SHOT)
    settings = bpy.context.scene.reflection_lines
    settings.pattern.image, settings.pattern.strength, settings.pattern.blur = star(), 0.3, 16.0
    settings.border = 'free'
    studio.save(plate, str(HERE / "plate.blend"))


main()
