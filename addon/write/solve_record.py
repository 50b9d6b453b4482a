"""The last solve of an object as text for the .blend file: the shape before it, and the residual that it left.

The positions after it are not stored: they are those of the mesh, or else the record is out of date.
"""
import base64
import io
import math
import re
import zipfile
import zlib

import bpy
import numpy as np

from ..model import border
from ..model.creases import AUTOMATIC
from ..model.patch import Patch
from ..model.surroundings import NOTHING_AROUND
from ..read import read_mesh

TYPES = {name: np.dtype(kind) for name, kind in (("faces", "?"), ("index", "<i4"), ("F", "<i4"), ("local", "<f4"),
                                                 ("matrix", "<f8"), ("key", "<U64"), ("residual", "<f4"))}
TYPE_NAMES = {name: re.compile(r"<U([0-9]|[1-5][0-9]|6[0-4])" if name == "key" else re.escape(kind.str))
              for name, kind in TYPES.items()}  # Blender's names have up to 63 characters
HEADER = re.compile(rb"\x93NUMPY\x01\x00(?P<length>[\x00-\xff]{2})\{'descr': '(?P<type>[<|?a-zA-Z0-9]+)', "
                    rb"'fortran_order': (?P<fortran>True|False), 'shape': \((?P<shape>[0-9, ]{0,40})\), \} *",
                    re.DOTALL)
MOST_HEADER = 1024  # bytes
LARGEST = 1e15      # value: products of them stay finite in float32


def encode_solve(patch: Patch, residual: np.ndarray) -> str:
    """Encodes a patch and its residual (#F) as text."""
    file = io.BytesIO()
    np.savez_compressed(file, faces=patch.faces, index=patch.index.astype(np.int32), F=patch.F.astype(np.int32),
                        local=patch.local.astype(np.float32), matrix=patch.matrix, key=np.array(patch.key),
                        residual=residual.astype(np.float32))
    return base64.b64encode(file.getvalue()).decode()


def decode_solve(ob: bpy.types.Object, text: str) -> tuple[Patch, np.ndarray, np.ndarray] | None:
    """Decodes a record: the patch, its positions in the mesh now (#V x 3, world space), and the residual.

    None where the text is damaged or belongs to another mesh. A file may hold any text: nothing of it is run,
    and no more is unpacked than this mesh can account for.
    """
    try:
        stored = unpack_arrays(text, find_most_values(ob.data))
    except (ValueError, KeyError, EOFError, NotImplementedError, RuntimeError, zlib.error, zipfile.BadZipFile):
        return None  # a text of other origin
    if not fits_mesh(stored, ob.data):
        return None
    index, local, key = stored["index"], stored["local"].astype(np.float64), str(stored["key"])
    matrix = stored["matrix"]
    V = local @ matrix[:3, :3].T + matrix[:3, 3]
    patch = Patch(ob.name_full, stored["faces"], index, local, V, stored["F"],
                  read_mesh.find_face_of_triangles(ob.data, stored["faces"]), matrix, key, None, AUTOMATIC,
                  np.full(len(index), border.UNSET), NOTHING_AROUND, None)
    move = read_mesh.read_coordinates(ob, key)[index] - local
    return patch, V + move @ matrix[:3, :3].T, stored["residual"].astype(np.float64)


def find_most_values(mesh: bpy.types.Mesh) -> dict[str, int]:
    """Returns how many values each array can have at most."""
    vertices, corners = len(mesh.vertices), len(mesh.loops)
    return {"faces": len(mesh.polygons), "index": vertices, "F": 3 * corners, "local": 3 * vertices, "matrix": 16,
            "key": 1, "residual": corners}


def unpack_arrays(text: str, most: dict[str, int]) -> dict[str, np.ndarray]:
    """Unpacks the arrays of a text; raises where it is no archive of them, or where one exceeds `most` values."""
    room = sum(count * TYPES[name].itemsize + MOST_HEADER for name, count in most.items())
    if len(text) > 4 * room:  # more than base64 and an archive's own directory add
        raise ValueError("more text than the arrays can take")
    with zipfile.ZipFile(io.BytesIO(base64.b64decode(text))) as archive:
        return {name: read_array(archive, name, count) for name, count in most.items()}


def read_array(archive: zipfile.ZipFile, name: str, most: int) -> np.ndarray:
    """Reads a file of numpy's format 1.0, which is checked before memory is allocated for it."""
    with archive.open(name + ".npy") as file:
        start = HEADER.fullmatch(file.read(10) + file.read(MOST_HEADER - 10).split(b"\n")[0])
    if start is None:
        raise ValueError("no header of an array")
    dtype, order = start["type"].decode(), "F" if start["fortran"] == b"True" else "C"
    shape = tuple(int(size) for size in start["shape"].replace(b",", b" ").split())
    if not TYPE_NAMES[name].fullmatch(dtype) or math.prod(shape) > most:
        raise ValueError("another array")
    size = math.prod(shape) * np.dtype(dtype).itemsize
    with archive.open(name + ".npy") as file:
        file.read(10 + int.from_bytes(start["length"], "little"))
        content = file.read(size)
    return np.frombuffer(content, dtype).reshape(shape, order=order)


def fits_mesh(stored: dict[str, np.ndarray], mesh: bpy.types.Mesh) -> bool:
    """Returns whether the arrays are those of a patch of the mesh."""
    index, F, local, matrix = (stored[name] for name in ("index", "F", "local", "matrix"))
    n, triangles = len(index), len(F)
    shapes = {"faces": (len(mesh.polygons),), "index": (n,), "F": (triangles, 3), "local": (n, 3), "matrix": (4, 4),
              "key": (), "residual": (triangles,)}
    if not n or not triangles or any(stored[name].shape != shape for name, shape in shapes.items()):
        return False
    if triangles != len(read_mesh.find_face_of_triangles(mesh, stored["faces"])):
        return False
    return bool(index[0] >= 0 and (np.diff(index) > 0).all() and index[-1] < len(mesh.vertices)
                and F.min() >= 0 and F.max() < n
                and all((np.abs(stored[name]) < LARGEST).all() for name in ("local", "matrix", "residual"))
                and np.linalg.matrix_rank(matrix[:3, :3]) == 3
                and np.abs(np.linalg.inv(matrix[:3, :3])).max() < LARGEST)
