"""Joins panels that meet over gaps to one patch, see model/joined_patch.py."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate

import numpy as np

from .. import native
from ..model.beside import join_soups
from ..model.border import CODES, UNSET
from ..model.cage import CagePatch
from ..model.creases import Creases
from ..model.joined_patch import JoinedPatch, PanelPart
from ..model.patch import Patch
from ..model.surroundings import Surroundings
from ..model.view import View
from ..native_call import call
from .seam_moves import SeamPlace, find_node_areas, weigh_moves
from .seam_strip import Rim, Strip, Triangulate, build_strip, cut_rim, list_border, mark

FACING = 0.2  # least cosine between view and normal of the triangles at a rim that moves
HOLDING = [CODES["clamped"], CODES["curvature"], CODES["flow"], CODES["follow"]]


@dataclass(frozen=True)
class Facing:
    """Where a panel faces the others over a gap."""
    border: np.ndarray   # #B x 2: edges of one triangle alone
    vertex: np.ndarray   # #R: vertices of its rim
    flush: np.ndarray    # #R: by how much the others are higher along the view
    across: np.ndarray   # #R: the panel that lies there
    gap: float           # widest


def can_join(patch: Patch) -> bool:
    """Returns whether a patch can be a part of a joined one: cages have other unknowns, and a mirror image has its
    place in the problem of its panel.
    """
    return not isinstance(patch, CagePatch) and patch.mirror is None


async def join_panels(panels: Sequence[Patch], view: View, border: str,
                      triangulate: Triangulate) -> list[Patch]:
    """Returns the patches to solve for: one for all panels that face each other where the border follows, and those
    that do not as they are. The order of the panels does not matter.
    """
    able = sorted((each for each in panels if can_join(each)), key=lambda each: each.name)
    joined = await join_able(able, view, border, triangulate)
    taken = set() if joined is None else {each.name for each in joined.panels}
    return [*([] if joined is None else [joined]), *(each for each in panels if each.name not in taken)]


async def join_able(panels: list[Patch], view: View, border: str, triangulate: Triangulate) -> JoinedPatch | None:
    """Joins panels; None where none of them face each other."""
    if len(panels) < 2 or len({each.creases.rule for each in panels}) > 1:
        return None
    try:
        frame = native.reflines.image_plane(view.view_direction, view.line_direction)
        borders = [list_border(each.F) for each in panels]
        facings = [await find_facing(panels, borders, which, frame[2], border) for which in range(len(panels))]
    except native.InvalidInput:  # the solve of each panel by itself tells what is wrong
        return None
    meeting = [which for which, each in enumerate(facings) if len(each.vertex)]
    if len(meeting) < len(panels):
        return await join_able([panels[which] for which in meeting], view, border, triangulate)
    rims = [cut_rim(panel.V @ frame[:2].T, panel.F, facing.border, facing.vertex)
            for panel, facing in zip(panels, facings, strict=True)]
    strip = build_strip(rims, max(each.gap for each in facings), triangulate)
    if strip is None:
        return None
    lone = set(range(len(panels))) - set(strip.meeting)
    if lone:
        return await join_able([each for which, each in enumerate(panels) if which not in lone], view, border,
                               triangulate)
    return put_together(panels, rims, strip, find_steps(facings, len(panels))[:, None] * frame[2], border)


async def find_facing(panels: list[Patch], borders: list[np.ndarray], which: int, towards: np.ndarray,
                      border: str) -> Facing:
    """Finds where a panel's border faces the others and follows them."""
    own, others = panels[which], [k for k in range(len(panels)) if k != which]
    V, F = join_soups([(panels[k].V, panels[k].F) for k in others])
    found = await call(native.reflines.continue_over_gap, own.V, own.F, V, F, around=(own.around.V, own.around.F))
    rim = np.flatnonzero(found.followed & find_movable(own, borders[which], towards, border))
    upright = np.abs(compute_normals(own)[rim] @ towards)
    return Facing(borders[which], rim, found.flush[rim] / np.maximum(upright, FACING),
                  find_across(own.V[rim], [panels[k].V[np.unique(borders[k])] for k in others], others), found.gap)


def find_across(points: np.ndarray, rims: list[np.ndarray], numbers: list[int]) -> np.ndarray:
    """Returns for each point the number of the panel whose border lies nearest."""
    apart = [[((rim - point)**2).sum(axis=1).min() for rim in rims] for point in points]
    return np.array(numbers)[np.argmin(np.array(apart).reshape(-1, len(rims)), axis=1)]


def find_movable(patch: Patch, rim: np.ndarray, towards: np.ndarray, border: str) -> np.ndarray:
    """Finds the vertices of the mesh's border (#V, bool) that follow what lies across: no other faces are joined there,
    and all triangles are seen.
    """
    result = mark(len(patch.V), rim)
    result[patch.around.F[patch.around.F < len(patch.V)]] = False
    a, b, c = (patch.V[patch.F[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    unseen = normal @ towards < FACING * np.linalg.norm(normal, axis=1)
    result[patch.F[unseen]] = False
    return result & (np.where(patch.border == UNSET, CODES[border], patch.border) == CODES["follow"])


def compute_normals(patch: Patch) -> np.ndarray:
    """Returns the normals at the vertices: #V x 3."""
    a, b, c = (patch.V[patch.F[:, k]] for k in range(3))
    normal, result = np.cross(b - a, c - a), np.zeros(patch.V.shape)
    for k in range(3):
        np.add.at(result, patch.F[:, k], normal)
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


def put_together(panels: list[Patch], rims: list[Rim], strip: Strip, raised: np.ndarray, border: str) -> JoinedPatch:
    """Builds the joined patch, whose triangles are those of the panels without their rims, and those of the strip."""
    vertex, count = [], 0
    for rim in rims:
        used = rim.is_used()
        vertex.append(np.where(used, count + np.cumsum(used) - 1, -1))
        count += int(used.sum())
    F = np.concatenate([*(number[rim.F[rim.stays]] for number, rim in zip(vertex, rims, strict=True)),
                        np.array([[vertex[which][v] for which, v in row] for row in strip.corners])])
    V = np.concatenate([(panel.V + rise)[own >= 0] for panel, rise, own in zip(panels, raised, vertex, strict=True)])
    xy = np.concatenate([rim.xy[own >= 0] for rim, own in zip(rims, vertex, strict=True)])
    codes = np.concatenate([panel.border[own >= 0] for panel, own in zip(panels, vertex, strict=True)])
    codes[find_new_ends(F, vertex, rims)] = CODES["clamped"]
    place = SeamPlace(xy, find_node_areas(xy, F), strip.span)
    starts = [0, *accumulate(int(rim.stays.sum()) for rim in rims)]
    parts = []
    for panel, rim, own, start in zip(panels, rims, vertex, starts[:-1], strict=True):
        seam = weigh_moves(place, rim.xy, find_moved(panel, rim, border))
        parts.append(PanelPart(panel, own, find_triangles(rim, start), seam))
    faces, face_of_triangle = number_faces(panels, rims, len(F) - starts[-1])
    return JoinedPatch(
        " and ".join(each.name for each in panels), faces, np.arange(len(V)), V, V, F, face_of_triangle, np.eye(4), "",
        None, join_creases(panels, vertex), codes, join_around(panels, vertex, raised, count),
        join_ranges(panels, vertex), parts=tuple(parts))


def find_new_ends(F: np.ndarray, vertex: list[np.ndarray], rims: list[Rim]) -> np.ndarray:
    """Finds the vertices (of the joined patch) that were inside a panel and are at the border now, where the strip ends
    before the rim does.
    """
    outer = np.concatenate([own[rim.border.ravel()] for own, rim in zip(vertex, rims, strict=True)])
    return np.setdiff1d(list_border(F), outer)


def find_moved(panel: Patch, rim: Rim, border: str) -> np.ndarray:
    """Finds the vertices (of the panel) without a place in the joined patch that move: those that follow, but for ones
    beside a border that keeps its tangent, and those of a free border.
    """
    codes = np.where(panel.border == UNSET, CODES[border], panel.border)
    follows, outer = mark(len(panel.V), rim.vertex), mark(len(panel.V), rim.border)
    keeps = outer & ~follows & np.isin(codes, HOLDING)
    beside = mark(len(panel.V), panel.F[keeps[panel.F].any(axis=1)])
    gone = ~rim.is_used()
    return np.flatnonzero(gone & (follows & ~beside | ~follows & (codes == CODES["free"])))


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


def join_creases(panels: list[Patch], vertex: list[np.ndarray]) -> Creases:
    """Returns the marked edges of all panels but those that end at the gap."""
    marked = np.concatenate([own[panel.creases.marked] for panel, own in zip(panels, vertex, strict=True)])
    return Creases(panels[0].creases.rule, marked[(marked >= 0).all(axis=1)])


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


def join_ranges(panels: list[Patch], vertex: list[np.ndarray]) -> np.ndarray | None:
    """Returns the ranges of the limit of all vertices; None where all of them have all of it."""
    if all(panel.limit_range is None for panel in panels):
        return None
    whole = np.array([-1.0, 1.0])
    return np.concatenate([np.tile(whole, (int((own >= 0).sum()), 1)) if panel.limit_range is None
                           else panel.limit_range[own >= 0] for panel, own in zip(panels, vertex, strict=True)])
