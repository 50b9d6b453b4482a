"""The last solve of an object as text, for the .blend file: the shape before it, and what it could not reach.

Where it left the vertices is not part of it: that is what the mesh shows, or else the record is of no use.
"""
import base64
import io
import zipfile
import zlib

import bpy
import numpy as np

from . import gather
from .gather import Panel


def written(panel: Panel, residual: np.ndarray) -> str:
    """`residual`: #F."""
    file = io.BytesIO()
    np.savez_compressed(file, faces=panel.faces, index=panel.index.astype(np.int32), F=panel.F.astype(np.int32),
                        local=panel.local.astype(np.float32), matrix=panel.matrix, key=np.array(panel.key),
                        residual=residual.astype(np.float32))
    return base64.b64encode(file.getvalue()).decode()


def read(ob: bpy.types.Object, text: str) -> tuple[Panel, np.ndarray, np.ndarray] | None:
    """Panel, where its vertices are now (#V x 3, world space), and residual; None where it is of another mesh."""
    try:
        stored = dict(np.load(io.BytesIO(base64.b64decode(text))))
        index, local = stored["index"], stored["local"].astype(np.float64)
        matrix, key = stored["matrix"], str(stored["key"])
    except (ValueError, KeyError, EOFError, zlib.error, zipfile.BadZipFile):  # somebody else's text
        return None
    if len(stored["faces"]) != len(ob.data.polygons) or index.max() >= len(ob.data.vertices):
        return None
    V = local @ matrix[:3, :3].T + matrix[:3, 3]
    panel = Panel(ob.name, stored["faces"], index, local, V, stored["F"], matrix, key, None)
    move = gather.coordinates(ob, key)[index] - local
    return panel, V + move @ matrix[:3, :3].T, stored["residual"].astype(np.float64)
