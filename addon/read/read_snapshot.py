"""Reads the mesh of an object, its region and the artist's marks on it, once for all that a press makes of them."""
import bpy
import numpy as np

from ..blender import compat
from ..model.mesh_snapshot import Connectivity, MeshSnapshot
from ..model.refusal import Refusal
from . import border_segments, group_weights, mesh_checks, read_mesh, read_mirror, region_faces, scene_objects
from .mesh_checks import Purpose


def read_snapshot(ob: bpy.types.Object, key: str, local: np.ndarray | None, *, or_all: bool,
                  purpose: Purpose) -> MeshSnapshot:
    """Reads the mesh with its region: the selected faces in Edit Mode, the stored ones in Object Mode; with `or_all`
    all visible ones where none are stored. `local` (#vertices x 3, object space) replaces the mesh's coordinates.
    """
    mesh_checks.refuse_unusable(ob, key, purpose)
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    region = choose_faces(ob, or_all=or_all)
    local = read_mesh.read_coordinates(ob, key) if local is None else local
    mesh = read_connectivity(ob.data)
    around = mesh.corners[np.repeat(region, mesh.sizes)]
    mesh_checks.refuse_broken_coordinates(ob.name, around, local)
    inside = np.zeros(len(local), dtype=bool)
    inside[around] = True
    return MeshSnapshot(
        ob.name, key, np.array(ob.matrix_world, dtype=np.float64), local, mesh,
        read_cut_triangles(ob.data, mesh, region, local), region_faces.read_visible_faces(ob.data), region,
        read_mesh.read_values(ob.data.edges, "use_edge_sharp", bool) | (mesh.creases > 0.0),
        ob.reflection_lines.creases.lower(), border_segments.read_border(ob),
        read_limit_range(ob), read_mirror.read_mirror(ob, local[inside]))


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
        raise Refusal(scene_objects.describe_unselected(ob) if ob.mode == 'EDIT'
                      else region_faces.describe_missing_region(ob))
    return faces


def read_connectivity(mesh: bpy.types.Mesh) -> Connectivity:
    """Reads the faces and edges. In Edit Mode the mesh must have been updated from it."""
    edges = read_mesh.read_integers(mesh.edges, "vertices", 2)
    return Connectivity(*read_mesh.read_corners(mesh), edges, compat.read_edge_creases(mesh))


def read_cut_triangles(mesh: bpy.types.Mesh, faces: Connectivity, region: np.ndarray,
                       local: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Reads how Blender cuts n-gons, which it must not do where one beside the region has coordinates that are not
    finite; None where that is so, or there are no n-gons.
    """
    many = faces.sizes > 4
    if not many.any():
        return None
    is_broken = not np.isfinite(local[faces.corners[np.repeat(many, faces.sizes)]]).all()
    return None if is_broken and not many[region].any() else read_mesh.read_triangles(mesh)


def read_limit_range(ob: bpy.types.Object) -> np.ndarray:
    """Reads the range of each vertex's move within the limit, by the sides that it may move to and a vertex group:
    #vertices x 2.
    """
    settings = ob.reflection_lines
    ways = np.array([-float(settings.limit_side != 'OUTWARD'), float(settings.limit_side != 'INWARD')])
    return group_weights.read_group_weights(ob, settings.limit_group, "the limit")[:, None] * ways
