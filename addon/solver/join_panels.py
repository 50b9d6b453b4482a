"""Joins panels that meet over gaps to one patch, see model/joined_patch.py."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate

import numpy as np

from .. import native
from ..model.border import CODES, UNSET
from ..model.cage import CagePatch
from ..model.joined_patch import JoinedPatch, PanelPart, join_creases, join_ranges
from ..model.meeting import find_meeting, find_middle
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.surroundings import Surroundings
from ..model.triangulation import compute_area_normals, list_border
from ..model.view import View
from .join_cages import build_surface, choose_level, have_same_rules, put_cages_together
from .joint_mirror import can_join, find_seam, find_seam_rows, have_same_plane, join_mirrors
from .panel_problem import PanelProblem, pose_problem
from .rim_moves import NodePlaces, find_node_areas, weigh_moves
from .gap_strip import (
    Rim, Strip, Triangulate, build_strip, cut_rim, find_below, find_nearest_edges, mark)

ReadView = Callable[[np.ndarray], View]  # of what has its middle at a point (3, world space)

FACING = 0.2  # least cosine between view and normal of the triangles at a rim that moves
ALIKE = 2.0 * np.cos(0.5 * np.radians(15.0))  # length of the sum of normals that are tilted by less than that


@dataclass(frozen=True)
class Side:
    """A panel as it lies beside others."""
    patch: Patch
    xy: np.ndarray       # #V x 2, image plane
    outline: np.ndarray  # #O x 2: edges of one triangle alone
    border: np.ndarray   # #B x 2: those of them that no image is joined at
    normal: np.ndarray   # #V x 3
    movable: np.ndarray  # #V, bool: vertices of the border that may follow what lies across


@dataclass(frozen=True)
class Edges:
    """The edges of borders, by both ends."""
    xy: np.ndarray       # #E x 2 x 2
    V: np.ndarray        # #E x 2 x 3
    normal: np.ndarray   # #E x 2 x 3
    movable: np.ndarray  # #E x 2
    panel: np.ndarray    # #E: number of the panel


@dataclass(frozen=True)
class Facing:
    """The vertices where a panel faces others over a gap."""
    vertex: np.ndarray   # #R: vertices of its rim
    across: np.ndarray   # #R: the panel that lies there
    flush: np.ndarray    # #R: by how much that is higher along the view
    gap: float           # the widest between them


def are_alike(one: Patch, other: Patch) -> bool:
    """Returns whether two patches can be parts of the same joined one: a mesh and a cage have other unknowns."""
    if isinstance(one, CagePatch) or isinstance(other, CagePatch):
        return isinstance(one, CagePatch) and isinstance(other, CagePatch) and have_same_rules(one, other)
    return have_same_plane(one, other)


def join_panels(panels: Sequence[Patch], read_view: ReadView, border: str, triangulate: Triangulate) -> list[Patch]:
    """Returns the patches to solve for: one for panels that face each other where the border follows, and those that do
    not as they are. The order of the panels does not matter.
    """
    left = sorted((each for each in panels if can_join(each)), key=lambda each: each.name)
    joined = []
    while left:
        alike = [each for each in left if are_alike(left[0], each)]
        met = {each.name for each in find_meeting(left[0], alike)}
        joined.append(join_able([each for each in left if each.name in met], read_view, border, triangulate))
        left = [each for each in left if each.name not in met]
    found = [each for each in joined if each is not None]
    taken = {panel.name for each in found for panel in each.panels}
    return [*found, *(each for each in panels if each.name not in taken)]


def join_able(panels: list[Patch], read_view: ReadView, border: str,
              triangulate: Triangulate) -> JoinedPatch | None:
    """Joins panels; None where none of them face each other."""
    if len(panels) < 2 or len({each.creases.rule for each in panels}) > 1:
        return None
    try:
        view = read_view(find_middle(panels))
        frame = native.reflines.image_plane(view.view_direction, view.line_direction)
        surfaces = [build_surface(each, choose_level(panels), view, border) for each in panels
                    ] if isinstance(panels[0], CagePatch) else None
    except (native.InvalidInput, Refusal):  # the solve of each panel by itself tells what is wrong
        return None
    sides = [build_side(each, frame, border)
             for each in (panels if surfaces is None else [surface.patch for surface in surfaces])]
    facings = [find_facing(sides, which, frame[2]) for which in range(len(sides))]
    meeting = [which for which, each in enumerate(facings) if len(each.vertex)]
    rims = [cut_rim(side.xy, side.patch.F, side.border, facing.vertex, side.outline)
            for side, facing in zip(sides, facings, strict=True)] if len(meeting) == len(panels) else []
    strip = build_strip(rims, max(each.gap for each in facings), triangulate) if rims else None
    left = meeting if not rims else sorted(strip.meeting) if strip is not None else []
    if len(left) < len(panels):
        return join_able([panels[which] for which in left], read_view, border, triangulate)
    raised = find_steps(facings, len(panels))[:, None] * frame[2]
    if surfaces is not None:
        gap = max(facing.gap for facing in facings)
        return put_cages_together(panels, surfaces, rims, strip, raised, view, gap)
    return put_together(panels, rims, strip, raised, view, frame, border)


def build_side(patch: Patch, frame: np.ndarray, border: str) -> Side:
    outline = list_border(patch.F)
    edges = outline[~find_seam(patch)[outline].all(axis=1)]
    movable = find_movable(patch, edges, frame[2], border)
    return Side(patch, patch.V @ frame[:2].T, outline, edges, compute_normals(patch), movable)


def find_facing(sides: list[Side], which: int, towards: np.ndarray) -> Facing:
    """Finds where a panel's border faces others and can follow them: where the nearest place of their borders lies
    within a gap, at about the same height, is tilted alike, and can follow, too.
    """
    own, gap = sides[which], native.reflines.AUTOMATIC_GAP * max(each.patch.diagonal for each in sides)
    others = list_rims([side for side in sides if side is not own])
    vertex = np.flatnonzero(own.movable)
    nearest, fraction, distance = find_nearest_edges(others.xy, own.xy[vertex], gap)
    within = nearest >= 0
    vertex, nearest, fraction, distance = vertex[within], nearest[within], fraction[within], distance[within]
    weight = np.stack([1.0 - fraction, fraction], axis=1)[:, :, None]
    normal = (weight * others.normal[nearest]).sum(axis=1)
    mean = own.normal[vertex] + normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    way = (weight * others.V[nearest]).sum(axis=1) - own.patch.V[vertex]
    flush = (way * mean).sum(axis=1) / np.maximum(mean @ towards, FACING)
    faces = ((np.linalg.norm(mean, axis=1) >= ALIKE) & (np.abs(flush) <= gap) & others.movable[nearest].all(axis=1))
    numbers = np.array([number for number, side in enumerate(sides) if side is not own])
    return Facing(vertex[faces], numbers[others.panel[nearest[faces]]], flush[faces],
                  float(distance[faces].max(initial=0.0)))


def list_rims(sides: list[Side]) -> Edges:
    """Returns the edges of the borders of panels."""
    columns = ([side.xy[side.border] for side in sides], [side.patch.V[side.border] for side in sides],
               [side.normal[side.border] for side in sides], [side.movable[side.border] for side in sides],
               [np.full(len(side.border), number) for number, side in enumerate(sides)])
    return Edges(*(np.concatenate(column) for column in columns))


def find_movable(patch: Patch, edges: np.ndarray, towards: np.ndarray, border: str) -> np.ndarray:
    """Finds the vertices of the mesh's border (#V, bool) that may follow what lies across: no other faces are joined
    there, and all triangles are seen.
    """
    result = mark(len(patch.V), edges)
    joined = patch.around.F.ravel()
    result[joined[joined < len(patch.V)]] = False
    a, b, c = (patch.V[patch.F[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    upright = normal @ towards / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    result[patch.F[upright < FACING]] = False
    return result & (np.where(patch.border == UNSET, CODES[border], patch.border) == CODES["follow"])


def compute_normals(patch: Patch) -> np.ndarray:
    """Returns the normals at the vertices: #V x 3."""
    result = compute_area_normals(patch.V, patch.F)
    return result / np.maximum(np.linalg.norm(result, axis=1, keepdims=True), 1e-300)


def find_steps(facings: list[Facing], count: int) -> np.ndarray:
    """Returns by how much each panel is raised along the view so that the mean steps at the gaps go: #panels."""
    rows, steps = [], []
    for which, facing in enumerate(facings):
        for other in np.unique(facing.across):
            row = np.zeros(count)
            row[which], row[other] = 1.0, -1.0
            rows.append(row)
            steps.append(facing.flush[facing.across == other].mean())
    return np.linalg.lstsq(np.array(rows), np.array(steps), rcond=None)[0]


def put_together(panels: list[Patch], rims: list[Rim], strip: Strip, raised: np.ndarray, view: View,
                 frame: np.ndarray, border: str) -> JoinedPatch:
    """Builds the joined patch, whose triangles are those of the panels without their rims, and those of the strip."""
    vertex, count = [], 0
    for rim in rims:
        used = rim.is_used()
        vertex.append(np.where(used, count + np.cumsum(used) - 1, -1))
        count += int(used.sum())
    between = np.array([[vertex[which][v] for which, v in row] for row in strip.corners])
    F = np.concatenate([*(number[rim.F[rim.stays]] for number, rim in zip(vertex, rims, strict=True)), between])
    V = np.concatenate([(panel.V + rise)[own >= 0] for panel, rise, own in zip(panels, raised, vertex, strict=True)])
    xy = np.concatenate([rim.xy[own >= 0] for rim, own in zip(rims, vertex, strict=True)])
    codes = np.concatenate([panel.border[own >= 0] for panel, own in zip(panels, vertex, strict=True)])
    codes[find_new_ends(F, vertex, rims)] = CODES["clamped"]
    starts = [0, *accumulate(int(rim.stays.sum()) for rim in rims)]
    faces, face_of_triangle = number_faces(panels, rims, len(F) - starts[-1])
    plane = join_mirrors(panels, vertex, count)
    matrix = np.eye(4) if plane is None else panels[0].matrix
    patch = JoinedPatch(
        " and ".join(each.name for each in panels), faces, np.arange(len(V)), panels[0].to_local(V) if plane else V, V,
        F, face_of_triangle, matrix, "", plane, join_creases(panels, vertex), codes,
        join_around(panels, vertex, raised, count), join_ranges(panels, vertex), parts=(),
        towards=view.view_direction / np.linalg.norm(view.view_direction))
    problem = pose_problem(patch, view)
    place, below = place_nodes(problem, xy, starts[-1], strip.span, frame)
    return replace(patch, parts=tuple(
        PanelPart(panel, own, find_triangles(rim, start),
                  weigh_moves(place, rim.xy, find_moved(panel, rim, below, border, holds_seam=not problem.is_joined)))
        for panel, rim, own, start in zip(panels, rims, vertex, starts[:-1], strict=True)))


def place_nodes(problem: PanelProblem, xy: np.ndarray, first: int, span: float,
                frame: np.ndarray) -> tuple[NodePlaces, np.ndarray]:
    """Places the vertices of the joined patch in the image plane, with those of its image where that is solved with it;
    returns the corners of the strip's triangles, which begin with `first`, too: #T x 3 x 2.
    """
    own, F = len(problem.patch.F), problem.F
    both = np.concatenate([xy, problem.V[len(xy):] @ frame[:2].T])
    strip = np.concatenate([F[first:own], F[own + first:]])
    return NodePlaces(both, find_node_areas(both, F), span, problem.source), both[strip]


def find_new_ends(F: np.ndarray, vertex: list[np.ndarray], rims: list[Rim]) -> np.ndarray:
    """Finds the vertices (of the joined patch) that were inside a panel and are at the border now, where the strip ends
    before the rim does.
    """
    outer = np.concatenate([own[rim.outline.ravel()] for own, rim in zip(vertex, rims, strict=True)])
    return np.setdiff1d(list_border(F), outer)


def find_moved(panel: Patch, rim: Rim, strip: np.ndarray, border: str, *, holds_seam: bool) -> np.ndarray:
    """Finds the vertices (of the panel) without a place in the joined patch that move: those below the strip (#T x 3 x
    2) that follow. So what lies across from them moves, too. A seam that is held is clamped.
    """
    gone = np.flatnonzero(~rim.is_used() & ~(find_seam_rows(panel) & holds_seam))
    codes = np.where(panel.border == UNSET, CODES[border], panel.border)[gone]
    gone = gone[(codes == CODES["follow"]) | (codes == CODES["free"])]
    return gone[find_below(strip, rim.xy[gone])]


def find_triangles(rim: Rim, start: int) -> np.ndarray:
    """Returns for each triangle of a panel that of the joined patch, or the nearest one of the panel."""
    result = np.where(rim.stays, start + np.cumsum(rim.stays) - 1, -1)
    beside = np.flatnonzero(rim.stays & mark(len(rim.xy), rim.edges)[rim.F].any(axis=1))
    centre = rim.xy[rim.F].mean(axis=1)
    for gone in np.flatnonzero(~rim.stays):
        result[gone] = result[beside[((centre[beside] - centre[gone])**2).sum(axis=1).argmin()]]
    return result


def number_faces(panels: list[Patch], rims: list[Rim], between: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the faces of all panels (bool), and the face of each triangle; each of the strip's is one of its own."""
    numbers, first = [], 0
    for panel, rim in zip(panels, rims, strict=True):
        numbers.append(first + panel.face_of_triangle[rim.stays])
        first += len(panel.faces)
    return np.concatenate([panel.faces for panel in panels]), np.concatenate([*numbers, first + np.arange(between)])


def join_around(panels: list[Patch], vertex: list[np.ndarray], raised: np.ndarray, count: int) -> Surroundings:
    """Returns the surroundings of all panels."""
    V, F, first = [], [], count
    for panel, own, rise in zip(panels, vertex, raised, strict=True):
        number = np.concatenate([own, first + np.arange(len(panel.around.V))])
        triangles = number[panel.around.F]
        F.append(triangles[(triangles >= 0).all(axis=1)])
        V.append(panel.around.V + rise)
        first += len(panel.around.V)
    return Surroundings(np.concatenate(V), np.concatenate(F))
