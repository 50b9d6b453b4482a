"""The handles that are kept with an object."""
import bpy
from bpy.props import IntProperty, StringProperty

from ..model import line_handle
from ..model.line_handle import Handles
from ..model.refusal import Refusal


class ReflinesHandles(bpy.types.PropertyGroup):
    """The handles of the last Pull Line on an object, and the size of its mesh then."""
    text: StringProperty(name="Handles", description="As JSON, see model/line_handle.py", options={'HIDDEN'})
    vertices: IntProperty(name="Vertices")
    faces: IntProperty(name="Faces")

    def keep(self, text: str, mesh: bpy.types.Mesh) -> None:
        self.text, self.vertices, self.faces = text, len(mesh.vertices), len(mesh.polygons)

    def read(self, mesh: bpy.types.Mesh) -> Handles:
        """Returns the handles; refuses those of another topology, and what is no text of handles."""
        if not self.text:
            return ()
        if (self.vertices, self.faces) != (len(mesh.vertices), len(mesh.polygons)):
            raise Refusal(f"{self.id_data.name}: its handles belong to a mesh of {self.vertices} vertices and "
                          f"{self.faces} faces; it has {len(mesh.vertices)} and {len(mesh.polygons)} now: press Delete "
                          "Handles, and pull the lines again")
        return line_handle.decode_handles(self.text)


register, unregister = bpy.utils.register_classes_factory([ReflinesHandles])
