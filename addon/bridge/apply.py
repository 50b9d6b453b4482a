"""From solved positions back into the mesh: only vertices that moved are written."""
from itertools import compress

import bmesh
import bpy
import numpy as np

from . import gather, keys, mirror, region
from .gather import Panel
from .refusal import Refusal

SAMPLE = 64  # positions that are compared to know a mesh again
FEW = 0.03  # share of the vertices below which their normals are brought up to date faster one by one than all together


class EditVertices:
    """A panel's vertices in Edit Mode, kept for a drag: to look them up takes as long as to write them."""

    def __init__(self, index: np.ndarray) -> None:
        self.index = index
        self.edit: bmesh.types.BMesh | None = None
        self.vertices: list[bmesh.types.BMVert] = []

    def of(self, edit: bmesh.types.BMesh) -> list[bmesh.types.BMVert]:
        if self.edit is not edit or not self.edit.is_valid:
            edit.verts.ensure_lookup_table()
            vertices = edit.verts
            self.edit, self.vertices = edit, [vertices[i] for i in self.index.tolist()]
        return self.vertices


def apply(ob: bpy.types.Object, panel: Panel, positions: np.ndarray) -> None:
    """Writes world positions (#V x 3) of the region, into a shape key where the panel asks for that.

    That key can only be made in Object Mode, so there this ends, unless the key is what is being edited.
    """
    if panel.key and not keys.is_edited(ob):
        if ob.mode == 'EDIT':
            bpy.ops.object.mode_set(mode='OBJECT')
        keys.open_key(ob)
    show(ob, panel, local(panel, positions), start(panel) if ob.mode == 'EDIT' else now(ob, panel))


def now(ob: bpy.types.Object, panel: Panel) -> np.ndarray:
    """#V x 3 float32, object space: what the mesh has, in Object Mode."""
    return gather.coordinates(ob, panel.key)[panel.index].astype(np.float32)


def start(panel: Panel) -> np.ndarray:
    """#V x 3 float32, object space: what the mesh had."""
    return panel.local.astype(np.float32)


def local(panel: Panel, positions: np.ndarray) -> np.ndarray:
    """#V x 3 float32, object space.

    What is added is the move, taken back to object space, so that a vertex leaves its place along the view only.
    """
    move = (positions - panel.V) @ np.linalg.inv(panel.matrix[:3, :3]).T
    new = (panel.local + move).astype(np.float32)
    return new if panel.mirror is None else mirror.settled(panel.mirror, new, panel.local)


def show(ob: bpy.types.Object, panel: Panel, new: np.ndarray, old: np.ndarray,
         kept: EditVertices | None = None) -> None:
    """Writes object-space positions (#V x 3 float32) over those that the mesh has now."""
    moved = (new != old).any(axis=1)
    if moved.any():
        if ob.mode == 'EDIT':
            write_edit_mesh(ob.data, kept or EditVertices(panel.index), moved, new[moved])
        else:
            write_shape(ob, panel.key, panel.index[moved], new[moved])


def before(ob: bpy.types.Object, panel: Panel, positions: np.ndarray) -> np.ndarray | None:
    """#vertices x 3: the mesh before the region went to `positions`; None where it is not there, but for rounding."""
    whole = gather.coordinates(ob, panel.key)
    if len(whole) <= panel.index[-1]:
        return None
    apart = np.abs(whole[panel.index] - local(panel, positions))
    if not (apart <= 2.0 * np.spacing(np.abs(whole[panel.index]).max().astype(np.float32))).all():
        return None
    whole[panel.index] = panel.local
    return whole


def is_undone(ob: bpy.types.Object, panel: Panel, positions: np.ndarray) -> bool:
    """Whether the vertex that went furthest to `positions` is elsewhere now, in Edit Mode; the others are not compared,
    since undo shall not take longer for it."""
    vertices = bmesh.from_edit_mesh(ob.data).verts
    furthest = int(np.abs(positions - panel.V).max(axis=1).argmax())
    if panel.index[furthest] >= len(vertices):
        return True
    vertices.ensure_lookup_table()
    now, left = np.array(vertices[panel.index[furthest]].co), local(panel, positions)[furthest]
    return bool((np.abs(now - left) > 2.0 * np.spacing(np.abs(left).max())).any())


def counts(ob: bpy.types.Object) -> tuple[int, int, int]:
    """Vertices, edges and faces of the mesh as it is edited."""
    if ob.mode == 'EDIT':
        edit = bmesh.from_edit_mesh(ob.data)
        return len(edit.verts), len(edit.edges), len(edit.faces)
    return len(ob.data.vertices), len(ob.data.edges), len(ob.data.polygons)


def still_has(ob: bpy.types.Object, panel: Panel, positions: np.ndarray) -> bool:
    """Whether nobody else changed the mesh: its size, and a sample of the positions (#V x 3 float32, object space)."""
    mesh = bmesh.from_edit_mesh(ob.data) if ob.mode == 'EDIT' else ob.data
    vertices, faces = (mesh.verts, mesh.faces) if ob.mode == 'EDIT' else (gather.points(ob, panel.key), mesh.polygons)
    if len(faces) != len(panel.faces) or panel.index[-1] >= len(vertices):
        return False
    if ob.mode == 'EDIT':
        vertices.ensure_lookup_table()
    sample = np.linspace(0, len(positions) - 1, SAMPLE).astype(int)
    now = np.array([vertices[i].co for i in panel.index[sample].tolist()], dtype=np.float32)
    return np.array_equal(now, positions[sample])


def write_shape(ob: bpy.types.Object, key: str, index: np.ndarray, new: np.ndarray) -> None:
    """In Object Mode, into the shape that gather.points says."""
    mesh, points = ob.data, gather.points(ob, key)
    values = np.empty(3 * len(points), dtype=np.float32)
    points.foreach_get("co", values)
    values.reshape(-1, 3)[index] = new
    points.foreach_set("co", values)
    if mesh.shape_keys is not None:
        mesh.shape_keys.update_tag()
    mesh.update()


def write_edit_mesh(mesh: bpy.types.Mesh, vertices: EditVertices, moved: np.ndarray, new: np.ndarray) -> None:
    """`moved`: of the vertices, bool; `new` has a row for each that did."""
    edit = bmesh.from_edit_mesh(mesh)
    columns = new.T.tolist()  # a list for each vertex would take three times longer, in Python's search for garbage
    for vertex, co in zip(compress(vertices.of(edit), moved.tolist()), zip(*columns, strict=True), strict=True):
        vertex.co = co
    if len(new) < FEW * len(edit.verts):
        update_normals(list(compress(vertices.of(edit), moved.tolist())))
    else:
        edit.normal_update()
    bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=False)


def update_normals(moved: list[bmesh.types.BMVert]) -> None:
    """Of the faces around and their vertices: Blender draws these, and brings none up to date by itself."""
    faces = {face for vertex in moved for face in vertex.link_faces}
    for face in faces:
        face.normal_update()
    for vertex in {vertex for face in faces for vertex in face.verts}:
        vertex.normal_update()


def keep_region(ob: bpy.types.Object, panel: Panel) -> None:
    """Remembers the faces, so that the tool can run on them again in Object Mode."""
    if ob.mode == 'EDIT':
        region.store(ob.data, panel.faces)


def refuse_taken(ob: bpy.types.Object, name: str) -> None:
    """Where an attribute of this name holds something else than a number for each vertex."""
    found = ob.data.attributes.get(name)
    if found is not None and (found.domain, found.data_type) != ('POINT', 'FLOAT'):
        raise Refusal(f"{ob.name} has another attribute {name} ({found.domain.lower()}, {found.data_type.lower()}) "
                      "than the result's: rename or remove it")


def store_vertex_values(ob: bpy.types.Object, name: str, values: np.ndarray) -> None:
    """A float attribute of the mesh's vertices (#vertices), in either mode."""
    if ob.mode == 'EDIT':
        edit = bmesh.from_edit_mesh(ob.data)
        layer = edit.verts.layers.float.get(name) or edit.verts.layers.float.new(name)
        for vertex, value in zip(edit.verts, values.tolist(), strict=True):
            vertex[layer] = value
        return
    attribute = ob.data.attributes.get(name) or ob.data.attributes.new(name, 'FLOAT', 'POINT')
    attribute.data.foreach_set("value", values.astype(np.float32))
