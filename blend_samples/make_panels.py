"""Makes the samples of one panel each beside this script: ./run samples"""
import json
import pathlib
from dataclasses import replace

import bpy
import numpy as np

import cage_shapes
import checkout
import hood_shape
import panel_shapes
import studio

HERE = pathlib.Path(__file__).resolve().parent

# Somebody who stands before the car, a step to its left; lamps along the car, as in an inspection tunnel.
HOOD = studio.Shot(view_direction=(0.10, -0.70, 1.0), line_direction=(0.0, 1.0, 0.12), centre=(0.0, 0.0, -0.03),
                   width=1.70, lamp=(0.95, -0.3, 0.25), stripes=studio.Stripes(), colour=(0.56, 0.66, 0.78))
DOOR = studio.Shot(view_direction=(1.0, -0.10, 0.22), line_direction=(0.0, 1.0, 0.0), centre=(-0.02, 0.0, 0.0),
                   width=1.25, lamp=(0.3, -0.3, 0.5), stripes=studio.Stripes(count=110), length=0.5,
                   colour=(0.62, 0.20, 0.16))
FAUCET = studio.Shot(view_direction=(0.0, -1.0, 0.0), line_direction=(0.95, 0.0, 0.31), centre=(0.075, 0.0, 0.115),
                     width=0.30, lamp=(0.2, -0.05, 0.25), stripes=studio.Stripes(count=12), length=0.03,
                     colour=(0.80, 0.80, 0.82))
FENDER = studio.Shot(view_direction=(1.0, -0.05, 0.12), line_direction=(0.0, 1.0, 0.0), centre=(-0.03, 0.0, 0.45),
                     width=1.3, lamp=(0.3, -0.3, 1.0), stripes=studio.Stripes(count=80), colour=(0.66, 0.68, 0.70))
PLATE = studio.Shot(view_direction=(0.0, 0.0, 1.0), line_direction=(1.0, 0.0, 0.2), centre=(0.0, 0.0, 0.0),
                    width=1.35, lamp=(0.55, 0.0, 0.2), stripes=studio.Stripes(count=110), colour=(0.35, 0.45, 0.60))
CELLS = 136, 110  # of the bonnet: 14,960 quads of about 11 mm
PULLS = (((-0.12, 0.05), (-0.17, 0.05)), ((0.12, 0.05), (0.17, 0.05)))  # from and to, metres in the plan
LATTICE = 7  # points of a side


def settings() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines


def make_hood() -> bpy.types.Object:
    """The wobbly bonnet."""
    V, quads = hood_shape.panel(*CELLS)
    V[:, 2] += hood_shape.wobble(*V[:, :2].T)
    hood = studio.stage("Hood", V, quads, hood_shape.job(*V[:, :2].T), HOOD)
    studio.set_up_render(1400, 1000, samples=8)
    return hood


def stage_clean_hood() -> bpy.types.Object:
    V, quads = hood_shape.panel(*CELLS)
    return studio.stage("Hood", V, quads, hood_shape.job(*V[:, :2].T), HOOD)


def make_hood_lines() -> bpy.types.Object:
    hood = stage_clean_hood()
    bpy.ops.object.mode_set(mode='EDIT')
    handles = json.dumps([write_handle(*pull) for pull in PULLS])
    assert bpy.ops.reflines.pull_line('EXEC_DEFAULT', handles=handles) == {'FINISHED'}
    bpy.ops.object.mode_set(mode='OBJECT')
    return hood


def write_handle(start: tuple[float, float], end: tuple[float, float]) -> dict[str, object]:
    """A handle as Pull Line keeps it; heights do not matter, for the view looks down on the bonnet."""
    on_bonnet = [(x, y, float(hood_shape.clean_height(x, y))) for x, y in (start, end)]
    return {"start": on_bonnet[0], "end": on_bonnet[1], "radius": 0.3, "pinned": [], "muted": False}


def make_hood_warp() -> bpy.types.Object:
    hood = stage_clean_hood()
    settings().border, settings().warp.fit = 'fixed', 'GRADIENT'
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.reflines.add_warp_lattice(columns=LATTICE, rows=LATTICE)
    bend(settings().warp.lattice, 0.8)
    bpy.ops.object.mode_set(mode='OBJECT')
    return hood


def bend(lattice: bpy.types.Object, amount: float) -> None:
    """Pulls the middle of the lattice apart, as an artist drags its points."""
    points = np.empty(3 * LATTICE * LATTICE, np.float32)
    lattice.data.points.foreach_get("co_deform", points)
    points = points.reshape(LATTICE, LATTICE, 3)
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, LATTICE), np.linspace(-1.0, 1.0, LATTICE))
    points[:, :, 0] += amount * np.sin(np.pi * u) * (1.0 - v**2)**2
    lattice.data.points.foreach_set("co_deform", points.ravel())
    lattice.data.update_tag()


def make_door() -> bpy.types.Object:
    V, quads, _ = panel_shapes.door()
    door = studio.stage("Door", V, quads, panel_shapes.door_inside(V[:, 1], V[:, 2]), DOOR)
    settings().directional = True
    return door


def make_faucet() -> bpy.types.Object:
    V, quads, _ = panel_shapes.faucet()
    return studio.stage("Faucet", V, quads, panel_shapes.faucet_inside(), FAUCET)


def make_fender() -> bpy.types.Object:
    V, quads, _ = panel_shapes.fender()
    fender = studio.stage("Fender", V, quads, np.ones(len(V), bool), FENDER)
    y, z = panel_shapes.TWIST_CENTRE
    bpy.context.scene.cursor.location = (panel_shapes.fender_clean(y, z), y, z)
    own = settings().direction
    own.angle, own.centre, own.radius = 0.8 * panel_shapes.TWIST, 'CURSOR', 1.4 * panel_shapes.TWIST_RADIUS
    settings().border = 'free'  # of a whole fender: no face beside it could be creased
    return fender


def make_plate() -> bpy.types.Object:
    V, quads = panel_shapes.plate()
    plate = studio.stage("Plate", V, quads, np.ones(len(V), bool), PLATE)
    own, settings().border = settings().pattern, 'free'
    own.image, own.strength, own.blur = draw_star(), 0.3, 16.0
    return plate


def draw_star() -> bpy.types.Image:
    grey = panel_shapes.star()
    image = bpy.data.images.new("Star", *grey.shape, float_buffer=True, is_data=True)
    image.pixels.foreach_set(np.dstack([grey, grey, grey, np.ones_like(grey)]).astype(np.float32).ravel())
    image.pack()   # what is not packed comes back empty
    return image


def make_cage_hood() -> bpy.types.Object:
    V, quads, _ = cage_shapes.hood()
    shot = replace(HOOD, width=1.75, lamp=(0.85, -0.3, 0.25), stripes=studio.Stripes(count=72))
    hood = studio.stage("Hood", V, quads, np.ones(len(V), bool), shot)
    studio.subdivide(hood)
    return hood


def make_cage_fender() -> bpy.types.Object:
    V, quads, _ = cage_shapes.fender()
    shot = replace(FENDER, view_direction=(1.0, -0.10, 0.25), centre=(-0.03, 0.0, 0.48), width=1.35)
    fender = studio.stage("Fender", V, quads, np.ones(len(V), bool), shot)
    columns = int(quads[0][2]) - 1  # vertices of a row
    row = range(cage_shapes.CREASE_ROW * columns, (cage_shapes.CREASE_ROW + 1) * columns)
    fender.data.edges.foreach_set("crease", [cage_shapes.CREASE * set(edge.vertices).issubset(row)
                                             for edge in fender.data.edges])  # samples are made with Blender 3.4
    studio.subdivide(fender)
    return fender


def main() -> None:
    checkout.enable_add_on()
    for make in (make_hood, make_hood_lines, make_hood_warp, make_door, make_faucet, make_fender, make_plate,
                 make_cage_hood, make_cage_fender):
        bpy.ops.wm.read_homefile(use_factory_startup=True)
        studio.save(make(), str(HERE / f"{make.__name__.removeprefix('make_')}.blend"))


main()
