"""The cage of an object whose last modifier is Subdivision Surface: what the artist edits, and what is solved for."""
from dataclasses import dataclass

import bpy
import numpy as np

from . import gather, modifiers, versions
from .gather import Panel
from .refusal import Refusal

# Levels the surface is sampled at. Shapes differ from those solved at 4 by 1.9 % of the move at 3 and 8.5 % at 2 when a
# noisy cage is smoothed, by 0.3 % and 1.4 % when a clean one gets denser lines; at 1 by 29 % and 3.4 %.
FINEST, COARSEST = 3, 2
IN_PLANE = 1e-6          # of a unit view direction


@dataclass(frozen=True)
class Cage:
    """The mesh as the modifier takes it, in world space; with a Mirror the other half follows behind the mesh's own."""
    V: np.ndarray          # #V x 3
    sizes: np.ndarray      # #faces: corners of each
    corners: np.ndarray    # all corners, counter-clockwise seen from outside
    region: np.ndarray     # #faces, bool
    creases: np.ndarray    # #C x 2
    sharpness: np.ndarray  # #C
    sharp_corners: np.ndarray      # #K
    corner_sharpness: np.ndarray   # #K
    partner: np.ndarray    # #V: mirror images, -1 where there is none
    own_faces: int         # how many of the faces are the mesh's
    rules: tuple[tuple[str, object], ...]  # of the modifier, as reflines.CageOptimizer names them

    def same(self, other: "Cage") -> bool:
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in vars(self))

    def arguments(self, symmetric: bool) -> dict[str, object]:
        """For reflines.CageOptimizer. Where moves leave the plane of the mirror only the mesh's own half is solved: its
        seam is a border then, across which the surface stays smooth."""
        region = self.region & (symmetric | (np.arange(len(self.region)) < self.own_faces))
        offsets = np.append(0, np.cumsum(self.sizes))
        return dict(self.rules, V=self.V, face_offsets=offsets, face_vertices=self.corners, region=region,
                    creases=self.creases, crease_sharpness=self.sharpness, corners=self.sharp_corners,
                    corner_sharpness=self.corner_sharpness, partner=self.partner if symmetric else None)


@dataclass(frozen=True)
class CagePanel(Panel):
    """The region of the cage, and all of the cage around it."""
    cage: Cage
    mirror_axis: int  # of the object, -1: none

    def same(self, other: Panel) -> bool:
        return isinstance(other, CagePanel) and self.cage.same(other.cage) and super().same(other)

    def is_symmetric_for(self, view_direction: np.ndarray) -> bool:
        along = np.linalg.solve(self.matrix[:3, :3], view_direction)
        return self.mirror_axis >= 0 and abs(along[self.mirror_axis]) <= IN_PLANE * np.linalg.norm(along)


def gather_cage(ob: bpy.types.Object, local: np.ndarray | None = None, key: str = "", *,
                or_all: bool = False) -> CagePanel:
    """As gather.gather."""
    panel = gather.gather(ob, local, key, or_all=or_all)
    local = gather.coordinates(ob, key) if local is None else local
    *below, modifier = modifiers.shaping(ob)
    mirror = mirror_of(ob.name, below)
    if modifier.subdivision_type != 'CATMULL_CLARK':
        raise Refusal(f"{ob.name} is subdivided without smoothing (Simple): "
                      "choose Catmull-Clark, or solve for the mesh")
    axis = -1 if mirror is None else next(k for k in range(3) if mirror.use_axis[k])
    own = read(ob.data, panel.faces, panel.matrix, modifier, mirror, axis, local)
    if mirror is None and panel.mirror is not None and panel.mirror.is_whole:  # symmetric in itself
        own.partner[panel.index], axis = panel.index[panel.mirror.partner], panel.mirror.axis
    return CagePanel(**vars(panel), cage=own, mirror_axis=axis)


def mirror_of(name: str, below: list[bpy.types.Modifier]) -> bpy.types.MirrorModifier | None:
    for modifier in below:
        plain = modifier.type == 'MIRROR' and sum(modifier.use_axis) == 1 and modifier.mirror_object is None \
            and not any(modifier.use_bisect_axis)
        if not plain or len(below) > 1:
            raise Refusal(f"{name} has the modifier {modifier.name} below its subdivision; only a Mirror about one of "
                          "the object's own axes is followed: apply or hide it, or solve for the mesh")
    return below[0] if below else None


def read(mesh: bpy.types.Mesh, region: np.ndarray, matrix: np.ndarray, modifier: bpy.types.SubsurfModifier,
         mirror: bpy.types.MirrorModifier | None, axis: int, local: np.ndarray) -> Cage:
    """`local`: #vertices x 3, object space; `matrix` takes them to the cage's space."""
    corners, sizes = gather.corners(mesh)
    creases = versions.edge_creases(mesh) if modifier.use_creases else np.zeros(len(mesh.edges))
    points = versions.vertex_creases(mesh) if modifier.use_creases else np.zeros(len(mesh.vertices))
    edges = np.empty(2 * len(mesh.edges), dtype=np.int32)
    mesh.edges.foreach_get("vertices", edges)
    edges = edges.reshape(-1, 2)[creases > 0.0]
    image = np.arange(len(local))
    partner = np.full(len(local), -1)
    if mirror is not None:
        local, image, partner = mirrored(local, axis, mirror.merge_threshold if mirror.use_mirror_merge else -1.0)
        corners = np.concatenate([corners, turned(image[corners], sizes)])
        sizes, region = np.tile(sizes, 2), np.tile(region, 2)
        edges = np.concatenate([edges, image[edges]])
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        corners = turned(corners, sizes)
    edges, first = np.unique(np.sort(edges, axis=1), axis=0, return_index=True)
    sharpness = np.tile(10.0 * creases[creases > 0.0] ** 2, 2)[first]
    sharp = np.flatnonzero(points)
    sharp_corners, own = np.unique(np.concatenate([sharp, image[sharp]]), return_index=True)
    rules = (("level", min(max(modifier.levels, COARSEST), FINEST)), ("limit", modifier.use_limit_surface),
             ("boundary", modifier.boundary_smooth.lower()))
    return Cage(local @ matrix[:3, :3].T + matrix[:3, 3], sizes, corners, region, edges, sharpness,
                sharp_corners, 10.0 * np.tile(points[sharp], 2)[own] ** 2, partner, len(mesh.polygons), rules)


def mirrored(local: np.ndarray, axis: int, merge: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Both halves' positions, the image of each vertex of the first, and partners in both. As the modifier merges."""
    seam = 2.0 * np.abs(local[:, axis]) <= merge
    sign = np.where(np.arange(3) == axis, -1.0, 1.0)
    own = np.where(seam[:, None] & (sign < 0.0), 0.0, local)
    image = np.where(seam, np.arange(len(local)), len(local) + np.cumsum(~seam) - 1)
    both = np.concatenate([own, own[~seam] * sign])
    partner = np.empty(len(both), dtype=np.int64)
    partner[:len(local)], partner[image] = image, np.arange(len(local))
    return both, image, partner


def turned(corners: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Every face's corners the other way round."""
    starts = np.repeat(np.cumsum(sizes) - sizes, sizes)
    ends = starts + np.repeat(sizes, sizes) - 1
    return corners[starts + ends - np.arange(len(corners))]
