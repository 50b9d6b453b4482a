"""Reads the view for a patch, and refuses patches that are seen from behind, with the reason."""
import bpy
import numpy as np

from ..model import orientation
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.view import View
from ..read import read_mesh
from . import view_and_light

EDGE_ON = 0.2  # cosine between view and normal below which the solver counts a face as seen edge on
SAMPLE = 256    # triangles


def read_patch_view(scene: bpy.types.Scene, patch: Patch) -> View:
    """Reads the scene's view and light for a patch; refuses one whose faces all turn away from the view."""
    seen = view_and_light.read_scene_view(scene, patch.center)
    if is_turned_away(patch, seen.view_direction):
        ob = bpy.data.objects[patch.name]
        raise Refusal(describe_turned_away(ob, patch, inside_out=is_inside_out(ob.data, patch.faces)))
    return seen


def is_turned_away(patch: Patch, direction: np.ndarray) -> bool:
    """Returns whether the faces of the patch turn away from the viewer, none being seen from its front. Faces seen edge
    on do not count.
    """
    few = patch.F[::max(1, len(patch.F) // SAMPLE)]  # a sample suffices, since some of most patches are in front
    return all(is_seen_from_behind(patch.V, F, direction) for F in (few, patch.F))


def is_seen_from_behind(V: np.ndarray, F: np.ndarray, direction: np.ndarray) -> bool:
    a, b, c = (V[F[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    towards, area = normals @ direction, np.linalg.norm(normals, axis=1)
    return bool(towards.sum() < -EDGE_ON * area.sum() and (towards <= EDGE_ON * area).all())


def describe_turned_away(ob: bpy.types.Object, patch: Patch, *, inside_out: bool) -> str:
    all_faces = f"All {int(patch.faces.sum())} faces of the region turn away from the view"
    if inside_out:
        return (f"{all_faces}, for the normals of {ob.name} point inwards there: select the faces and choose "
                "Mesh > Normals > Flip")
    return (f"{all_faces}, which sees them from behind: turn the view camera. Look at the panel's outside and press "
            "Set Up from This View")


def is_inside_out(mesh: bpy.types.Mesh, region: np.ndarray) -> bool:
    """Returns whether the faces of the region (#faces, bool) are inside out, judged by all of the mesh."""
    corners, sizes = read_mesh.read_corners(mesh)
    flipped = orientation.is_flipped(corners, sizes, region)
    areas, normals, centers = (read_mesh.read_values(mesh.polygons, name, float, each) for name, each in
                               (("area", 1), ("normal", 3), ("center", 3)))
    alike = np.where(region & flipped, -1.0, 1.0)[:, None]
    flux = orientation.compute_flux(areas, alike * normals, centers)
    return orientation.is_inside_out(flux, closed=orientation.is_closed(corners, sizes), flipped=flipped)
