"""Small scenes to test on, built as an artist has them, and what can be read from them."""
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import radians

import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix

Height = Callable[[float, float], float]


def crown(x: float, y: float) -> float:
    """A clean panel over [-1, 1]^2: a paraboloid, whose lines as seen from above are as even as they can be."""
    return -0.15 * x * x - 0.1 * y * y


def rippled(x: float, y: float) -> float:
    """The clean panel with dents of 2/1000 of its size, which fade towards the border."""
    fade = (1.0 - x * x) ** 2 * (1.0 - y * y) ** 2
    return crown(x, y) + 0.004 * fade * np.sin(9.0 * x + 1.0) * np.cos(8.0 * y)


def panel(name: str = "Panel", height: Height = rippled, cells: int = 16) -> bpy.types.Object:
    """A square of quads with a height, linked and active. The outermost ring of faces lies outside the usual region."""
    grid = np.linspace(-1.0, 1.0, cells + 1)
    vertices = [(x, y, height(x, y)) for y in grid for x in grid]
    return linked(name, vertices, quads(cells + 1, cells + 1))


def quads(columns: int, rows: int) -> list[tuple[int, int, int, int]]:
    """The faces of a sheet of so many columns and rows of vertices, which are numbered row by row."""
    return [(i, i + 1, i + columns + 1, i + columns) for j in range(rows - 1)
            for i in range(j * columns, (j + 1) * columns - 1)]


def sphere() -> bpy.types.Object:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=16)
    return bpy.context.object


def linked(name: str, vertices: list, faces: list) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.update()
    ob = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(ob)
    activate(ob)
    return ob


def remove_all() -> None:
    """Leaves Edit Mode, and no object in the file."""
    if bpy.context.mode != 'OBJECT':
        object_mode()
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)


def activate(ob: bpy.types.Object) -> None:
    ob.select_set(True)
    bpy.context.view_layer.objects.active = ob


def look_from_above(light_degrees: float = 70.0) -> None:
    """An orthographic view along -Z, and line lights in the xz-plane at an angle from the view direction."""
    bpy.ops.reflines.set_up(part='CAMERA', direction=(0.0, 0.0, 1.0))
    angle = radians(light_degrees)
    bpy.ops.reflines.set_up(part='LIGHT', direction=(np.sin(angle), 0.0, np.cos(angle)))


def axis_z(ob: bpy.types.Object) -> np.ndarray:
    """The direction of its own z axis in the world, of unit length."""
    bpy.context.view_layer.update()
    axis = np.array(ob.matrix_world, dtype=float)[:3, 2]
    return axis / np.linalg.norm(axis)


def settings() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines


def smooth(**given: object) -> set[str]:
    """Through the user's door, as one undo step."""
    return bpy.ops.reflines.smooth('EXEC_DEFAULT', True, **given)


def edit(*objects: bpy.types.Object) -> None:
    for ob in objects:
        activate(ob)
    bpy.ops.object.mode_set(mode='EDIT')


def select_faces(ob: bpy.types.Object, wanted: Callable[[int], bool]) -> None:
    """In Edit Mode, by the index of the face."""
    mesh = bmesh.from_edit_mesh(ob.data)
    for element in (*mesh.verts, *mesh.edges, *mesh.faces):
        element.select = False
    for face in mesh.faces:
        face.select_set(wanted(face.index))
    bmesh.update_edit_mesh(ob.data)


def inner(cells: int = 16, margin: int = 1) -> Callable[[int], bool]:
    """The faces of a panel without its outermost rings."""
    return lambda face: all(margin <= k < cells - margin for k in divmod(face, cells))


def edit_inner(ob: bpy.types.Object, cells: int = 16, margin: int = 1) -> None:
    edit(ob)
    select_faces(ob, inner(cells, margin))


def edited_panel(name: str = "Panel", height: Height = rippled, cells: int = 16, margin: int = 1,
                 light_degrees: float = 70.0) -> bpy.types.Object:
    """A panel seen from above, in Edit Mode with all but its outermost rings selected."""
    ob = panel(name, height, cells)
    look_from_above(light_degrees)
    edit_inner(ob, cells, margin)
    return ob


def object_mode() -> None:
    bpy.ops.object.mode_set(mode='OBJECT')


def positions(ob: bpy.types.Object) -> np.ndarray:
    """#V x 3 float32 as stored, in either mode; of the active shape key where there are keys."""
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    keys = ob.data.shape_keys
    points = ob.data.vertices if keys is None else (ob.active_shape_key or keys.reference_key).data
    values = np.empty(3 * len(points), dtype=np.float32)
    points.foreach_get("co", values)
    return values.reshape(-1, 3)


def pixels(image: bpy.types.Image) -> np.ndarray:
    """Height x width x 4, bottom row first."""
    values = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


def fingerprint(ob: bpy.types.Object) -> tuple:
    """All that an artist could miss: positions, faces, attributes, shape keys, bit by bit."""
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    mesh = ob.data
    corners = [tuple(polygon.vertices) for polygon in mesh.polygons]
    keys = mesh.shape_keys.key_blocks if mesh.shape_keys else []
    shapes = [np.array([point.co for point in key.data], dtype=np.float32).tobytes() for key in keys]
    layers = sorted(layer.name for layer in bmesh.from_edit_mesh(mesh).faces.layers.int.values()) \
        if ob.mode == 'EDIT' else sorted(attribute.name for attribute in mesh.attributes)
    return positions(ob).tobytes(), corners, shapes, layers, [polygon.select for polygon in mesh.polygons]


@contextmanager
def refused(ob: bpy.types.Object, sentence: str) -> Iterator[None]:
    """What is done within is refused with a sentence of this pattern, and leaves the object as it is."""
    before = fingerprint(ob)
    try:
        yield
    except RuntimeError as error:
        assert re.search(sentence, str(error)) and "Traceback" not in str(error), error
    else:
        raise AssertionError(f"nothing was refused: {sentence}")
    assert fingerprint(ob) == before


def world(ob: bpy.types.Object) -> np.ndarray:
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    return positions(ob).astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def transformed(ob: bpy.types.Object, matrix: Matrix) -> None:
    """Gives the object a transform without moving it in the world."""
    ob.data.transform(matrix.inverted())
    if matrix.determinant() < 0.0:
        ob.data.flip_normals()
    ob.matrix_world = matrix
    bpy.context.view_layer.update()


TRANSFORMS = {
    "none": Matrix(),
    "moved": Matrix.Translation((3.0, -2.0, 5.0)),
    "turned": Euler((0.4, -0.7, 1.1)).to_matrix().to_4x4(),
    "scaled unevenly": Matrix.Diagonal((2.0, 0.5, 30.0, 1.0)),
    "mirrored": Matrix.Diagonal((-1.0, 1.0, 1.0, 1.0)),
    "turned, scaled and mirrored": Euler((0.4, 0.2, 2.0)).to_matrix().to_4x4() @ Matrix.Diagonal((0.1, -3.0, 2.0, 1.0)),
}
