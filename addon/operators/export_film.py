"""The operators Export Film, in which a file is chosen, and Draw Film, which writes one picture a frame."""
from dataclasses import replace
from math import radians
from pathlib import Path

import bpy
import numpy as np
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..blender import compat
from ..interactive import read_picture, running_operators
from ..model.film import Film
from ..model.refusal import Refusal, report_refusals
from ..read import scene_objects
from ..view import view_and_light
from ..write.png import encode_png

TICK_INTERVAL = 0.01  # seconds between two bands of a frame
ROOM = 1.06           # of the picture to the panel's extent
KINDS = (
    ('LIGHT', "Sweep Light", "The light turns around the view, once"),
    ('VIEW', "Turntable", "The view walks around the panel to both sides, and back to where it began; the light stays"),
)


class FilmSettings:
    """The settings of a film."""
    kind: EnumProperty(name="Film", items=KINDS, default='LIGHT', description="What moves")
    frames: IntProperty(name="Frames", default=72, min=2, max=10000, description="Pictures from the beginning to where "
                        "it begins again")
    swing: FloatProperty(name="Swing", subtype='ANGLE', default=radians(40.0), min=0.0, max=radians(80.0),
                         description="Of the turntable, to each side")
    width: IntProperty(name="Width", subtype='PIXEL', default=1280, min=16, max=3840, description="Of a picture")
    height: IntProperty(name="Height", subtype='PIXEL', default=720, min=16, max=2160, description="Of a picture")


def has_panel(operator: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    ob = scene_objects.read_active_object(context)
    if ob is None or ob.type != 'MESH' or ob.mode not in {'EDIT', 'OBJECT'}:
        operator.poll_message_set("Make a panel's mesh active, in Edit Mode or Object Mode")
        return False
    obstacle = view_and_light.find_obstacle(context.scene)
    operator.poll_message_set(obstacle)
    return not obstacle


class REFLINES_OT_export_film(ExportHelper, FilmSettings, bpy.types.Operator):
    """Write a film of the panel with its stripes as one PNG a frame: the light turns, or the view walks around. Esc
ends it early"""
    bl_idname = "reflines.export_film"
    bl_label = "Export Film"

    filename_ext = ".png"
    filter_glob: StringProperty(default="*.png", options={'HIDDEN'})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_panel(cls, context)

    def execute(self, _context: bpy.types.Context) -> set[str]:
        given = {name: getattr(self, name) for name in ("kind", "frames", "swing", "width", "height", "filepath")}
        try:
            done = bpy.ops.reflines.draw_film('EXEC_DEFAULT' if bpy.app.background else 'INVOKE_DEFAULT', **given)
        except RuntimeError as error:  # Blender raises the errors that an operator reports
            self.report({'ERROR'}, compat.strip_error_prefix(error))
            return {'CANCELLED'}
        return {'FINISHED'} if done != {'CANCELLED'} else {'CANCELLED'}


class REFLINES_OT_draw_film(FilmSettings, bpy.types.Operator):
    """Write the frames of a film of the panel beside Blender, which goes on meanwhile"""
    bl_idname = "reflines.draw_film"
    bl_label = "Draw Film"
    bl_options = {'INTERNAL'}

    filepath: StringProperty(subtype='FILE_PATH', options={'HIDDEN', 'SKIP_SAVE'})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_panel(cls, context)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        self.begin(context)
        while not self.draw_next():
            pass
        self.tell()
        return {'FINISHED'}

    def begin(self, context: bpy.types.Context) -> None:
        """Reads the panel as it is now: what is changed later is in no frame."""
        shown, looked = read_picture.read_picture(context, scene_objects.read_active_object(context))
        film = Film(shown, looked, self.kind, self.swing, self.frames, self.width, self.height)
        self.film = replace(film, looked=replace(looked, width=ROOM * film.measure_width()))
        self.path = Path(bpy.path.abspath(self.filepath))
        self.band, self.drawn = 0, []

    def draw_next(self) -> bool:
        """Draws the next band, and writes the frame that is done with it; returns whether that was the last one."""
        frame, band = divmod(self.band, self.film.bands)
        self.drawn.append(self.film.draw_band(frame, band))
        self.band += 1
        if band == self.film.bands - 1:
            self.name_frame(frame).write_bytes(encode_png(np.concatenate(self.drawn)))
            self.drawn = []
        return self.band == self.film.bands * self.frames

    def name_frame(self, frame: int) -> Path:
        """Returns the file of a frame, numbered from 1 as Blender does."""
        return self.path.with_name(f"{self.path.stem}{frame + 1:04d}.png")

    def tell(self) -> None:
        count = self.band // self.film.bands
        self.report({'INFO'}, f"{count} frames written, the first is {self.name_frame(0).name}" if count else
                    "No frame was written")

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        try:
            self.begin(context)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        return running_operators.begin(self, context, TICK_INTERVAL)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == 'ESC' and event.value == 'PRESS':
            self.take_back(context)
            self.tell()
            return {'CANCELLED'}
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        try:
            is_done = self.draw_next()
        except OSError as error:
            self.take_back(context)
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}
        done = self.band // self.film.bands
        context.workspace.status_text_set(f"Film: frame {done} of {self.frames}   Esc: end it here")
        if not is_done:
            return {'RUNNING_MODAL'}
        self.take_back(context)
        self.tell()
        return {'FINISHED'}

    def take_back(self, context: bpy.types.Context) -> None:
        """Ends the work; the frames that are written stay."""
        running_operators.end(self, context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Ends the work when Blender exits or opens another file."""
        self.take_back(context)


register, unregister = running_operators.make_registration(REFLINES_OT_export_film, REFLINES_OT_draw_film)
