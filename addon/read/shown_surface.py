"""Describes what keeps a result from being seen as it is, or alone: custom normals, other objects with the same mesh,
and coordinates so far from the object's origin that their rounding bends the lines.
"""
import bpy
import numpy as np

from ..blender import units
from ..model.patch import Patch

# A coordinate is off by 0.29 of the step of float32 (root mean square), which tilts a face by 0.41 of the step over its
# edge, and turns its reflection by twice as much.
TURN = 0.82
SEEN = np.radians(0.05)  # turn of a reflection, the error of the measure of lines
NEARER = 4.0  # least factor by which the origin in the middle of the region makes the step finer, to say so


def describe_custom_normals(ob: bpy.types.Object) -> tuple[str, ...]:
    """Says that custom normals go on showing the old surface."""
    if not ob.data.has_custom_normals:
        return ()
    return (f"{ob.name} has custom normals, which go on showing the old reflections in Blender's shading: reset them",)


def describe_shared_mesh(ob: bpy.types.Object) -> tuple[str, ...]:
    """Says which other objects changed, since they have the same mesh."""
    others = [other.name for other in bpy.data.objects if other.data == ob.data and other != ob
              and other.users_collection]
    if not others:
        return ()
    named = ", ".join(others[:3]) + (f" and {len(others) - 3} more" if len(others) > 3 else "")
    return (f"The mesh is shared: {named} changed, too",)


def measure_rounding(patch: Patch) -> float:
    """Measures by how much the rounding of coordinates turns the lines of a region that lies far from its object's
    origin, radians; 0 where it is not seen, or another origin would not help.
    """
    corners = patch.local[patch.F]
    edge = float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())
    step = find_step(np.abs(patch.local).max())
    turn = TURN * step / edge if edge else 0.0
    return turn if turn > SEEN and step >= NEARER * find_step(0.5 * np.ptp(patch.local, axis=0).max()) else 0.0


def find_step(coordinate: float) -> float:
    """Returns the distance of a coordinate of a mesh to the next one that can be stored."""
    return float(np.spacing(np.float32(coordinate)))


def describe_rounding(scene: bpy.types.Scene, patch: Patch, turn: float) -> tuple[str, ...]:
    """Says how far the region is from its object's origin and what that does to its lines, and what to do about it."""
    if not turn:
        return ()
    origin = patch.matrix[:3, 3]
    far = units.format_length(float(np.linalg.norm(patch.center - origin)), scene, 2)
    return (f"The region lies {far} from the origin of its object, where the rounding of coordinates turns the lines "
            f"by {np.degrees(turn):.2g}\u00b0: set the origin to the geometry, then press again",)
