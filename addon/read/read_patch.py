"""Reads the region of a Blender mesh as a patch, in world space and double precision."""
from dataclasses import replace

import bpy
import numpy as np

from ..model import triangulation
from ..model.beside import Crossing
from ..model.mirror import Mirror
from ..model.patch import Patch, compute_bounds
from ..model.refusal import Refusal
from ..model.surroundings import Surroundings
from . import (border_segments, mesh_checks, read_beside, read_creases, read_limit_range, read_mesh, read_mirror,
               read_surroundings, region_faces, scene_objects)
from .mesh_checks import Purpose


def gather_mesh_patch(ob: bpy.types.Object, local: np.ndarray | None = None, key: str = "", *,
                      or_all: bool = False, purpose: Purpose = Purpose.WRITE, margin: float = 0.0,
                      crossing: Crossing | None = None) -> Patch:
    """Gathers the region: the selected faces in Edit Mode, the stored region in Object Mode.

    `local` (#vertices x 3, object space) replaces the coordinates of the mesh. With `or_all` all visible faces are
    taken where no region is stored. `margin` is that of the surroundings, see read_surroundings, relative to
    the diagonal of what is solved. `crossing` says what the border follows, where it does.
    """
    mesh_checks.refuse_unusable(ob, key, purpose)
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    faces = choose_faces(ob, or_all=or_all)
    local = read_mesh.read_coordinates(ob, key) if local is None else local
    index, F = triangulation.renumber_vertices(triangulate(ob, faces, local), len(local))
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        F = F[:, ::-1]  # a mirroring transform turns triangles over, but not what Blender calls their front
    whole = local @ matrix[:3, :3].T + matrix[:3, 3]
    mirror = read_mirror.read_mirror(ob, local[index])
    width = margin * measure_solved_diagonal(mirror, local[index], matrix) if margin else 0.0
    around = read_surroundings.read_surroundings(ob.data, faces, index, whole, width)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        around = Surroundings(around.V, around.F[:, ::-1])
    local, V = local[index], whole[index]
    patch = Patch(ob.name, faces, index, local, V, np.ascontiguousarray(F),
                  read_mesh.find_face_of_triangles(ob.data, faces), matrix, key, mirror,
                  read_creases.read_creases(ob, index), border_segments.read_border(ob, index), around,
                  read_limit_range.read_limit_range(ob, index))
    if crossing is None or not crossing.concerns(patch.border):
        return patch
    return replace(patch, beside=read_beside.read_beside(ob, patch, whole, crossing))


def measure_solved_diagonal(mirror: Mirror | None, local: np.ndarray, matrix: np.ndarray) -> float:
    """Measures the diagonal of the bounding box, in world space, of the region whose vertices are `local` (#V x 3,
    object space), with the image that a Mirror modifier adds.
    """
    if mirror is not None and mirror.image and mirror.axis >= 0:
        local = np.concatenate([local, local * mirror.sign])
    low, high = compute_bounds(local @ matrix[:3, :3].T)
    return float(np.linalg.norm(high - low))


def choose_faces(ob: bpy.types.Object, *, or_all: bool) -> np.ndarray:
    """Returns the faces of the region: #faces, bool; refuses an empty one."""
    mesh = ob.data
    if ob.mode == 'EDIT':
        faces = region_faces.read_selected_faces(mesh)
    elif or_all and not region_faces.has_stored_region(mesh):
        faces = region_faces.read_visible_faces(mesh)
    else:
        faces = region_faces.read_stored_region(mesh)
    if not faces.any():
        raise Refusal(scene_objects.describe_empty_selection([ob]) if ob.mode == 'EDIT'
                      else region_faces.describe_missing_region(ob))
    return faces


def triangulate(ob: bpy.types.Object, faces: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Returns the triangles of the faces as Blender cuts them: #triangles x 3 of the mesh's vertices."""
    around, sizes = read_mesh.read_region_corners(ob.data, faces)
    mesh_checks.refuse_broken_coordinates(ob.name, around, local)
    if sizes.max() <= 4:
        return triangulation.triangulate_short_faces(around, sizes, local)
    return read_mesh.read_region_triangles(ob.data, faces)


def compute_mean_normal(ob: bpy.types.Object) -> np.ndarray:
    """Returns the mean normal, in world space, of the selected faces, else of the stored region, else of all faces; +Z
    for a closed body, and where it is no direction.
    """
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    mesh = ob.data
    faces = region_faces.read_selected_faces(mesh) if ob.mode == 'EDIT' else region_faces.read_stored_region(mesh)
    areas, directions = np.empty(len(mesh.polygons)), np.empty(3 * len(mesh.polygons))
    mesh.polygons.foreach_get("area", areas)
    mesh.polygons.foreach_get("normal", directions)
    chosen = faces if faces.any() else np.ones(len(faces), dtype=bool)
    total = areas[chosen] @ directions.reshape(-1, 3)[chosen]
    matrix = np.array(ob.matrix_world, dtype=np.float64)[:3, :3]
    known = len(areas) and np.isfinite(total).all() and np.isfinite(matrix).all()
    if not known or np.linalg.norm(total) < 1e-3 * areas[chosen].sum() or np.linalg.matrix_rank(matrix) < 3:
        return np.array([0.0, 0.0, 1.0])
    normal = np.linalg.solve(matrix.T, total)
    return normal / np.linalg.norm(normal)
