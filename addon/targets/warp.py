"""The target of lines that a lattice deforms.

The lattice is Blender's: a point moves by the weighted sum of the control points' moves, with the weights of a uniform
cubic spline (or of linear interpolation) whose outermost control points are repeated. A test compares it with Blender's
own modifier. An untouched lattice moves nothing, bit for bit, whatever the spline.
"""
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..native_call import call

CELLS = 128  # a side of the regular grid that the map is sampled on
TENSION = {'KEY_CARDINAL': 0.71, 'KEY_CATMULL_ROM': 0.5}  # Blender's


@dataclass(frozen=True)
class Lattice:
    """A lattice in its own space, with `matrix` to world space."""
    low: np.ndarray      # 3, first control point of an untouched lattice
    high: np.ndarray     # 3, the last one
    moves: np.ndarray    # #w x #v x #u x 3, what each control point was moved by
    kinds: tuple[str, str, str]  # interpolation along u, v, w
    matrix: np.ndarray   # 4 x 4, to world space

    def scaled(self, factor: float) -> "Lattice":
        """Returns the lattice with its control points' moves scaled; a factor of 1 changes no bit."""
        return replace(self, moves=factor * self.moves)


@dataclass(frozen=True)
class Warp:
    """The lattice, and what is fitted to its map."""
    lattice: Lattice
    by_value: bool = False


async def build_warp_target(optimizer: "native.ShapeOptimizer", settings: Warp) -> "native.Target":
    """Samples the lattice's map on a regular grid of the image plane, and builds the target of the lines carried along
    by it.
    """
    to_plane = optimizer.frame[:2] @ settings.lattice.matrix[:3]  # 2 x 4, of the lattice's space
    low, high = compute_grid_extent(optimizer.xy, settings.lattice, to_plane)
    step = np.arange(CELLS + 1) / CELLS
    x, y = (low[axis] + (high[axis] - low[axis]) * step for axis in (0, 1))
    rest = np.stack([np.tile(x, len(y)), np.repeat(y, len(x))], axis=1)
    local = np.linalg.solve(to_plane[:, :2], (rest - to_plane[:, 3]).T).T
    position = rest + evaluate_moves(settings.lattice, local) @ to_plane[:, :3].T
    target, _ = await call(native.reflines.warp, optimizer, low=low, high=high, columns=CELLS,
                           rows=CELLS, position=position, by_value=settings.by_value)
    # Not reduced to its reachable part: a live warp follows with loose tolerances, at which the solver does not reduce
    # targets, and the final shape would differ from the one shown by more than a twentieth of the move.
    target.reachable_only = False
    return target


def describe_outside(wanted: "native.Target") -> tuple[str, ...]:
    """Describes triangles whose lines would come from outside the region."""
    outside = int((wanted.weight < 1.0).sum())
    if not outside:
        return ()
    return (f"{outside} triangles would show lines from beyond the region; they are left nearly as they are",)


def compute_grid_extent(xy: np.ndarray, lattice: Lattice, to_plane: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the bounds of the region and the untouched lattice together, in the image plane."""
    corners = np.array([(u, v, 0.0, 1.0) for u in (lattice.low[0], lattice.high[0])
                        for v in (lattice.low[1], lattice.high[1])]) @ to_plane.T
    points = np.concatenate([xy, corners])
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 1e-3 * (high - low).max()  # vertices on the rim lie inside the grid whatever the rounding
    return low - margin, high + margin


def evaluate_moves(lattice: Lattice, local: np.ndarray) -> np.ndarray:
    """Evaluates the lattice's map: the moves (#points x 3, lattice space) of points of its plane (#points x 2)."""
    at = [local[:, 0], local[:, 1], np.zeros(len(local))]
    depth, height, width = lattice.moves.shape[:3]
    along_u, along_v, along_w = (
        compute_spline_weights(at[axis], lattice.low[axis], lattice.high[axis], count, lattice.kinds[axis])
        for axis, count in enumerate((width, height, depth)))
    layers = np.einsum("pw,wvuc->pvuc", along_w[:1], lattice.moves)[0]  # all points lie at the same depth
    return np.einsum("pv,pu,vuc->pc", along_v, along_u, layers, optimize=True)


def compute_spline_weights(at: np.ndarray, low: float, high: float, count: int, kind: str) -> np.ndarray:
    """Returns the weight of each control point of a row: #points x count."""
    result = np.zeros((len(at), count))
    if count == 1:
        result[:] = 1.0
        return result
    place = (at - low) * ((count - 1) / (high - low))
    cell = np.floor(place)
    rows = np.arange(len(at))
    for step, weight in zip((-1, 0, 1, 2), evaluate_basis(place - cell, kind), strict=True):
        np.add.at(result, (rows, np.clip(cell + step, 0, count - 1).astype(int)), weight)
    return result


def evaluate_basis(t: np.ndarray, kind: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns the weights of the four control points around a cell at t in [0, 1]."""
    if kind == 'KEY_LINEAR':
        return np.zeros_like(t), 1.0 - t, t, np.zeros_like(t)
    if kind == 'KEY_BSPLINE':
        return ((1.0 - t)**3 / 6.0, (3.0 * t**3 - 6.0 * t**2 + 4.0) / 6.0,
                (3.0 * (t**2 - t**3 + t) + 1.0) / 6.0, t**3 / 6.0)
    c = TENSION[kind]
    return (c * (2.0 * t**2 - t**3 - t), (2.0 - c) * t**3 + (c - 3.0) * t**2 + 1.0,
            (c - 2.0) * t**3 + (3.0 - 2.0 * c) * t**2 + c * t, c * (t**3 - t**2))
