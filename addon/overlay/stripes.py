"""Stripes as plain arrays: what the shader is given. No Blender, no GPU."""
import hashlib
from dataclasses import dataclass

import numpy as np

TURN = 2.0 * np.pi
# Shares of the distance from the eye. Without an offset the surface itself hides 40 % of the pixels of its stripes.
BELOW_CAGE = 1e-3  # Blender's edges and vertices of Edit Mode stay in front
ABOVE_CAGE = 3e-2  # hides them


@dataclass(frozen=True)
class Look:
    """How stripes are painted. Colours are linear RGBA; width and softness are shares."""
    count: int
    width: float
    softness: float
    color: tuple[float, float, float, float]
    gap_color: tuple[float, float, float, float]
    opacity: float
    depth_offset: float  # how much nearer to the eye than the surface, as a share of the distance


@dataclass(frozen=True)
class Eye:
    """Who sees the reflection: `direction` is unit, towards the viewer; `position` is None for one at infinity."""
    direction: np.ndarray
    position: np.ndarray | None = None


def zero_axes(direction: np.ndarray, line_direction: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """v_a and a_perp of the paper's section 2.1: theta is the angle from the first towards the second.

    None where light and view are parallel.
    """
    across = direction - np.dot(direction, line_direction) * line_direction
    length = np.linalg.norm(across)
    if length < 1e-6:
        return None
    return across / length, np.cross(line_direction, across / length)


def signature(V: np.ndarray, F: np.ndarray, normals: np.ndarray) -> bytes:
    """Equal where a batch of these arrays would be the same."""
    digest = hashlib.blake2b(digest_size=16)
    for array in (V, F, normals):
        digest.update(np.ascontiguousarray(array))
    return digest.digest()


def uniforms(*, model: np.ndarray, view_matrix: np.ndarray, projection: np.ndarray, eye: Eye,
             axes: tuple[np.ndarray, np.ndarray], look: Look) -> np.ndarray:
    """The shader's uniform block (see shader.STRUCT), float32. Matrices are 4 x 4, column vectors to their right."""
    blocks = [
        (projection @ view_matrix @ model).T, model.T, normal_matrix(model).T, depth_axis(projection),
        np.append(eye.direction, 0.0) if eye.position is None else np.append(eye.position, 1.0),
        np.append(axes[0], 0.0), np.append(axes[1], 0.0),
        [look.count / TURN, look.width, look.softness, look.depth_offset],
        look.color, look.gap_color, [look.opacity, 0.0, 0.0, 0.0],
    ]
    return np.concatenate([np.ravel(block) for block in blocks]).astype(np.float32)


def normal_matrix(model: np.ndarray) -> np.ndarray:
    """4 x 4 cofactors: normals fitted in object space map by them, and they exist for a flattened object too.

    They turn normals over where the object is mirrored, which reflection does not notice.
    """
    x, y, z = model[:3, :3].T
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)])
    return matrix


def depth_axis(projection: np.ndarray) -> np.ndarray:
    """How clip space changes as a point comes nearer by one: per distance for perspective, per half view width else."""
    axis = projection[:, 2]
    return axis if axis[3] != 0.0 else axis / abs(projection[0, 0])
