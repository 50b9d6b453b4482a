"""Makes hood_lines.blend beside this script: ./run samples"""
import json
import pathlib

import bpy

import checkout
import hood_shape
import studio

HERE = pathlib.Path(__file__).resolve().parent

SHOT = studio.Shot(view_direction=(0.10, -0.70, 1.0), line_direction=(0.0, 1.0, 0.12), centre=(0.0, 0.0, -0.03),
                   width=1.70, lamp=(0.95, -0.3, 0.25), stripes=studio.Stripes(),
                   colour=(0.56, 0.66, 0.78))
COLUMNS, ROWS = 136, 110
PULLS = (((-0.12, 0.05), (-0.17, 0.05)), ((0.12, 0.05), (0.17, 0.05)))  # from and to, metres in the plan
RADIUS = 0.3


def write_handle(start: tuple[float, float], end: tuple[float, float]) -> dict[str, object]:
    """A handle as Pull Line keeps it; heights do not matter, for the view looks down on the bonnet."""
    on_bonnet = [(x, y, float(hood_shape.clean_height(x, y))) for x, y in (start, end)]
    return {"start": on_bonnet[0], "end": on_bonnet[1], "radius": RADIUS, "pinned": [], "muted": False}


def main() -> None:
    checkout.enable_add_on()
    V, quads = hood_shape.panel(COLUMNS, ROWS)
    hood = studio.stage("Hood", V, quads, hood_shape.job(V[:, 0], V[:, 1]), SHOT)
    bpy.ops.object.mode_set(mode='EDIT')
    handles = json.dumps([write_handle(*pull) for pull in PULLS])
    assert bpy.ops.reflines.pull_line('EXEC_DEFAULT', handles=handles) == {'FINISHED'}
    bpy.ops.object.mode_set(mode='OBJECT')
    studio.save(hood, str(HERE / "hood_lines.blend"))


main()
