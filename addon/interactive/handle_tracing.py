"""The lines of a session's handles, traced on the surface, and the marks that show them."""
from typing import Protocol

import numpy as np

from ..model.line_handle import Handles, LineHandle
from ..model.line_surface import LineState, LineSurface, Place
from ..model.patch import Patch
from ..overlay import handle_marks
from ..overlay.handle_marks import Curve, Dot, Marks


class Session(Protocol):
    """The part of a session with handles that is used here and in drawn_lines.py."""
    surface: LineSurface
    state: LineState
    own: Patch
    frame: np.ndarray
    handles: Handles
    held: int | None
    near: int | None
    dot: int
    hover: Place | None
    stroke: list[Place]

    def find_active(self) -> int | None: ...
    def find_place(self, point: tuple[float, float, float]) -> Place | None: ...
    def find_dot(self, dot: tuple[float, float, float]) -> np.ndarray: ...
    def list_dots(self) -> list[tuple[int, int]]: ...
    def to_local(self, point: np.ndarray) -> tuple[float, float, float]: ...
    def choose_radius(self) -> float: ...
    def can_follow(self, points: np.ndarray) -> np.ndarray: ...


def choose_color(handle: LineHandle) -> handle_marks.Color:
    """Returns the colour of a handle's dot and line."""
    if handle.muted:
        return handle_marks.GHOST_COLOR
    return handle_marks.PIN_COLOR if handle.is_pin else handle_marks.LINE_COLOR


class HandleTracing:
    """Traces the lines of handles once for each state of the surface."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.now: dict[LineHandle, Curve] = {}     # lines of the handles in what is shown; emptied with it
        self.ghosts: dict[LineHandle, Curve] = {}  # and at the start, of the handles that were taken

    def make_marks(self) -> Marks:
        """Returns the lines and dots of all handles, and the stroke, or the line under the mouse that none holds."""
        session = self.session
        curves = [curve for index in range(len(session.handles)) for curve in self.trace_handle(index)]
        if session.stroke:
            drawn = np.array([session.surface.read_point(each, session.state) for each in session.stroke])
            curves.append(Curve(drawn, handle_marks.HOVER_COLOR))
        elif session.held is None and session.near is None and session.hover is not None:
            curves.append(Curve(session.surface.trace_through(session.hover, session.state),
                                handle_marks.HOVER_COLOR))
        return Marks(tuple(curves), tuple(self.make_dot(index, number) for index, number in session.list_dots()))

    def make_dot(self, index: int, number: int) -> Dot:
        session, handle = self.session, self.session.handles[index]
        is_under_mouse = index in (session.near, session.held) and number == session.dot
        return Dot(session.find_dot(handle.dots[number]), choose_color(handle), is_under_mouse, handle.muted)

    def trace_handle(self, index: int) -> tuple[Curve, ...]:
        """Traces the line of a handle as it is now, and of the one that is taken its ghost at the start."""
        session, surface = self.session, self.session.surface
        own = session.handles[index]
        start, end = session.find_place(own.start), session.find_place(own.end)
        if start is None or end is None or own.muted:
            return ()
        value = surface.read_theta(start, surface.start)
        if own not in self.now:
            line = surface.trace_through(surface.find_level(end, value, session.state), session.state)
            self.now[own] = Curve(line, choose_color(own))
        if index != session.find_active() or own.is_pin:
            return (self.now[own],)
        if own not in self.ghosts:
            ghost = surface.trace(start, surface.start, value)
            self.ghosts = {own: Curve(ghost, handle_marks.GHOST_COLOR, handle_marks.GHOST_WIDTH)}
        return self.ghosts[own], self.now[own]
