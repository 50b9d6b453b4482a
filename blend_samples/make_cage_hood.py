"""Makes cage_hood.blend beside this script: blender -b --factory-startup -P blend_samples/make_cage_hood.py"""
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import cage_shapes  # noqa: E402  (Blender puts no script's own folder on the path)
import checkout  # noqa: E402
import studio  # noqa: E402

SHOT = studio.Shot(view_direction=(0.10, -0.70, 1.0), line_direction=(0.0, 1.0, 0.12), centre=(0.0, 0.0, -0.03),
                   width=1.75, lamp=(0.85, -0.3, 0.25), stripes=studio.Stripes(count=72), length=0.5,
                   colour=(0.56, 0.66, 0.78))


def main() -> None:
    checkout.enable_add_on()
    V, quads, _ = cage_shapes.hood()
    hood = studio.stage("Hood", V, quads, np.ones(len(V), bool), SHOT)
    studio.subdivide(hood)
    studio.save(hood, str(HERE / "cage_hood.blend"))


main()
