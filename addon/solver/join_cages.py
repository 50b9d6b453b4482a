"""Joins cages whose surfaces meet over gaps to one cage, see model/joined_cage.py."""
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..model.border import CODES, UNSET
from ..model.cage import Cage, CagePatch
from ..model.creases import Creases
from ..model.joined_cage import Bridge, JoinedCagePatch, RimLevel
from ..model.joined_patch import NO_RIM, PanelPart, join_creases, join_ranges
from ..model.line_surface import cross
from ..model.patch import Patch
from ..model.surroundings import NOTHING_AROUND, Surroundings
from ..model.view import View
from .gap_strip import Rim, Strip, find_nearest_edges, mark
from .joint_mirror import have_same_plane

FOLLOWS = 0.99  # of the cage's vertices, by their weights, that a vertex of the surface which follows depends on


@dataclass(frozen=True)
class Quads:
    """The faces of a subdivided region, in the order and with the vertices of the native module's CageOptimizer."""
    faces: np.ndarray    # #Q x 4
    parent: np.ndarray   # #Q: the cage's face
    refined: np.ndarray  # #V: which of the refined vertices each is; the first of these are those of the cage
    beside: np.ndarray   # those of the vertices that are in faces outside the region, too


@dataclass(frozen=True)
class Surface:
    """The surface of a cage's region, cut into triangles as the native module does."""
    patch: Patch          # that stands for it where panels are joined
    quads: Quads
    matrix: tuple[np.ndarray, np.ndarray, np.ndarray]  # of the subdivision, see reflines.Subdivision.matrix
    number: np.ndarray    # #cage V: of the panel's vertices that move each, -1 of others

    def read_weights(self, vertices: np.ndarray) -> np.ndarray:
        """Returns the weights of the panel's vertices in some of the surface's: #vertices x #V of the panel."""
        data, column, first = self.matrix
        result = np.zeros((len(vertices), int(self.number.max()) + 1))
        for row, v in enumerate(self.quads.refined[vertices]):
            own = slice(first[v], first[v + 1])
            number = self.number[column[own]]
            np.add.at(result[row], number[number >= 0], data[own][number >= 0])
        return result


def have_same_rules(one: CagePatch, other: CagePatch) -> bool:
    """Returns whether two cages are subdivided by the same rules but for the level, and mirrored alike."""
    rules, others = dict(one.cage.rules), dict(other.cage.rules)
    return (all(rules[name] == others[name] for name in ("limit", "boundary"))
            and one.mirror_axis == other.mirror_axis and have_same_plane(one, other))


def choose_level(panels: Sequence[CagePatch]) -> int:
    return max(dict(panel.cage.rules)["level"] for panel in panels)


def list_quads(cage: Cage, whole: "native.Subdivision", *, symmetric: bool) -> Quads:
    """Lists the faces of a cage's subdivided region, which has both halves of a symmetric one."""
    inside = cage.build_arguments(symmetric)["region"][whole.face_parent]
    quads = whole.faces[inside]
    every, first = np.unique(quads.ravel(), return_index=True)
    refined = every[np.argsort(first)]
    number = np.full(int(whole.faces.max()) + 1, -1)
    number[refined] = np.arange(len(refined))
    beside = number[np.unique(whole.faces[~inside])]
    return Quads(number[quads], whole.face_parent[inside], refined, beside[beside >= 0])


def build_surface(patch: CagePatch, level: int, view: View, border: str) -> Surface:
    """Builds the surface of a cage at a level of subdivision; raises the native module's errors."""
    # Together with the image that a Mirror modifier adds, where it is solved so.
    cage, symmetric = patch.cage, patch.is_symmetric_for(view.view_direction)
    whole = native.reflines.Subdivision(**{**cage.build_topology_arguments(), "level": level}, vertices=len(cage.V))
    quads = list_quads(cage, whole, symmetric=symmetric)
    V, F = whole.positions(cage.V)[quads.refined], quads.faces[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    follows = find_following(patch, border)
    depends = whole.positions(np.repeat(follows[:, None].astype(float), 3, axis=1))[quads.refined, 0]
    codes = np.where(depends > FOLLOWS, CODES["follow"], CODES["clamped"])
    joined = Surroundings(np.zeros((0, 3)), np.repeat(quads.beside[:, None], 3, axis=1))  # names only where
    panel = Patch(patch.name, np.ones(len(F), dtype=bool), np.arange(len(V)), V, V, F, np.arange(len(F)), np.eye(4), "",
                  None, Creases(patch.creases.rule, np.zeros((0, 2), dtype=np.int64)), codes,
                  joined, None)
    own = np.full(len(cage.V), -1)
    own[patch.index] = np.arange(len(patch.index))
    if symmetric:
        image = cage.partner[patch.index]
        own[image[image >= 0]] = np.flatnonzero(image >= 0)
    return Surface(panel, quads, whole.matrix(), own)


def find_following(patch: CagePatch, border: str) -> np.ndarray:
    """Returns which of the cage's vertices may follow what lies across: #cage V, bool."""
    result = np.ones(len(patch.cage.V), dtype=bool)
    own = np.where(patch.border == UNSET, CODES[border], patch.border) == CODES["follow"]
    result[patch.index], image = own, patch.cage.partner[patch.index]
    result[image[image >= 0]] = own[image >= 0]
    return result


def put_cages_together(panels: Sequence[CagePatch], surfaces: Sequence[Surface], rims: Sequence[Rim], strip: Strip,
                       raised: np.ndarray, view: View, gap: float) -> JoinedCagePatch:
    """Builds the joined patch: the cages beside each other, with a bridge between their surfaces; rims that are no
    further apart than the gap face each other.
    """
    cage = join_cages([replace(panel.cage, V=panel.cage.V + rise) for panel, rise in zip(panels, raised, strict=True)],
                      choose_level(panels))
    cage_starts = find_starts([len(panel.cage.V) for panel in panels])
    face_starts = find_starts([panel.cage.own_faces for panel in panels])
    starts, F_starts = find_starts([len(panel.V) for panel in panels]), find_starts([len(panel.F) for panel in panels])
    vertex = [start + np.arange(len(panel.V)) for panel, start in zip(panels, starts, strict=True)]
    parts = tuple(PanelPart(panel, own, start + np.arange(len(panel.F)), NO_RIM)
                  for panel, own, start in zip(panels, vertex, F_starts, strict=True))
    index = np.concatenate([panel.index + start for panel, start in zip(panels, cage_starts, strict=True)])
    free = [find_free_rim(surface, rim) for surface, rim in zip(surfaces, rims, strict=True)]
    codes = np.concatenate([np.where(mark(len(panel.V), own), CODES["free"], panel.border)
                            for panel, own in zip(panels, free, strict=True)])
    V = np.concatenate([panel.V + rise for panel, rise in zip(panels, raised, strict=True)])
    first, towards = panels[0], view.view_direction / np.linalg.norm(view.view_direction)
    return JoinedCagePatch(
        " and ".join(panel.name for panel in panels), np.concatenate([panel.faces for panel in panels]), index,
        first.to_local(V), V,
        np.concatenate([panel.F + start for panel, start in zip(panels, starts, strict=True)]),
        np.concatenate([panel.face_of_triangle + start for panel, start in zip(panels, face_starts, strict=True)]),
        first.matrix, "", None, join_creases(panels, vertex), codes, NOTHING_AROUND, join_ranges(panels, vertex), cage,
        first.mirror_axis, parts=parts,
        bridge=build_bridge([panel.cage for panel in panels], surfaces, rims, strip),
        rim=level_rims(surfaces, rims, free, starts, gap), towards=towards)


def find_starts(counts: Sequence[int]) -> list[int]:
    return np.cumsum([0, *counts])[:-1].tolist()


def join_cages(cages: Sequence[Cage], level: int) -> Cage:
    """Returns one cage that is made of several, without a common vertex: first the own faces of all, then those of
    their images.
    """
    vertices = find_starts([len(each.V) for each in cages])

    def join(name: str) -> np.ndarray:
        return np.concatenate([getattr(each, name) for each in cages])

    def join_numbers(name: str) -> np.ndarray:
        return np.concatenate([np.where(getattr(each, name) < 0, -1, getattr(each, name) + start)
                               for each, start in zip(cages, vertices, strict=True)])

    def join_faces(values: list[np.ndarray], own: list[int]) -> np.ndarray:
        every = list(zip(values, own, strict=True))
        return np.concatenate([*(each[:count] for each, count in every), *(each[count:] for each, count in every)])

    rules = tuple((name, level if name == "level" else value) for name, value in cages[0].rules)
    faces = [each.own_faces for each in cages]
    corners = [each.corners + start for each, start in zip(cages, vertices, strict=True)]
    own_corners = [int(each.sizes[:each.own_faces].sum()) for each in cages]
    return Cage(join("V"), join_faces([each.sizes for each in cages], faces), join_faces(corners, own_corners),
                join_faces([each.region for each in cages], faces), join_numbers("creases"), join("sharpness"),
                join_numbers("sharp_corners"), join("corner_sharpness"), join_numbers("partner"), sum(faces), rules)


def find_free_rim(surface: Surface, rim: Rim) -> np.ndarray:
    """Finds the panel's vertices that face others over a gap, and whose neighbours on the surface's rim do, too."""
    faces = mark(len(rim.xy), rim.vertex)
    inner = faces.copy()
    inner[rim.outline[~faces[rim.outline].all(axis=1)]] = False
    found = surface.quads.refined[inner]
    return np.unique(surface.number[found[found < len(surface.number)]])


def level_rims(surfaces: Sequence[Surface], rims: Sequence[Rim], free: Sequence[np.ndarray], starts: Sequence[int],
               gap: float) -> RimLevel:
    """Returns how the free vertices move further so that both rims of a gap move alike: each takes half of what the
    other has moved more, by least squares over the rim of its surface.
    """
    near = [find_near_rim(surface, rim) for surface, rim in zip(surfaces, rims, strict=True)]
    surfaces = [keep_numbers(surface, own) for surface, own in zip(surfaces, near, strict=True)]
    columns = [start + np.arange(len(own)) for own, start in zip(near, find_starts([len(own) for own in near]),
                                                                 strict=True)]
    weight = []
    for which, (surface, rim, own) in enumerate(zip(surfaces, rims, free, strict=True)):
        weights = surface.read_weights(rim.vertex)
        more = np.zeros((len(rim.vertex), sum(map(len, near))))
        more[:, columns[which]] = -weights
        faces = np.zeros(len(rim.vertex), dtype=bool)
        for other in (k for k in range(len(surfaces)) if k != which):
            added, found = read_across(surfaces[other], rims[other], rim.xy[rim.vertex], gap)
            more[np.ix_(found & ~faces, columns[other])] += added[found & ~faces]
            faces |= found
        inverse = np.linalg.pinv(weights[faces][:, np.searchsorted(near[which], own)], rcond=1e-6)
        weight.append(0.5 * inverse @ more[faces])
    return RimLevel(*(np.concatenate([own + start for own, start in zip(each, starts, strict=True)])
                      for each in (free, near)), np.concatenate(weight))


def find_near_rim(surface: Surface, rim: Rim) -> np.ndarray:
    """Finds the panel's vertices that the surface depends on in the triangles at the rim, ascending."""
    _, column, first = surface.matrix
    corners = surface.quads.refined[np.unique(rim.F[~rim.stays])]
    found = np.concatenate([surface.number[column[first[v]:first[v + 1]]] for v in corners])
    return np.unique(found[found >= 0])


def keep_numbers(surface: Surface, vertices: np.ndarray) -> Surface:
    """Returns a surface that knows only some of the panel's vertices, by their place among these."""
    number = np.full(int(surface.number.max()) + 2, -1)  # the last one for those that are none of the panel's
    number[vertices] = np.arange(len(vertices))
    return replace(surface, number=number[surface.number])


def read_across(surface: Surface, rim: Rim, points: np.ndarray, gap: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns the weights of a panel's vertices in its surface where its triangles at the rim, made larger, lie over or
    below points of the image plane (#P x #V), and which points are within the gap.
    """
    edges = rim.outline[mark(len(rim.xy), rim.vertex)[rim.outline].any(axis=1)]
    nearest, _, _ = find_nearest_edges(rim.xy[edges], points, gap)
    triangle = find_triangles_of(edges, rim.F)[nearest]
    corners = rim.F[triangle]
    a, b, c = (rim.xy[corners[:, k]] for k in range(3))
    area = cross(b - a, c - a)
    opposite = cross(b - points, c - points), cross(c - points, a - points), cross(a - points, b - points)
    return (sum((own / area)[:, None] * surface.read_weights(corners[:, k]) for k, own in enumerate(opposite)),
            nearest >= 0)


def find_triangles_of(edges: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Returns the triangle (of #F x 3) at each border edge (#E x 2, the lower vertex first)."""
    count = int(F.max()) + 1
    ends = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    keys = ends[:, 0] * count + ends[:, 1]
    order = np.argsort(keys, kind="stable")
    return order[np.searchsorted(keys[order], edges[:, 0] * count + edges[:, 1])] % len(F)


def build_bridge(cages: Sequence[Cage], surfaces: Sequence[Surface], rims: Sequence[Rim], strip: Strip) -> Bridge:
    """Builds the bridge from the strip, with each triangle counted as one of a face that it begins at. The faces of the
    joined cage's surface are those of the cages' own halves, and after them those of their images.
    """
    starts, face_starts = find_starts([len(rim.xy) for rim in rims]), find_starts([each.own_faces for each in cages])
    faces, parents, left_out = [], [], []
    for half in (0, 1):
        for cage, surface, rim, start, first in zip(cages, surfaces, rims, starts, face_starts, strict=True):
            quads = surface.quads
            chosen = quads.parent // cage.own_faces == half
            faces.append(quads.faces[chosen] + start)
            parents.append(quads.parent[chosen] % cage.own_faces + first)  # both halves count as one
            left_out.append(~rim.stays.reshape(-1, 2)[chosen])
    corners, parent = np.concatenate(faces).ravel(), np.repeat(np.concatenate(parents), 4)
    every, first_of = np.unique(corners, return_index=True)
    number, parent_of = np.zeros((2, len(every)), dtype=np.int64)
    number[np.argsort(first_of)] = np.arange(len(every))
    parent_of[:] = parent[first_of]
    ends = np.array([[starts[which] + v for which, v in row] for row in strip.corners])
    return Bridge(number[ends], parent_of[ends[:, 0]], np.concatenate(left_out).ravel())
