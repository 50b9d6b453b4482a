"""Outlines of text in Blender's own font, as triangles."""
import bpy
import numpy as np

NAME = "Reflection Lines Text"


class TextReader:
    """Reads one text after another; what it needs in the file is there between `with` and its end only."""

    def __enter__(self) -> "TextReader":
        self.curve = bpy.data.curves.new(NAME, 'FONT')
        self.curve.fill_mode = 'FRONT'
        self.ob = bpy.data.objects.new(NAME, self.curve)
        return self

    def __exit__(self, *_: object) -> None:
        bpy.data.objects.remove(self.ob)
        bpy.data.curves.remove(self.curve)

    def read(self, text: str) -> tuple[np.ndarray, np.ndarray]:
        """Returns the letters of a text of size 1: vertices (#V x 2, to the right and up from the beginning of the base
        line) and triangles (#F x 3).
        """
        self.curve.body = text
        mesh = self.ob.to_mesh()
        mesh.calc_loop_triangles()
        V, F = np.zeros((len(mesh.vertices), 3), dtype=np.float32), np.zeros((len(mesh.loop_triangles), 3), np.int32)
        mesh.vertices.foreach_get("co", V.ravel())
        mesh.loop_triangles.foreach_get("vertices", F.ravel())
        self.ob.to_mesh_clear()
        return V[:, :2].astype(np.float64), F
