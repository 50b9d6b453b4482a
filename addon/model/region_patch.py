"""Cuts the region out of a mesh that was read: the patch that is solved, with the faces around it."""
import numpy as np

from . import triangulation
from .border import WRONG
from .creases import Creases
from .mesh_snapshot import MeshSnapshot
from .mirror import Mirror
from .patch import Patch, compute_bounds
from .refusal import Refusal
from .surroundings import find_surroundings


def cut_patch(snapshot: MeshSnapshot, margin: float = 0.0) -> Patch:
    """Cuts out the region. `margin` is that of its surroundings, relative to the diagonal of what is solved."""
    faces, whole = snapshot.region, snapshot.world
    index, F = triangulation.renumber_vertices(snapshot.cut_faces(faces, snapshot.local), len(whole))
    local, mirror = snapshot.local[index], snapshot.mirror
    width = margin * measure_solved_diagonal(mirror, local, snapshot.matrix) if margin else 0.0
    ranges = snapshot.limit_range[index]
    return Patch(
        snapshot.name, faces, index, local, whole[index], np.ascontiguousarray(F[:, ::-1] if snapshot.is_turned else F),
        triangulation.find_face_of_triangles(snapshot.mesh.sizes, faces), snapshot.matrix, snapshot.key, mirror,
        Creases(snapshot.crease_rule, find_marked_edges(snapshot, index)), find_border(snapshot, index),
        find_surroundings(snapshot, index, whole, width), None if (np.abs(ranges) == 1.0).all() else ranges)


def measure_solved_diagonal(mirror: Mirror | None, local: np.ndarray, matrix: np.ndarray) -> float:
    """Measures the diagonal of the bounding box, in world space, of the region whose vertices are `local` (#V x 3,
    object space), with the image that a Mirror modifier adds.
    """
    if mirror is not None and mirror.image and mirror.axis >= 0:
        local = np.concatenate([local, local * mirror.sign])
    low, high = compute_bounds(local @ matrix[:3, :3].T)
    return float(np.linalg.norm(high - low))


def find_marked_edges(snapshot: MeshSnapshot, index: np.ndarray) -> np.ndarray:
    """Finds the marked edges between the vertices `index` (#V), by their numbers in it: #M x 2."""
    number = np.full(len(snapshot.local), -1)
    number[index] = np.arange(len(index))
    marked = number[snapshot.mesh.edges[snapshot.marked]]
    return marked[(marked >= 0).all(axis=1)]


def find_border(snapshot: MeshSnapshot, index: np.ndarray) -> np.ndarray:
    """Returns the border's own codes at the vertices `index` (#V); refuses values that are neither codes nor between
    two.
    """
    codes = snapshot.border[index]
    wrong = int((codes == WRONG).sum())
    if wrong:
        raise Refusal(f"{snapshot.name}: {wrong} vertices have a border that is none of Free, Position, Tangent, "
                      "Curvature, Flow and Neighbours: select them and press one of these under Border of the Selected")
    return codes
