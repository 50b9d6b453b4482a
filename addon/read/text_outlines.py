"""Outlines of text in Blender's own font, as triangles."""
import bpy
import numpy as np

from . import read_mesh

NAME = "Reflection Lines Text"


def read_outlines(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns the letters of a text of size 1: vertices (#V x 2, to the right and up from the beginning of the base
    line) and triangles (#F x 3). What that needs in the file is there meanwhile only.
    """
    curve = bpy.data.curves.new(NAME, 'FONT')
    ob = bpy.data.objects.new(NAME, curve)
    try:
        curve.fill_mode, curve.body = 'FRONT', text
        mesh = ob.to_mesh()
        V, F = read_mesh.read_values(mesh.vertices, "co", np.float32, 3), read_mesh.read_triangles(mesh)[0]
        ob.to_mesh_clear()
    finally:
        bpy.data.objects.remove(ob)
        bpy.data.curves.remove(curve)
    return V[:, :2].astype(np.float64), F
