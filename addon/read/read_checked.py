"""Reads what a check compares: the mesh, or the surface of its cage, before and after the last solve."""
from dataclasses import replace

import bpy
import numpy as np

from .. import native
from ..model.cage import CagePatch
from ..model.patch import Patch
from ..model.surface import CheckedSurface
from . import read_mesh


def read_checked_surface(ob: bpy.types.Object, patch: Patch, positions: np.ndarray) -> CheckedSurface:
    """Reads the surface with the patch as it was and at `positions` (#V x 3, world space), and all around it, from a
    mesh that was updated from Edit Mode, which gathering the patch does.
    """
    return build_cage_surface(patch, positions) if isinstance(patch, CagePatch) else read_mesh_surface(
        ob, patch, positions)


def follow_object(ob: bpy.types.Object, patch: Patch, positions: np.ndarray) -> tuple[Patch, np.ndarray, float]:
    """Takes a patch and its solved positions to where the object is now; returns with them the factor by which the
    object was scaled since along the move.
    """
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    if np.array_equal(matrix, patch.matrix):
        return patch, positions, 1.0
    change = matrix @ np.linalg.inv(patch.matrix)
    V, after = (points @ change[:3, :3].T + change[:3, 3] for points in (patch.V, positions))
    before, now = (float(np.linalg.norm(move, axis=1).max()) for move in (positions - patch.V, after - V))
    moved = replace(patch, matrix=matrix, V=V)
    if isinstance(moved, CagePatch):
        moved = replace(moved, cage=replace(moved.cage, V=moved.cage.V @ change[:3, :3].T + change[:3, 3]))
    return moved, after, now / before if before else 1.0


def read_mesh_surface(ob: bpy.types.Object, patch: Patch, positions: np.ndarray) -> CheckedSurface:
    F, face = read_mesh.read_triangles(ob.data)
    if np.linalg.det(patch.matrix[:3, :3]) < 0.0:
        F = F[:, ::-1]
    before = patch.to_world(read_mesh.read_coordinates(ob, patch.key))
    before[patch.index] = patch.V
    after = before.copy()
    after[patch.index] = positions
    creases = patch.creases.build_arguments()
    creases["marked_creases"] = patch.index[creases["marked_creases"]].reshape(-1, 2)
    return CheckedSurface(before, after, np.ascontiguousarray(F), patch.faces[face], creases)


def build_cage_surface(patch: CagePatch, positions: np.ndarray) -> CheckedSurface:
    """Subdivides the whole cage before and after; the image of a Mirror modifier follows the mesh's own half."""
    cage = patch.cage
    subdivision = native.reflines.Subdivision(**cage.build_topology_arguments(), vertices=len(cage.V))
    corners = [0, 1, 2, 0, 2, 3] if np.linalg.det(patch.matrix[:3, :3]) > 0.0 else [0, 2, 1, 0, 3, 2]
    F = subdivision.faces[:, corners].reshape(-1, 3)
    return CheckedSurface(subdivision.positions(cage.V), subdivision.positions(move_cage(patch, positions)), F,
                          np.repeat(cage.region[subdivision.face_parent], 2), patch.creases.build_cage_arguments())


def move_cage(patch: CagePatch, positions: np.ndarray) -> np.ndarray:
    """Returns the cage's vertices after a solve that moved the patch's to `positions`."""
    cage, move = patch.cage, positions - patch.V
    result = cage.V.copy()
    result[patch.index] += move
    image = cage.partner[patch.index]
    added = (image >= 0) & ~np.isin(image, patch.index)
    if added.any():
        linear = patch.matrix[:3, :3]
        mirror = linear @ np.diag(np.where(np.arange(3) == patch.mirror_axis, -1.0, 1.0)) @ np.linalg.inv(linear)
        result[image[added]] += move[added] @ mirror.T
    return result
