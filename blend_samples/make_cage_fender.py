"""Makes cage_fender.blend beside this script: ./run samples"""
import pathlib

import numpy as np

import cage_shapes
import checkout
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(1.0, -0.10, 0.25), line_direction=(0.0, 1.0, 0.0), centre=(-0.03, 0.0, 0.48),
                   width=1.35, lamp=(0.3, -0.3, 1.0), stripes=studio.Stripes(count=80),
                   colour=(0.66, 0.68, 0.70))


def main() -> None:
    checkout.enable_add_on()
    V, quads, _ = cage_shapes.fender()
    fender = studio.stage("Fender", V, quads, np.ones(len(V), bool), SHOT)
    columns = int(quads[0][2]) - 1  # vertices of a row
    row = range(cage_shapes.CREASE_ROW * columns, (cage_shapes.CREASE_ROW + 1) * columns)
    fender.data.edges.foreach_set("crease", [cage_shapes.CREASE * set(edge.vertices).issubset(row)
                                             for edge in fender.data.edges])  # samples are made with Blender 3.4
    studio.subdivide(fender)
    studio.save(fender, str(HERE / "cage_fender.blend"))


main()
