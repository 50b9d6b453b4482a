"""Makes fender.blend beside this script: ./run samples"""
import pathlib

import bpy
import numpy as np

import checkout
import panel_shapes
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(1.0, -0.05, 0.12), line_direction=(0.0, 1.0, 0.0), centre=(-0.03, 0.0, 0.45),
                   width=1.3, lamp=(0.3, -0.3, 1.0), stripes=studio.Stripes(count=80),
                   colour=(0.66, 0.68, 0.70))


def main() -> None:
    checkout.enable_add_on()
    V, quads, _ = panel_shapes.fender()
    fender = studio.stage("Fender", V, quads, np.ones(len(V), bool), SHOT)
    y, z = panel_shapes.TWIST_CENTRE
    bpy.context.scene.cursor.location = (panel_shapes.fender_clean(y, z), y, z)
    settings = bpy.context.scene.reflection_lines.direction
    settings.angle, settings.centre = 0.8 * panel_shapes.TWIST, 'CURSOR'
    bpy.context.scene.reflection_lines.border = 'free'  # of a whole fender: no face beside it could be creased
    settings.radius = 1.4 * panel_shapes.TWIST_RADIUS
    studio.save(fender, str(HERE / "fender.blend"))


main()
