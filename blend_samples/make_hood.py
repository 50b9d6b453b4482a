"""Makes hood.blend beside this script: ./run samples"""
import pathlib

import bpy

import checkout
import hood_shape
import studio

HERE = pathlib.Path(__file__).resolve().parent

COLUMNS, ROWS = 136, 110                 # 14,960 quads of about 11 mm
VIEW_DIRECTION = (0.10, -0.70, 1.0)      # somebody who stands before the car, a step to its left
LINE_DIRECTION = (0.0, 1.0, 0.12)        # lamps along the car, as in an inspection tunnel


def add_hood() -> bpy.types.Object:
    """The wobbly bonnet with the faces of the job selected."""
    V, quads = hood_shape.panel(COLUMNS, ROWS)
    x, y = V[:, 0], V[:, 1]
    inside = hood_shape.job(x, y)[quads].all(axis=1)
    V[:, 2] += hood_shape.wobble(x, y)
    hood = studio.add_panel("Hood", V, quads)
    hood.data.materials.append(studio.car_paint("Paint", (0.56, 0.66, 0.78)))
    studio.select_faces(hood, inside)
    return hood


def main() -> None:
    checkout.enable_add_on()
    studio.empty_scene()
    hood = add_hood()
    view = studio.add_view_camera(VIEW_DIRECTION, centre=(0.0, 0.0, -0.03), width=1.70)
    light = studio.add_light_direction(LINE_DIRECTION, location=(0.95, -0.3, 0.25))
    studio.set_up_add_on(view, light, studio.Stripes(), length=0.0)
    studio.light_the_room(view, light, studio.Stripes())
    studio.set_up_render(1400, 1000, samples=8)
    studio.look_through_camera()
    bpy.context.view_layer.objects.active = hood
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.wm.save_as_mainfile(filepath=str(HERE / "hood.blend"), compress=True)


main()
