"""Makes hood_warp.blend beside this script: ./run samples"""
import pathlib

import bpy
import numpy as np

import checkout
import hood_shape
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(0.10, -0.70, 1.0), line_direction=(0.0, 1.0, 0.12), centre=(0.0, 0.0, -0.03),
                   width=1.70, lamp=(0.95, -0.3, 0.25), stripes=studio.Stripes(),
                   colour=(0.56, 0.66, 0.78))
COLUMNS, ROWS = 7, 7


def bend(lattice: bpy.types.Object, amount: float) -> None:
    """Pulls the middle of the lattice apart, as an artist drags its points."""
    points = np.empty(3 * COLUMNS * ROWS, np.float32)
    lattice.data.points.foreach_get("co_deform", points)
    points = points.reshape(ROWS, COLUMNS, 3)
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, COLUMNS), np.linspace(-1.0, 1.0, ROWS))
    points[:, :, 0] += amount * np.sin(np.pi * u) * (1.0 - v**2)**2
    lattice.data.points.foreach_set("co_deform", points.ravel())
    lattice.data.update_tag()


def main() -> None:
    checkout.enable_add_on()
    V, quads = hood_shape.panel(136, 110)
    hood = studio.stage("Hood", V, quads, hood_shape.job(V[:, 0], V[:, 1]), SHOT)
    settings = bpy.context.scene.reflection_lines
    settings.border, settings.warp.fit = 'fixed', 'GRADIENT'
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.reflines.add_warp_lattice(columns=COLUMNS, rows=ROWS)
    bend(settings.warp.lattice, 0.8)
    bpy.ops.object.mode_set(mode='OBJECT')
    studio.save(hood, str(HERE / "hood_warp.blend"))


main()
