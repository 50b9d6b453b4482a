"""The operator Export Film."""
from dataclasses import replace
from math import radians
from pathlib import Path

import bpy
from bpy.props import EnumProperty

from ..interactive import read_picture
from ..interactive.beside_blender import FileExport, FileWork
from ..model.film import Film
from ..model.refusal import report_refusals
from ..model.steps import Steps
from ..read import scene_objects
from ..view import view_and_light
from ..write.png import encode_png

ROOM = 1.06  # of the picture to the panel's extent
SWING = radians(40.0)  # of the turntable, to each side
KINDS = (
    ('LIGHT', "Sweep Light", "The light turns around the view, once"),
    ('VIEW', "Turntable", "The view walks around the panel to both sides, and back to where it began; the light stays"),
)


class REFLINES_OT_export_film(FileExport, bpy.types.Operator):
    """Write a film of the panel with its stripes as one PNG a frame: the light turns, or the view walks around. Esc
ends it early"""
    bl_idname = "reflines.export_film"
    bl_label = "Export Film"

    kind: EnumProperty(name="Film", items=KINDS, default='LIGHT', description="What moves")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return view_and_light.has_seen_panel(cls, context)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        scene = context.scene
        settings = self.kind, SWING, count_frames(scene), *read_render_size(scene.render)
        return self.write_file(context, FilmWork(Path(bpy.path.abspath(self.filepath)), settings))


def count_frames(scene: bpy.types.Scene) -> int:
    """Returns how many frames Blender plays: of the preview range where that is in use."""
    if scene.use_preview_range:
        return 1 + scene.frame_preview_end - scene.frame_preview_start
    return 1 + scene.frame_end - scene.frame_start


def read_render_size(render: bpy.types.RenderSettings) -> tuple[int, int]:
    """Returns how large a picture is that Blender renders, in pixels."""
    return tuple(side * render.resolution_percentage // 100 for side in (render.resolution_x, render.resolution_y))


class FilmWork(FileWork):
    """The work on one film."""

    def __init__(self, path: Path, settings: tuple[str, float, int, int, int]) -> None:
        """Takes what `Film` ends with."""
        self.path, self.settings = path, settings
        self.written = 0  # frames

    def write(self, context: bpy.types.Context) -> Steps[None]:
        """Writes the panel as it is now: what is changed later is in no frame."""
        shown, looked = yield from read_picture.read_picture(context, scene_objects.read_active_object(context))
        film = Film(shown, looked, *self.settings)
        film = replace(film, looked=replace(looked, width=ROOM * film.measure_width()))
        for frame in range(film.frames):
            pixels = yield from film.draw_frame(frame)
            self.name_frame(frame).write_bytes(encode_png(pixels))
            self.written += 1
            yield

    def name_frame(self, frame: int) -> Path:
        """Returns the file of a frame, numbered from 1 as Blender does."""
        return self.path.with_name(f"{self.path.stem}{frame + 1:04d}.png")

    def describe(self) -> str:
        return f"Film: {self.written} of {self.settings[2]} frames   Esc: end it here"

    def describe_written(self) -> str:
        return (f"{self.written} frames written, the first is {self.name_frame(0).name}" if self.written else
                "No frame was written")
