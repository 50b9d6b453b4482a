"""Reads the edges that the artist marked as creases, and the rule by which others are found."""
import bpy
import numpy as np

from ..blender import compat
from ..model.creases import Creases
from . import read_mesh


def read_creases(ob: bpy.types.Object, index: np.ndarray) -> Creases:
    """Reads the creases of a patch; `index` (#V) names the mesh vertex behind each of its vertices.

    In Edit Mode the mesh must have been updated from it.
    """
    mesh = ob.data
    ends = read_mesh.read_integers(mesh.edges, "vertices", 2).reshape(-1, 2)[find_marked(mesh)]
    number = np.full(len(mesh.vertices), -1)
    number[index] = np.arange(len(index))
    marked = number[ends]
    return Creases(ob.reflection_lines.creases.lower(), marked[(marked >= 0).all(axis=1)])


def find_marked(mesh: bpy.types.Mesh) -> np.ndarray:
    """Returns which edges are marked as sharp or have a crease: #edges, bool."""
    sharp = np.empty(len(mesh.edges), dtype=bool)
    mesh.edges.foreach_get("use_edge_sharp", sharp)
    return sharp | (compat.read_edge_creases(mesh) > 0.0)
