"""Reads the cage of an object whose last modifier is Subdivision Surface: the mesh that the artist edits and that is
solved for.
"""
import bpy
import numpy as np

from ..blender import compat
from ..model import cage
from ..model.cage import Cage, CagePatch
from ..model.mesh_snapshot import Connectivity, MeshSnapshot
from ..model.patch import Patch
from ..model.refusal import Refusal
from . import modifiers

# Levels the surface is sampled at. Shapes differ from those solved at 4 by 1.9 % of the move at 3 and 8.5 % at 2 when a
# noisy cage is smoothed, by 0.3 % and 1.4 % when a clean one gets denser lines; at 1 by 29 % and 3.4 %.
FINEST, COARSEST = 3, 2


def build_cage_patch(ob: bpy.types.Object, snapshot: MeshSnapshot, patch: Patch) -> CagePatch:
    """Builds the patch of a cage from that of its mesh; refuses modifiers that are not followed."""
    *below, modifier = modifiers.find_cage_modifiers(ob)
    mirror = find_followed_mirror(ob.name, below)
    if modifier.subdivision_type != 'CATMULL_CLARK':
        raise Refusal(f"{ob.name} is subdivided without smoothing (Simple): "
                      "choose Catmull-Clark, or solve for the mesh")
    own = read_cage(ob.data, snapshot.mesh, patch.faces, patch.matrix, modifier, mirror, snapshot.local)
    axis = find_axis(mirror)
    if mirror is None and patch.mirror is not None and patch.mirror.is_whole:  # symmetric in itself
        own.partner[patch.index], axis = patch.index[patch.mirror.partner], patch.mirror.axis
    return CagePatch(**vars(patch), cage=own, mirror_axis=axis)


def find_axis(mirror: bpy.types.MirrorModifier | None) -> int:
    """Returns the axis that a Mirror modifier with one mirrors along; -1 without one."""
    return -1 if mirror is None else next(k for k in range(3) if mirror.use_axis[k])


def find_followed_mirror(name: str, below: list[bpy.types.Modifier]) -> bpy.types.MirrorModifier | None:
    """Returns the Mirror modifier below the subdivision, None where there is none; refuses modifiers that are not
    followed.
    """
    for modifier in below:
        plain = modifier.type == 'MIRROR' and sum(modifier.use_axis) == 1 and modifier.mirror_object is None \
            and not any(modifier.use_bisect_axis)
        if not plain or len(below) > 1:
            raise Refusal(f"{name} has the modifier {modifier.name} below its subdivision; only a Mirror about one of "
                          "the object's own axes is followed: apply or hide it, or solve for the mesh")
    return below[0] if below else None


def read_cage(mesh: bpy.types.Mesh, faces: Connectivity, region: np.ndarray, matrix: np.ndarray,
              modifier: bpy.types.SubsurfModifier, mirror: bpy.types.MirrorModifier | None, local: np.ndarray) -> Cage:
    """Reads the mesh as a cage. `local` is #vertices x 3 in object space, `matrix` (4 x 4) takes it to the cage's
    space.
    """
    corners, sizes = faces.corners, faces.sizes
    creases = faces.creases if modifier.use_creases else np.zeros(len(faces.creases))
    points = compat.read_vertex_creases(mesh) if modifier.use_creases else np.zeros(len(mesh.vertices))
    edges = faces.edges[creases > 0.0]
    image = np.arange(len(local))
    partner = np.full(len(local), -1)
    if mirror is not None:
        merge = mirror.merge_threshold if mirror.use_mirror_merge else -1.0
        local, image, partner = cage.mirror_cage(local, find_axis(mirror), merge)
        corners = np.concatenate([corners, cage.reverse_faces(image[corners], sizes)])
        sizes, region = np.tile(sizes, 2), np.tile(region, 2)
        edges = np.concatenate([edges, image[edges]])
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        corners = cage.reverse_faces(corners, sizes)
    edges, first = np.unique(np.sort(edges, axis=1), axis=0, return_index=True)
    sharpness = np.tile(10.0 * creases[creases > 0.0] ** 2, 2)[first]
    sharp = np.flatnonzero(points)
    sharp_corners, own = np.unique(np.concatenate([sharp, image[sharp]]), return_index=True)
    rules = (("level", min(max(modifier.levels, COARSEST), FINEST)), ("limit", modifier.use_limit_surface),
             ("boundary", modifier.boundary_smooth.lower()))
    return Cage(local @ matrix[:3, :3].T + matrix[:3, 3], sizes, corners, region, edges, sharpness,
                sharp_corners, 10.0 * np.tile(points[sharp], 2)[own] ** 2, partner, len(mesh.polygons), rules)
