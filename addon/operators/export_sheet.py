"""The operator Export Sheet."""
from functools import partial
from pathlib import Path

import bpy
import numpy as np

from ..blender import units
from ..interactive import read_picture
from ..interactive.beside_blender import FileExport, FileWork
from ..model.canvas import Canvas
from ..model.panel_picture import Looked, Pictured
from ..model.sheet import HEIGHT, PICTURE, WIDTH, Sheet, count_steps, draw_sheet
from ..model.refusal import report_refusals
from ..model.steps import Steps
from ..read import scene_objects
from ..read.text_outlines import read_outlines
from ..view import view_and_light
from ..write.png import encode_png

ROOM = 1.12  # of the picture to the panel's extent


class REFLINES_OT_export_sheet(FileExport, bpy.types.Operator):
    """Write the last inspection as one page for others: the panel with its stripes and numbered spots, a table, and the
worst spots from near, each in the light that shows it. Esc cancels"""
    bl_idname = "reflines.export_sheet"
    bl_label = "Export Sheet"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        if ob is None or ob.type != 'MESH' or not ob.reflection_lines.inspection.summary:
            return scene_objects.allow(cls, "Make a panel active that was inspected")
        return view_and_light.has_seen_panel(cls, context)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        return self.write_file(context, SheetWork(Path(bpy.path.abspath(self.filepath))))


class SheetWork(FileWork):
    """The work on one sheet."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.share = 0.0   # of the steps that are done
        self.written = ""  # the panel's name

    def write(self, context: bpy.types.Context) -> Steps[None]:
        sheet = yield from build_sheet(context, scene_objects.read_active_object(context))
        canvas = Canvas(WIDTH, HEIGHT, read_outlines)
        for _ in draw_sheet(sheet, canvas):
            self.share += 1.0 / count_steps(sheet)
            yield
        self.path.write_bytes(encode_png(canvas.to_bytes()))
        self.written = sheet.title

    def describe(self) -> str:
        return f"Sheet: {self.share:.0%}   Esc: cancel"

    def describe_written(self) -> str:
        return f"{self.written}: sheet written to {self.path.name}" if self.written else "No sheet was written"


def build_sheet(context: bpy.types.Context, ob: bpy.types.Object) -> Steps[Sheet]:
    """Reads what the sheet tells of the last inspection, and the panel as it is now."""
    stored = ob.reflection_lines.inspection
    texts = ob.name, f"{stored.summary}.", stored.unseen, [spot.to_spot() for spot in stored.spots]
    format_length = partial(units.format_length, scene=context.scene, precision=2)
    shown, looked = yield from read_picture.read_picture(context, ob)
    return Sheet(*texts, shown, frame(shown, looked), format_length)


def frame(shown: Pictured, looked: Looked) -> Looked:
    """Returns the view with all of the panel in the picture."""
    panel = shown.V[np.unique(shown.F[shown.region])]
    x, y = panel @ looked.right, panel @ looked.up
    middle = (0.5 * (x.min() + x.max()) * looked.right + 0.5 * (y.min() + y.max()) * looked.up
              + (looked.center @ looked.eye) * looked.eye)
    width = ROOM * max(np.ptp(x), np.ptp(y) * PICTURE[0] / PICTURE[1])
    return Looked(looked.right, looked.up, looked.eye, middle, float(width), looked.line, looked.count)
