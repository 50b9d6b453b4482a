"""Makes cage_hood.blend beside this script: ./run samples"""
import pathlib

import numpy as np

import cage_shapes
import checkout
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(0.10, -0.70, 1.0), line_direction=(0.0, 1.0, 0.12), centre=(0.0, 0.0, -0.03),
                   width=1.75, lamp=(0.85, -0.3, 0.25), stripes=studio.Stripes(count=72),
                   colour=(0.56, 0.66, 0.78))


def main() -> None:
    checkout.enable_add_on()
    V, quads, _ = cage_shapes.hood()
    hood = studio.stage("Hood", V, quads, np.ones(len(V), bool), SHOT)
    studio.subdivide(hood)
    studio.save(hood, str(HERE / "cage_hood.blend"))


main()
