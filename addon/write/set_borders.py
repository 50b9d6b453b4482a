"""Sets the border of what is selected, as read.border_segments reads it."""
from collections.abc import Iterator, Sequence

import bmesh
import bpy

from ..model import border
from ..model.refusal import Refusal
from ..read import mesh_checks
from ..read.border_segments import ATTRIBUTE, VALUES


def set_selected_borders(objects: Sequence[bpy.types.Object], name: str) -> list[int]:
    """Sets the border of the selected vertices of objects in Edit Mode, of faces that of their rim; returns how many
    vertices of each object that are. Refuses before anything is set.
    """
    for ob in objects:
        mesh_checks.refuse_taken_attribute(ob, ATTRIBUTE, 'INT')
    if not any(True for ob in objects for _ in list_chosen(bmesh.from_edit_mesh(ob.data))):
        raise Refusal("The selected faces have no rim, since they are all of a closed body: select edges or vertices "
                      "of the panel's border")
    return [set_selected_border(ob.data, name) for ob in objects]


def set_selected_border(mesh: bpy.types.Mesh, name: str) -> int:
    edit = bmesh.from_edit_mesh(mesh)
    layers = edit.verts.layers.int
    layer = layers.get(ATTRIBUTE) or layers.new(ATTRIBUTE)
    chosen = set(list_chosen(edit))  # after the layer, which makes references to vertices invalid
    value = VALUES[border.CODES[name]] if name in border.CODES else 0
    for vertex in chosen:
        vertex[layer] = value
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    return len(chosen)


def list_chosen(edit: bmesh.types.BMesh) -> Iterator[bmesh.types.BMVert]:
    """Lists the selected vertices, where faces are selected those of edges with exactly one selected face; some twice.
    """
    if edit.select_mode != {'FACE'}:
        return (vertex for vertex in edit.verts if vertex.select and not vertex.hide)
    rim = (edge for edge in edit.edges if edge.select and sum(face.select for face in edge.link_faces) == 1)
    return (vertex for edge in rim for vertex in edge.verts)
