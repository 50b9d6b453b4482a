"""Makes door.blend beside this script: ./run samples"""
import pathlib

import bpy

import checkout
import panel_shapes
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(1.0, -0.10, 0.22), line_direction=(0.0, 1.0, 0.0), centre=(-0.02, 0.0, 0.0),
                   width=1.25, lamp=(0.3, -0.3, 0.5), stripes=studio.Stripes(count=110), length=0.5,
                   colour=(0.62, 0.20, 0.16))


def main() -> None:
    checkout.enable_add_on()
    V, quads, _ = panel_shapes.door()
    door = studio.stage("Door", V, quads, panel_shapes.door_inside(V[:, 1], V[:, 2]), SHOT)
    bpy.context.scene.reflection_lines.directional = True
    studio.save(door, str(HERE / "door.blend"))


main()
