"""The handles that are kept with an object: what of them can be keyed as properties, the rest as text."""
import bpy
from bpy.props import BoolProperty, CollectionProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from ..animation import handle_keys
from ..model import kept_handles, line_handle
from ..model.line_handle import Handles, LineHandle
from ..model.refusal import Refusal


class ReflinesHandle(bpy.types.PropertyGroup):
    """The values of one handle, which can be keyed and driven. Its name is that of its channels."""
    place: FloatVectorProperty(name="Place", subtype='XYZ', unit='LENGTH', precision=4, description="Where the line "
                               "passes, in the object's space; of a drawn line its middle, and all of it moves along")
    radius: FloatProperty(name="Radius", unit='LENGTH', min=0.0, soft_max=10.0, precision=4,
                          description="How far from the handle lines may move")
    muted: BoolProperty(name="Mute", description="The handle is kept, but pulls and holds nothing")

    def fill(self, handle: LineHandle, number: int) -> list[str]:
        """Copies a handle's values; returns the names of those that were others."""
        self.name = f"{'Pin' if handle.is_pin else 'Handle'} {number}"
        before = tuple(self.place), self.radius, self.muted
        self.place, self.radius, self.muted = handle.end, handle.radius, handle.muted
        now = tuple(self.place), self.radius, self.muted
        return [name for name, old, new in zip(("place", "radius", "muted"), before, now, strict=True) if old != new]


class ReflinesHandles(bpy.types.PropertyGroup):
    """The handles of the last Pull Line on an object, and the size of its mesh then."""
    text: StringProperty(name="Handles", description="As JSON, see model/kept_handles.py", options={'HIDDEN'})
    kept: CollectionProperty(type=ReflinesHandle, description="The values of each; empty in files of before, whose "
                             "text holds them")
    active: IntProperty(name="Active Handle", min=0, description="The handle that is shown below")
    vertices: IntProperty(name="Vertices")
    faces: IntProperty(name="Faces")

    def keep(self, handles: Handles, mesh: bpy.types.Mesh) -> tuple[str, ...]:
        """Keeps handles in the place of those that are kept now. Keys stay with the handles that are still there;
        returns sentences about those that could not, and about those that went with theirs.
        """
        before = kept_handles.read_numbers(self.text, len(self.kept)) if self.kept else ()
        handles = kept_handles.number_handles(handles, before)
        notes = handle_keys.move_keys(self.id_data, kept_handles.find_moves(before, [each.number for each in handles]))
        self.text = kept_handles.encode_fixed(handles)
        self.vertices, self.faces = len(mesh.vertices), len(mesh.polygons)
        self.fill(handles)
        return notes

    def fill(self, handles: Handles) -> None:
        """Copies the values of handles into as many items, and keys what has changed where Auto Keying is on."""
        while len(self.kept) > len(handles):
            self.kept.remove(len(self.kept) - 1)
        while len(self.kept) < len(handles):
            self.kept.add()
        changed = [(index, name) for index, (own, handle) in enumerate(zip(self.kept, handles, strict=True))
                   for name in own.fill(handle, index + 1)]
        handle_keys.insert_auto_keys(self.id_data, bpy.context.scene, changed)

    def adopt(self, mesh: bpy.types.Mesh) -> None:
        """Gives the handles of a file of before values that can be keyed, where they can be used."""
        if self.text and not self.kept:
            try:
                self.keep(self.read(mesh), mesh)
            except Refusal:
                return  # said where they are used

    def read_values(self) -> list[kept_handles.Values]:
        """Returns the values of each as they are in the present frame."""
        return [(tuple(each.place), each.radius, each.muted) for each in self.kept]

    def read(self, mesh: bpy.types.Mesh) -> Handles:
        """Returns the handles; refuses those of another topology, and what is no text of handles."""
        if not self.text:
            return ()
        if (self.vertices, self.faces) != (len(mesh.vertices), len(mesh.polygons)):
            raise Refusal(f"{self.id_data.name}: its handles belong to a mesh of {self.vertices} vertices and "
                          f"{self.faces} faces; it has {len(mesh.vertices)} and {len(mesh.polygons)} now: press Delete "
                          "Handles, and pull the lines again")
        if not self.kept:
            return line_handle.decode_handles(self.text)
        return kept_handles.place_handles(self.text, self.read_values())
