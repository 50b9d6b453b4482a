"""Real car meshes, where they are at hand: they are not part of the project."""
import os
from pathlib import Path

import numpy as np
import pytest

Array = np.ndarray
MESHES = Path(os.environ.get("REFLINES_MESHES", Path(__file__).resolve().parents[3] / "shared" / "meshes"))


def obj(name: str) -> tuple[Array, list[list[int]]]:
    """V (#V x 3) in metres, and the corners of each face."""
    path = MESHES / name
    if not path.is_file():
        pytest.skip(f"{name} is not at hand: real meshes are not part of the project")
    rows = [line.split() for line in path.read_text().splitlines() if line.strip()]
    faces = [[int(word.split("/")[0]) - 1 for word in row[1:]] for row in rows if row[0] == "f"]
    return np.array([row[1:4] for row in rows if row[0] == "v"], float), faces


def triangles(name: str) -> tuple[Array, Array]:
    """V (#V x 3) without vertices that no face has, F (#F x 3): each face a fan."""
    V, faces = obj(name)
    fans = [[face[0], face[k], face[k + 1]] for face in faces for k in range(1, len(face) - 1)]
    used, corners = np.unique(np.array(fans), return_inverse=True)
    return V[used], corners.reshape(-1, 3)
