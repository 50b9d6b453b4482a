"""Makes door.blend beside this script: blender -b --factory-startup -P blend_samples/make_door.py"""
import pathlib
import sys

import bpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import checkout  # noqa: E402  (Blender puts no script's own folder on the path)
import panel_shapes  # noqa: E402
import studio  # noqa: E402

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
