"""Stripes as plain arrays: what the shader is given. No Blender, no GPU."""
from dataclasses import dataclass

import numpy as np

TURN = 2.0 * np.pi
# Shares of the distance from the eye. Without an offset the surface itself hides 40 % of the pixels of its stripes.
BELOW_CAGE = 1e-3  # Blender's edges and vertices of Edit Mode stay in front
ABOVE_CAGE = 3e-2  # hides them

# Numbers of the modes in the shader.
MODES = {'REFLECTION': 0, 'HIGHLIGHT': 1, 'ISOPHOTE': 2, 'IMAGE': 3, 'RESIDUAL': 4, 'DEVIATION': 4}

# Colours of the maps, linear, from 0 to the full value: dark, then cold, then warm, so that grey prints keep the order.
RAMP = ((0.012, 0.015, 0.06), (0.05, 0.16, 0.55), (0.06, 0.55, 0.35), (0.92, 0.70, 0.10), (0.90, 0.09, 0.05))


@dataclass(frozen=True)
class Look:
    """How stripes are painted. Colours are linear RGBA; width and softness are shares."""
    mode: str
    count: int
    width: float
    softness: float
    color: tuple[float, float, float, float]
    gap_color: tuple[float, float, float, float]
    opacity: float
    image_rotation: float  # radians
    depth_offset: float    # how much nearer to the eye than the surface, as a share of the distance


@dataclass(frozen=True)
class Eye:
    """Who sees the reflection: `direction` is unit, towards the viewer; `position` is None for one at infinity."""
    direction: np.ndarray
    position: np.ndarray | None = None


@dataclass(frozen=True)
class Lights:
    """The paper's section 2.1: theta is the angle around `line` from v_a towards a_perp. Unit vectors, world space."""
    line: np.ndarray
    v_a: np.ndarray
    a_perp: np.ndarray


def lights(direction: np.ndarray, line_direction: np.ndarray) -> Lights | None:
    """With theta = 0 towards the viewer in `direction`; None where light and view are parallel."""
    across = direction - np.dot(direction, line_direction) * line_direction
    length = np.linalg.norm(across)
    if length < 1e-6:
        return None
    return Lights(line_direction, across / length, np.cross(line_direction, across / length))


def ramp(share: np.ndarray) -> np.ndarray:
    """The map's colours, #N x 3, at shares of the full value."""
    place = np.clip(share, 0.0, 1.0) * (len(RAMP) - 1)
    return np.column_stack([np.interp(place, range(len(RAMP)), channel) for channel in zip(*RAMP, strict=True)])


def around(F: np.ndarray, chosen: np.ndarray, count: int, *, rings: int) -> np.ndarray:
    """#F bool: the chosen triangles and those that reach them over shared vertices in so many steps."""
    inside = chosen
    for _ in range(rings):
        touched = np.zeros(count, dtype=bool)
        touched[F[inside]] = True
        inside = touched[F].any(axis=1)
    return inside


def area_normals(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    """#V x 3, of any length: the sum of the triangles' normals by area. Cheap, and as rough as Blender's own.

    By columns, since numpy's cross product of 400,000 triangles alone takes as long as all of this.
    """
    first = V.take(F[:, 0], axis=0)
    a, b = ((V.take(F[:, k], axis=0) - first).T for k in (1, 2))
    where = F.T.ravel()
    return np.column_stack([np.bincount(where, np.tile(a[i] * b[j] - a[j] * b[i], 3), len(V))
                            for i, j in ((1, 2), (2, 0), (0, 1))])


def uniforms(*, model: np.ndarray, view_matrix: np.ndarray, projection: np.ndarray, eye: Eye, lights: Lights,
             look: Look) -> np.ndarray:
    """The shader's uniform block (see shader.STRUCT), float32. Matrices are 4 x 4, column vectors to their right."""
    blocks = [
        (projection @ view_matrix @ model).T, model.T, normal_matrix(model).T, depth_axis(projection),
        np.append(eye.direction, 0.0) if eye.position is None else np.append(eye.position, 1.0),
        np.append(lights.v_a, 0.0), np.append(lights.a_perp, 0.0), np.append(lights.line, 0.0),
        [look.count / TURN, look.width, look.softness, look.depth_offset],
        look.color, look.gap_color, [look.opacity, MODES[look.mode], look.image_rotation / TURN, 0.0],
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
