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
    mesh, settings = ob.data, ob.reflection_lines
    ends = read_mesh.read_integers(mesh.edges, "vertices", 2).reshape(-1, 2)[find_marked(mesh, settings.crease_marks)]
    number = np.full(len(mesh.vertices), -1)
    number[index] = np.arange(len(index))
    marked = number[ends]
    return Creases(settings.creases.lower(), marked[(marked >= 0).all(axis=1)])


def find_marked(mesh: bpy.types.Mesh, marks: set[str]) -> np.ndarray:
    """Returns which edges have one of the marks: #edges, bool."""
    marked = np.zeros(len(mesh.edges), dtype=bool)
    for mark, name in (("SHARP", "use_edge_sharp"), ("SEAM", "use_seam")):
        if mark in marks:
            values = np.empty(len(mesh.edges), dtype=bool)
            mesh.edges.foreach_get(name, values)
            marked |= values
    return marked | (compat.read_edge_creases(mesh) > 0.0) if "CREASE" in marks else marked
