"""Lines that are laid along curves in a session with handles: drawn, straightened, or parallel to edges."""
import numpy as np

from ..model import line_curve
from ..model.line_handle import LineHandle
from ..model.line_surface import Place
from ..read import read_edges
from .handle_tracing import Session

FEWEST = 3  # points of a stroke
# Of a handle's radius, within which a line leaves its held ends. Of 1/8 to 1/2 lines pass within 1 % of the spacing; at
# once, within 2 to 9 %, with a hook beside the border.
LEAVES = 1.0 / 3.0


def draw_line(session: Session, stroke: list[Place]) -> LineHandle | None:
    """Returns the handle that lays the line at the start of a stroke along it; None for a stroke that is too short."""
    if len(stroke) < FEWEST:
        return None
    points = np.array([session.surface.read_point(each, session.surface.start) for each in stroke])
    source = session.surface.find_source(stroke[0], session.state)
    start = session.to_local(session.surface.read_point(source, session.surface.start))
    return lay(session, LineHandle(start, start, session.choose_radius()), line_curve.fit_curve(points))


def lay(session: Session, handle: LineHandle, points: np.ndarray) -> LineHandle:
    """Returns a handle whose line runs along the curve through points of world space (#P x 3)."""
    return handle.lay(tuple(session.to_local(point) for point in points))


def straighten_line(session: Session, handle: LineHandle, place: Place) -> LineHandle | None:
    """Returns the handle with its line along the straight way between its two ends."""
    line = session.surface.trace_through(place, session.state)
    return lay(session, handle, line_curve.straighten(line)) if len(line) >= FEWEST else None


def follow_edge(session: Session, handle: LineHandle, place: Place) -> LineHandle | None:
    """Returns the handle with its line parallel to the selected edges, else to the border or crease beside it."""
    line, plane = session.surface.trace_through(place, session.state), session.frame[:2]
    if len(line) < FEWEST:
        return None
    at = plane @ session.surface.read_point(place, session.state)
    edges = read_edges.read_selected_edges(session.own) @ plane.T
    if not len(edges):
        edges = read_edges.read_bounding_edges(session.own) @ plane.T
        edges = line_curve.choose_loop(edges, at, plane @ (line[-1] - line[0]))
    if not len(edges):
        return None
    points = line_curve.run_parallel(line @ plane.T, edges, at)
    points = line_curve.keep_ends(line @ plane.T, points, session.can_follow(line @ plane.T),
                                  LEAVES * handle.radius)
    return lay(session, handle, line_curve.space_evenly(points) @ plane)
