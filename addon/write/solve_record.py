"""The last solve of an object as text for the .blend file: the shape before it, and the residual that it left.

The text is JSON, in which arrays are their packed bytes; their types are those of TYPES. The positions after the solve
are not stored: they are those of the mesh, or else the record is out of date.
"""
import base64
import json
import zlib

import bpy
import numpy as np

from ..model import border
from ..model.creases import AUTOMATIC
from ..model.patch import Patch
from ..model.surroundings import NOTHING_AROUND
from ..model.triangulation import find_face_of_triangles
from ..read import read_mesh

Record = dict[str, np.ndarray | str]

TYPES = {name: np.dtype(kind) for name, kind in (("faces", "u1"), ("index", "<i4"), ("F", "<i4"), ("local", "<f4"),
                                                 ("residual", "<f4"))}
LONGEST_KEY, MOST_REST = 63, 4096  # of Blender's names, and of all that is no array, characters
LARGEST = 1e15  # value: products of them stay finite in float32


def encode_solve(patch: Patch, residual: np.ndarray) -> str:
    """Encodes a patch and its residual (#F) as text."""
    arrays = {"faces": patch.faces, "index": patch.index, "F": patch.F, "local": patch.local, "residual": residual}
    packed = {name: base64.b64encode(zlib.compress(arrays[name].astype(kind).tobytes())).decode()
              for name, kind in TYPES.items()}
    return json.dumps({"key": patch.key, "matrix": patch.matrix.tolist(), **packed})


def decode_solve(ob: bpy.types.Object, text: str) -> tuple[Patch, np.ndarray, np.ndarray] | None:
    """Decodes a record: the patch, its positions in the mesh now (#V x 3, world space), and the residual.

    None where the text is damaged or belongs to another mesh. A file may hold any text: nothing of it is run,
    and no more is unpacked than this mesh can account for.
    """
    try:
        stored = unpack_record(text, find_most_values(ob.data))
    except (ValueError, KeyError, TypeError, ArithmeticError, RecursionError, zlib.error):
        return None  # a text of other origin
    if not fits_mesh(stored, ob.data):
        return None
    index, F, matrix, key = (stored[name] for name in ("index", "F", "matrix", "key"))
    faces, local = stored["faces"] != 0, stored["local"].astype(np.float64)
    V = local @ matrix[:3, :3].T + matrix[:3, 3]
    face_of_triangle = find_face_of_triangles(read_mesh.read_corners(ob.data)[1], faces)
    patch = Patch(ob.name_full, faces, index, local, V, F, face_of_triangle, matrix, key, None, AUTOMATIC,
                  np.full(len(index), border.UNSET), NOTHING_AROUND, None)
    move = read_mesh.read_coordinates(ob, key)[index] - local
    return patch, V + move @ matrix[:3, :3].T, stored["residual"].astype(np.float64)


def find_most_values(mesh: bpy.types.Mesh) -> dict[str, int]:
    """Returns how many values each array can have at most."""
    vertices, corners = len(mesh.vertices), len(mesh.loops)
    return {"faces": len(mesh.polygons), "index": vertices, "F": 3 * corners, "local": 3 * vertices,
            "residual": corners}


def unpack_record(text: str, most: dict[str, int]) -> Record:
    """Unpacks a record; raises where the text is none, or where an array of it exceeds `most` values."""
    if len(text) > MOST_REST + sum(2 * count * TYPES[name].itemsize for name, count in most.items()):
        raise ValueError("more text than the arrays can take")
    stored = json.loads(text)
    arrays = {name: unpack_array(stored[name], TYPES[name], count) for name, count in most.items()}
    if not isinstance(stored["key"], str) or len(stored["key"]) > LONGEST_KEY:
        raise ValueError("no name of a shape key")
    return {**arrays, "F": arrays["F"].reshape(-1, 3), "local": arrays["local"].reshape(-1, 3), "key": stored["key"],
            "matrix": np.array(stored["matrix"], dtype=np.float64)}


def unpack_array(packed: str, kind: np.dtype, most: int) -> np.ndarray:
    """Unpacks at most so many values: #values."""
    unpacking = zlib.decompressobj()
    content = unpacking.decompress(base64.b64decode(packed), most * kind.itemsize + 1)
    if len(content) > most * kind.itemsize or not unpacking.eof:
        raise ValueError("more values than the mesh has, or none")
    return np.frombuffer(content, kind)


def fits_mesh(stored: Record, mesh: bpy.types.Mesh) -> bool:
    """Returns whether a record is that of a patch of the mesh."""
    index, F, local, matrix = (stored[name] for name in ("index", "F", "local", "matrix"))
    n, triangles = len(index), len(F)
    if not n or not triangles or matrix.shape != (4, 4):
        return False
    if (len(stored["faces"]), len(local), len(stored["residual"])) != (len(mesh.polygons), n, triangles):
        return False
    if triangles != (read_mesh.read_corners(mesh)[1][stored["faces"] != 0] - 2).sum():
        return False
    return bool(index[0] >= 0 and (np.diff(index) > 0).all() and index[-1] < len(mesh.vertices)
                and F.min() >= 0 and F.max() < n
                and all((np.abs(stored[name]) < LARGEST).all() for name in ("local", "matrix", "residual"))
                and np.linalg.matrix_rank(matrix[:3, :3]) == 3
                and np.abs(np.linalg.inv(matrix[:3, :3])).max() < LARGEST)
