"""Stripes as plain arrays: the shader's inputs. No Blender, no GPU."""
from dataclasses import dataclass

import numpy as np

TURN = 2.0 * np.pi
# Fractions of the distance from the eye. Without an offset the surface itself hides 40 % of the pixels of its stripes.
ABOVE_SURFACE = 1e-3
# By how much Blender's own vertices of Edit Mode are nearer than the surface (bglPolygonOffsetCalc): in perspective a
# fraction of the distance, else in clip space for each unit of the view's distance. Stripes in Edit Mode hide them.
VERTEX_FRACTION, VERTEX_DEPTH = 1.875e-3, 7.5e-6
VERTEX_RADIUS = 4.0  # pixels of Blender's dots, which face the eye

# Numbers of the modes in the shader.
MODES = {'REFLECTION': 0, 'HIGHLIGHT': 1, 'ISOPHOTE': 2, 'IMAGE': 3, 'RESIDUAL': 4, 'DEVIATION': 5, 'VERDICT': 6}

# Colours of the maps, linear, from 0 to the full value: dark, then cold, then warm, so that grey prints keep the order.
RAMP = ((0.012, 0.015, 0.06), (0.05, 0.16, 0.55), (0.06, 0.55, 0.35), (0.92, 0.70, 0.10), (0.90, 0.09, 0.05))
# The same for values with a sign: cold inwards, grey at 0, warm outwards.
SIGNED_RAMP = ((0.02, 0.10, 0.65), (0.10, 0.35, 0.60), (0.50, 0.50, 0.50), (0.85, 0.40, 0.10), (0.75, 0.05, 0.03))
# What was kept as design, grey where there was nothing to heal, and what was healed.
VERDICT_RAMP = ((0.02, 0.10, 0.65), (0.20, 0.30, 0.60), (0.50, 0.50, 0.50), (0.30, 0.60, 0.20), (0.03, 0.50, 0.06))
RAMPS = {'RESIDUAL': RAMP, 'DEVIATION': SIGNED_RAMP, 'VERDICT': VERDICT_RAMP}


@dataclass(frozen=True)
class Look:
    """The look of the stripes. Colours are linear RGBA; width and softness are fractions."""
    mode: str
    count: int
    width: float
    softness: float
    color: tuple[float, float, float, float]
    gap_color: tuple[float, float, float, float]
    image_rotation: float  # radians
    depth_offset: float    # how much nearer to the eye than the surface, as a fraction of the distance


@dataclass(frozen=True)
class Eye:
    """The viewer of the reflection: `direction` is unit, towards the viewer; `position` is None for one at infinity."""
    direction: np.ndarray
    position: np.ndarray | None = None


@dataclass(frozen=True)
class Lights:
    """The frame of theta (paper, section 2.1): the angle around `line` from v_a towards a_perp. Unit vectors, world
    space.
    """
    line: np.ndarray
    v_a: np.ndarray
    a_perp: np.ndarray


def compute_lights(direction: np.ndarray, line_direction: np.ndarray) -> Lights | None:
    """Computes the frame with theta = 0 towards the viewer in `direction`; None where light and view are parallel."""
    across = direction - np.dot(direction, line_direction) * line_direction
    length = np.linalg.norm(across)
    if length < 1e-6:
        return None
    return Lights(line_direction, across / length, np.cross(line_direction, across / length))


def compute_ramp(fraction: np.ndarray, ramp: tuple = RAMP) -> np.ndarray:
    """Returns the colours of a map at fractions of the way along its ramp: #N x 3."""
    place = np.clip(fraction, 0.0, 1.0) * (len(ramp) - 1)
    return np.column_stack([np.interp(place, range(len(ramp)), channel) for channel in zip(*ramp, strict=True)])


def grow_selection(F: np.ndarray, chosen: np.ndarray, count: int, *, rings: int) -> np.ndarray:
    """Returns the chosen triangles and those within `rings` steps over shared vertices: #F, bool."""
    inside = chosen
    for _ in range(rings):
        touched = np.zeros(count, dtype=bool)
        touched[F[inside]] = True
        inside = touched[F].any(axis=1)
    return inside


def pack_uniforms(*, model: np.ndarray, view_matrix: np.ndarray, projection: np.ndarray, eye: Eye, lights: Lights,
             look: Look) -> np.ndarray:
    """Packs the shader's uniform block (shader.STRUCT) as float32. Matrices are 4 x 4 for column vectors. A mode that
    there is not, of a changed file, is drawn as the first.
    """
    blocks = [
        (projection @ view_matrix @ model).T, model.T, compute_normal_matrix(model).T, compute_depth_axis(projection),
        np.append(eye.direction, 0.0) if eye.position is None else np.append(eye.position, 1.0),
        np.append(lights.v_a, 0.0), np.append(lights.a_perp, 0.0), np.append(lights.line, 0.0),
        [look.count / TURN, look.width, look.softness, look.depth_offset],
        look.color, look.gap_color, [0.0, MODES.get(look.mode, 0), look.image_rotation / TURN, 0.0],
    ]
    return np.concatenate([np.ravel(block) for block in blocks]).astype(np.float32)


def keep_side(uniforms: np.ndarray, x: float) -> np.ndarray:
    """Returns the uniforms for one side of a view only: right of x pixels from its left, or left of -x; 0 for all."""
    kept = uniforms.copy()
    kept[-1] = x
    return kept


def compute_normal_matrix(model: np.ndarray) -> np.ndarray:
    """Returns the cofactor matrix (4 x 4) that transforms normals, which exists for a flattened object too.

    It turns normals over where the object is mirrored, which reflection does not notice.
    """
    x, y, z = model[:3, :3].T
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)])
    return matrix


def measure_pixels(projection: np.ndarray, pixels: float, width: float) -> float:
    """Returns a length in pixels of a view of this width as `move_nearer` takes lengths."""
    fraction = 2.0 * pixels / width
    return fraction / abs(projection[0, 0]) if projection[3, 2] != 0.0 else fraction


def compute_edit_offset(projection: np.ndarray, view_distance: float, radius: float) -> float:
    """Returns how much nearer than the surface stripes must be to hide Blender's own cage on slopes up to 63 degrees;
    `radius` is that of its dots as `measure_pixels` returns it.
    """
    if projection[3, 2] != 0.0:
        blender = VERTEX_FRACTION
    else:
        blender = VERTEX_DEPTH * view_distance * abs(projection[0, 0] / projection[2, 2])
    return 1.2 * blender + 2.0 * radius


def move_nearer(projection: np.ndarray, fraction: float) -> np.ndarray:
    """Returns the projection with depths as if everything were nearer to the eye, by a fraction of its distance or,
    without perspective, of half the view's width; places in the picture stay. The stripes' vertex shader does the same.
    """
    moved = projection.copy()
    if projection[3, 2] != 0.0:
        moved[2, 3] /= 1.0 - fraction
    else:
        moved[2, 3] += fraction * projection[2, 2] / abs(projection[0, 0])
    return moved


def compute_depth_axis(projection: np.ndarray) -> np.ndarray:
    """Returns the change of clip space as a point comes nearer: per distance in perspective, per half the view's width
    else.
    """
    axis = projection[:, 2]
    return axis if axis[3] != 0.0 else axis / abs(projection[0, 0])
