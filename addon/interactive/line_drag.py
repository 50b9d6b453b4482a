"""A session with handles on lines: places under the mouse, handles and their history, and what is drawn.

Solves, mesh and work are those of drag.py; events are handled by operators/pull_line.py.
"""
from collections.abc import Callable
from dataclasses import replace

import bpy
import numpy as np

from ..blender import units
from ..model import line_handle, line_surface
from ..model.line_handle import Handles, LineHandle
from ..model.line_surface import LineState, LineSurface, Place
from ..model.patch import Patch
from ..overlay import handle_marks
from ..overlay.handle_marks import Marks
from ..read import read_mesh
from ..solver.read_solved import read_triangles
from ..view import screen_surface
from ..view.screen_surface import ScreenSurface
from . import drag_handles, drawn_lines, handle_texts
from .drag import Drag, DraggedOperator
from .drag_handles import PRECISE_FACTOR
from .handle_history import HandleHistory
from .handle_tracing import HandleTracing
from .solve_job import SolveOutcome

GRASP = 12.0  # pixels from a dot within which the mouse takes it, times the interface's scale
RADIUS_STEP, RADIUS_PIXELS = 1.1, 150.0  # factor of a notch of the wheel; pixels that double it
STROKE_STEP = 4.0  # pixels between two points of a stroke


class LineDrag(Drag):
    """One session, from the press of the button until Enter or Esc."""

    def __init__(self, tool: DraggedOperator, context: bpy.types.Context, handles: Handles,
                 others: dict[str, ScreenSurface]) -> None:
        """Takes the handles to begin with, and by their names the panels that are edited as well."""
        self.handles, self.others = handles, others
        self.beside = ""  # the one of them that was pressed on last
        self.history = HandleHistory()
        self.tracing = HandleTracing(self)
        self.surface: LineSurface | None = None  # once the first lines are there
        self.state: LineState | None = None      # what is shown
        self.held: int | None = None   # handle that the mouse drags
        self.near: int | None = None   # handle under the mouse
        self.dot = 0                   # number of the dot of that handle
        self.draws = tool.draws        # whether a press draws a line
        self.nearest = False           # whether a stroke takes the line that has to change least
        self.stroke: list[Place] = []  # what is being drawn
        self.typed = ""                # radius
        self.hover: Place | None = None  # place under the mouse
        self.sizing: tuple[float, float] | None = None  # where F was pressed, and the radius then
        self.pressed: tuple[float, float, bool] | None = None  # a press before the lines are there
        self.taken: tuple[int, int] | None = None  # handle, and its dot, that the next press takes
        self.mouse = self.last = (0.0, 0.0)  # pixels of the window: of the pull, and of the mouse itself
        self.looked = False  # whether the place under the mouse is known
        super().__init__(tool, context)
        owner = tool.find_owner(context, self.solved[0]).name
        self.own = next(patch for patch in self.patches if patch.name == owner)  # that the handles belong to
        self.marks = Marks()
        self.marks_drawn = handle_marks.add_marks(self.area, lambda: self.marks)

    def read_shown(self, ob: bpy.types.Object, patch: Patch) -> np.ndarray:
        """Reads the positions that the mesh has, which are not those of the start where handles were applied before.
        Gathering the patch has brought the mesh up to date with Edit Mode, which takes long.
        """
        return read_mesh.read_patch_positions(ob, patch)

    def begin_at(self, _context: bpy.types.Context, x: int, y: int) -> None:
        self.mouse = self.last = (float(x), float(y))

    def update_request(self, context: bpy.types.Context, *, final: bool = False) -> None:
        self.tool.handles = line_handle.encode_handles(self.handles)
        super().update_request(context, final=final)
        if not final:
            self.request = replace(self.request, lines=True, follows=tuple(each.follow for each in self.request.builds))

    def keep_values(self, _settings: bpy.types.PropertyGroup) -> None:
        """Keeps nothing: what a session leaves are its handles."""

    def take_gain(self, outcome: SolveOutcome) -> None:
        """Takes the lines, which a session shows instead of the gain."""
        if not outcome.lines:
            return
        self.state = outcome.lines[0]
        self.tracing.now = {}
        if self.surface is None:
            start = self.job.starts[0]
            triangles = read_triangles(start.problem, start.optimizer)
            self.surface = LineSurface(self.job.start_lines[0], triangles, self.frame)
            self.screen = screen_surface.ScreenSurface(self.surface, self.area)
            if self.pressed is not None:
                x, y, pins = self.pressed
                self.press(x, y, pins=pins)
        self.looked = False

    # Places and handles

    def to_local(self, point: np.ndarray) -> tuple[float, float, float]:
        """Returns a point in object space, in single precision: so it is kept with the object."""
        local = np.linalg.solve(self.own.matrix, np.append(point, 1.0))[:3]
        return tuple(local.astype(np.float32).tolist())

    def can_follow(self, points: np.ndarray) -> np.ndarray:
        """Returns whether the lines at points of the image plane (#P x 2) can be laid elsewhere: #P, bool."""
        return self.tool.builder.lines.can_follow(points)

    def find_place(self, point: tuple[float, float, float]) -> Place | None:
        """Returns the place of a point in object space."""
        return self.surface.find_place(self.own.to_world(np.array(point)))

    def move_to(self, x: float, y: float, *, precise: bool, back: bool) -> None:
        """Moves the mouse: the handle that is held follows it, `back` to the old line where that is wanted."""
        factor = PRECISE_FACTOR if precise and self.held is not None else 1.0
        way = factor * (x - self.last[0]), factor * (y - self.last[1])
        self.last = x, y
        self.mouse = (self.mouse[0] + way[0], self.mouse[1] + way[1]) if self.held is not None else (x, y)
        self.looked = False
        if self.sizing is not None:
            self.change_radius(self.sizing[1] * 2.0**((x - self.sizing[0]) / RADIUS_PIXELS))
        elif self.held is not None:
            self.pull_held(back=back)
        elif self.stroke:
            self.draw_on()

    def draw_on(self) -> None:
        """Draws on to the place under the mouse."""
        place = self.screen.find_place(*self.mouse, stay=True)
        if place is None:
            return
        ends = [self.surface.read_point(each, self.surface.start) for each in (self.stroke[-1], place)]
        if np.linalg.norm(np.subtract(*self.screen.find_pixels(np.array(ends)))) >= STROKE_STEP:
            self.stroke.append(place)

    def pull_held(self, *, back: bool) -> None:
        """Moves the end of the held handle under the mouse."""
        own = self.handles[self.held]
        place = None if back else self.screen.find_place(*self.mouse, stay=True)
        if place is None and not back:
            return  # beside the panel
        if back:
            end = self.history.before[-1][self.held].curve[self.dot] if own.curve else own.start
        else:
            end = self.to_local(self.surface.read_point(place, self.surface.start))
        if not own.is_pin:
            self.replace_handle(self.held, own.move_dot(self.dot, end))

    def take_dot(self, index: int, dot: int) -> None:
        """Makes the next press take a dot of a handle, where there is such a one."""
        if (index, dot) in self.list_dots():
            self.taken = index, dot

    def press(self, x: float, y: float, *, pins: bool) -> None:
        """Takes the handle under the mouse, or puts one on the line there; with `pins` holds that line."""
        self.mouse = self.last = (x, y)
        if self.surface is None:
            self.pressed = x, y, pins
            return
        self.pressed = None
        self.look()
        if self.taken is not None:
            (self.near, self.dot), self.taken = self.taken, None
        self.beside = self.find_other(x, y) if self.near is None and self.hover is None else ""
        if self.near is None and self.hover is None:
            return
        self.history.keep(self.handles)
        if self.near is not None:
            self.held = self.near
            return
        if self.draws and not pins:
            self.stroke = [self.hover]
            return
        self.dot = 0
        made = self.make_pin(self.hover) if pins else self.make_pull(self.hover)
        if self.add_handle(made) and not pins:
            self.held = len(self.handles) - 1

    def find_other(self, x: float, y: float) -> str:
        """Returns the name of another edited panel at a place (pixels of the window); empty where there is none."""
        found = screen_surface.find_foremost(list(self.others.values()), x, y)
        return "" if found is None else list(self.others)[found[0]]

    def add_handle(self, made: LineHandle | None) -> bool:
        """Adds a handle, for which history has a step; takes that back where there is none, or no room."""
        if made is None or len(self.handles) >= line_handle.MOST_HANDLES:
            self.history.drop()
            return False
        self.set_handles((*self.handles, made))
        return True

    def make_pull(self, place: Place) -> LineHandle:
        """Returns a handle at rest: the line of the start that is seen at a place now, pulled to where it is."""
        source = self.surface.find_source(place, self.state)
        start, end = (self.to_local(self.surface.read_point(each, self.surface.start)) for each in (source, place))
        return LineHandle(start, end, self.choose_radius())

    def make_pin(self, place: Place) -> LineHandle | None:
        """Returns a pin of the line through a place, where that has moved the place's line at the start."""
        source = self.surface.find_source(place, self.surface.start)
        line = self.surface.trace_through(source, self.surface.start)
        if len(line) < 2:
            return None
        inner = line_surface.thin_out(line[1:-1] if len(line) > 3 else line, line_handle.MOST_POINTS)
        start = self.to_local(self.surface.read_point(source, self.surface.start))
        return LineHandle(start, start, self.choose_radius(), tuple(self.to_local(point) for point in inner))

    def choose_radius(self) -> float:
        return self.tool.radius or self.tool.choose_automatic("radius", self.own)

    def release(self) -> None:
        """Lets the held handle go; a press that changed nothing leaves no step of history."""
        if self.stroke:
            drawn = drawn_lines.draw_line(self, self.stroke)
            self.add_handle(self.take_nearest(drawn) if drawn is not None and self.nearest else drawn)
            self.stroke = []
        elif self.held is not None and self.history and self.history.before[-1] == self.handles:
            self.history.drop()
        self.held = self.taken = None
        self.looked = False

    def take_nearest(self, drawn: LineHandle) -> LineHandle:
        """Returns the handle of the stroke for the line that has to change least to run along it."""
        theta = np.array([self.surface.read_theta(place, self.state) for place in self.stroke])
        points = np.array([self.surface.read_point(place, self.state) for place in self.stroke])
        value = line_surface.compute_mean_theta(theta, points)
        closest = self.stroke[int(np.abs(line_surface.wrap(theta - value)).argmin())]
        source = self.surface.find_level(closest, value, self.surface.start)
        return replace(drawn, start=self.to_local(self.surface.read_point(source, self.surface.start)))

    def find_active(self) -> int | None:
        """Returns the handle that keys work on: the one held or under the mouse, else the last."""
        for index in (self.held, self.near):
            if index is not None:
                return index
        return len(self.handles) - 1 if self.handles else None

    def delete_active(self) -> None:
        index = self.find_active()
        if index is not None:
            self.history.keep(self.handles)
            self.held = self.near = None
            self.set_handles(self.handles[:index] + self.handles[index + 1:])

    def mute_active(self) -> None:
        """Switches a handle off, and on again."""
        index = self.find_active()
        if index is not None:
            self.history.keep(self.handles)
            self.replace_handle(index, replace(self.handles[index], muted=not self.handles[index].muted))

    def lay_line(self, make: Callable[["LineDrag", LineHandle, Place], LineHandle | None]) -> None:
        """Lays the line of the handle under the mouse, else the line under it, along a curve that `make` returns."""
        if self.surface is None:
            return
        self.look()
        index, place = self.near, self.hover
        if place is None:
            return
        self.history.keep(self.handles)
        own = self.make_pull(place) if index is None else self.handles[index]
        made = None if own.is_pin else make(self, own, self.find_place(own.end) or place)
        if index is None or made is None:
            self.add_handle(made)
        else:
            self.replace_handle(index, made)

    def type_radius(self, character: str) -> bool:
        """Takes a character of a typed radius; returns whether it belongs to one, which begins with a digit."""
        if self.find_active() is None or not (character in drag_handles.CHARACTERS if self.typed
                                              else character.isdigit() or character == '.'):
            return False
        if not self.typed:
            self.history.keep(self.handles)
        self.set_typed(self.typed + character)
        return True

    def set_typed(self, text: str) -> None:
        self.typed = text
        radius = units.parse_number(text, 'LENGTH', bpy.context.scene) if text else None
        if radius is not None and radius > 0.0:
            self.change_radius(radius)

    def turn_wheel(self, notches: int) -> None:
        index = self.find_active()
        if index is not None:
            self.history.keep(self.handles)
            self.change_radius(self.handles[index].radius * RADIUS_STEP**notches)

    def change_radius(self, radius: float) -> None:
        index = self.find_active()
        if index is not None:
            self.replace_handle(index, replace(self.handles[index], radius=radius))

    def begin_sizing(self) -> None:
        index = self.find_active()
        if index is not None:
            self.history.keep(self.handles)
            self.sizing = self.last[0], self.handles[index].radius

    def replace_handle(self, index: int, handle: LineHandle) -> None:
        self.set_handles((*self.handles[:index], handle, *self.handles[index + 1:]))

    def set_handles(self, handles: Handles) -> None:
        self.moved = self.moved or handles != self.handles
        self.handles = handles

    def step_back(self) -> None:
        """Takes the last change of a handle back."""
        if self.history:
            self.go_to(self.history.step_back(self.handles))

    def step_forward(self) -> None:
        if self.history.undone:
            self.go_to(self.history.step_forward(self.handles))

    def go_to(self, handles: Handles) -> None:
        self.held = self.near = self.sizing = None
        self.looked, self.typed, self.stroke = False, "", []
        self.set_handles(handles)

    # Drawing and texts

    def look(self) -> None:
        """Finds what is under the mouse."""
        self.looked = True
        if self.surface is None:
            return
        at_work = self.held is not None or bool(self.stroke)
        self.hover, self.near = self.screen.find_place(*self.mouse, stay=at_work), None
        dots = self.list_dots()
        if dots and self.hover is not None:
            points = np.array([self.find_dot(self.handles[index].dots[number]) for index, number in dots])
            apart = np.linalg.norm(self.screen.find_pixels(points) - self.mouse, axis=1)
            nearest = int(np.nanargmin(np.append(apart, np.inf)))
            grasp = GRASP * bpy.context.preferences.system.ui_scale
            if nearest < len(dots) and apart[nearest] < grasp:
                self.near, self.dot = dots[nearest]

    def list_dots(self) -> list[tuple[int, int]]:
        """Returns each dot by its handle and its number there."""
        return [(index, number) for index, each in enumerate(self.handles) for number in range(len(each.dots))]

    def find_dot(self, dot: tuple[float, float, float]) -> np.ndarray:
        """Returns where a dot of object space is shown, in world space."""
        place = self.find_place(dot)
        return (self.surface.read_point(place, self.state) if place is not None
                else self.own.to_world(np.array(dot)))

    def refresh_marks(self) -> None:
        """Finds what is under the mouse where it has moved, and draws it."""
        if self.looked or self.surface is None:
            return
        self.look()
        self.marks = self.tracing.make_marks()
        self.area.tag_redraw()

    def update_texts(self, context: bpy.types.Context) -> None:
        self.refresh_marks()
        index = self.find_active()
        conflicts, reached, about = self.tool.builder.conflicts, self.tool.builder.reached, ""
        other = handle_texts.describe_other(self.own.name, self.beside) if self.beside else ""
        first = other or self.problem or (conflicts[0] if conflicts else self.describe_gain(context))
        if index is not None and self.surface is not None:
            about = f"   {handle_texts.describe_handle(context.scene, self.handles, index, reached, self.typed)}"
        count = f"{len(self.handles)} handle{'s' if len(self.handles) != 1 else ''}"
        self.show_texts(context, f"{first}   {count}{about}   ({self.tool.bl_label})",
                        handle_texts.describe_keys(draws=self.draws, nearest=self.nearest))

    def describe_gain(self, context: bpy.types.Context) -> str:
        """Says the move alone: what is reached is reported of each handle."""
        return f"Moved at most {units.format_length(self.largest_move, context.scene, precision=2)}"

    def end(self, context: bpy.types.Context) -> None:
        handle_marks.remove_marks(self.marks_drawn)
        super().end(context)
        self.area.tag_redraw()
