"""The operator Export Sheet."""
from functools import partial
from pathlib import Path

import bpy
import numpy as np
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper

from ..blender import units
from ..interactive import read_picture
from ..model.canvas import Canvas
from ..model.panel_picture import Looked, Pictured
from ..model.refusal import report_refusals
from ..model.sheet import HEIGHT, PICTURE, WIDTH, Sheet, draw_sheet
from ..read import scene_objects
from ..read.text_outlines import TextReader
from ..view import view_and_light
from ..write.png import encode_png

ROOM = 1.12  # of the picture to the panel's extent


class REFLINES_OT_export_sheet(ExportHelper, bpy.types.Operator):
    """Write the last inspection as one page for others: the panel with its stripes and numbered spots, a table, and the
worst spots from near, each in the light that shows it"""
    bl_idname = "reflines.export_sheet"
    bl_label = "Export Sheet"

    filename_ext = ".png"
    filter_glob: StringProperty(default="*.png", options={'HIDDEN'})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        if ob is None or ob.type != 'MESH' or not ob.reflection_lines.inspection.summary:
            cls.poll_message_set("Make a panel active that was inspected")
            return False
        obstacle = view_and_light.find_obstacle(context.scene)
        cls.poll_message_set(obstacle)
        return not obstacle

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        ob, path = scene_objects.read_active_object(context), Path(bpy.path.abspath(self.filepath))
        pixels = draw(context, ob)
        path.write_bytes(encode_png(pixels))
        self.report({'INFO'}, f"{ob.name}: sheet written to {path.name}")
        return {'FINISHED'}


def draw(context: bpy.types.Context, ob: bpy.types.Object) -> np.ndarray:
    """Draws the sheet: height x width x 3, uint8."""
    sheet = build_sheet(context, ob)
    with TextReader() as reader:
        canvas = Canvas(WIDTH, HEIGHT, reader.read)
        draw_sheet(sheet, canvas)
    return canvas.to_bytes()


def build_sheet(context: bpy.types.Context, ob: bpy.types.Object) -> Sheet:
    """Reads what the sheet tells of the last inspection, and the panel as it is now."""
    stored = ob.reflection_lines.inspection
    shown, looked = read_picture.read_picture(context, ob)
    return Sheet(ob.name, f"{stored.summary}.", stored.unseen, [spot.to_spot() for spot in stored.spots], shown,
                 frame(shown, looked), partial(units.format_length, scene=context.scene, precision=2))


def frame(shown: Pictured, looked: Looked) -> Looked:
    """Returns the view with all of the panel in the picture."""
    panel = shown.V[np.unique(shown.F[shown.region])]
    x, y = panel @ looked.right, panel @ looked.up
    middle = (0.5 * (x.min() + x.max()) * looked.right + 0.5 * (y.min() + y.max()) * looked.up
              + (looked.center @ looked.eye) * looked.eye)
    width = ROOM * max(np.ptp(x), np.ptp(y) * PICTURE[0] / PICTURE[1])
    return Looked(looked.right, looked.up, looked.eye, middle, float(width), looked.line, looked.count)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_export_sheet])
