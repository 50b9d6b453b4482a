"""Lines carried along by a lattice.

The lattice is Blender's: a point moves by the weighted sum of how far the control points were moved, the weights being
those of a uniform cubic spline (or of linear interpolation) with the outermost control points repeated. A test holds it
against Blender's own modifier. An untouched lattice moves nothing, bit for bit, whatever the spline.
"""
from dataclasses import dataclass, replace

import numpy as np

from .. import native

TENSION = {'KEY_CARDINAL': 0.71, 'KEY_CATMULL_ROM': 0.5}  # Blender's


@dataclass(frozen=True)
class Lattice:
    """In the lattice's own space, `matrix` apart."""
    low: np.ndarray      # 3, first control point of an untouched lattice
    high: np.ndarray     # 3, the last one
    moves: np.ndarray    # #w x #v x #u x 3, what each control point was moved by
    kinds: tuple[str, str, str]  # interpolation along u, v, w
    matrix: np.ndarray   # 4 x 4, to world space

    def same(self, other: "Lattice") -> bool:
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in vars(self))

    def scaled(self, share: float) -> "Lattice":
        """With control points that went a share of their way; all of it changes no bit."""
        return replace(self, moves=share * self.moves)


@dataclass(frozen=True)
class Warp:
    lattice: Lattice
    cells: int = 128       # a side of the regular grid that the map is sampled on
    by_value: bool = False

    def same(self, other: "Warp | None") -> bool:
        return (other is not None and self.lattice.same(other.lattice)
                and (self.cells, self.by_value) == (other.cells, other.by_value))


def target(optimizer: object, settings: Warp) -> object:
    to_plane = optimizer.frame[:2] @ settings.lattice.matrix[:3]  # 2 x 4, of the lattice's space
    low, high = extent(optimizer.xy, settings.lattice, to_plane)
    step = np.arange(settings.cells + 1) / settings.cells
    x, y = (low[axis] + (high[axis] - low[axis]) * step for axis in (0, 1))
    rest = np.stack([np.tile(x, len(y)), np.repeat(y, len(x))], axis=1)
    local = np.linalg.solve(to_plane[:, :2], (rest - to_plane[:, 3]).T).T
    position = rest + moved(settings.lattice, local) @ to_plane[:, :3].T
    return native.reflines.warp(optimizer, low=low, high=high, columns=settings.cells, rows=settings.cells,
                                position=position, by_value=settings.by_value)[0]


def remarks(wanted: object) -> tuple[str, ...]:
    """Sentences about a target."""
    outside = int((wanted.weight < 1.0).sum())
    if not outside:
        return ()
    return (f"{outside} triangles would show lines from beyond the region; they are left nearly as they are",)


def extent(xy: np.ndarray, lattice: Lattice, to_plane: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of the region and the untouched lattice together, in the image plane."""
    corners = np.array([(u, v, 0.0, 1.0) for u in (lattice.low[0], lattice.high[0])
                        for v in (lattice.low[1], lattice.high[1])]) @ to_plane.T
    points = np.concatenate([xy, corners])
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 1e-3 * (high - low).max()  # vertices on the rim lie inside the grid whatever the rounding
    return low - margin, high + margin


def moved(lattice: Lattice, local: np.ndarray) -> np.ndarray:
    """#points x 3, in the lattice's space: what the lattice moves points of its plane (#points x 2) by."""
    at = [local[:, 0], local[:, 1], np.zeros(len(local))]
    depth, height, width = lattice.moves.shape[:3]
    along_u, along_v, along_w = (
        weights(at[axis], lattice.low[axis], lattice.high[axis], count, lattice.kinds[axis])
        for axis, count in enumerate((width, height, depth)))
    layers = np.einsum("pw,wvuc->pvuc", along_w[:1], lattice.moves)[0]  # all points lie at the same depth
    return np.einsum("pv,pu,vuc->pc", along_v, along_u, layers, optimize=True)


def weights(at: np.ndarray, low: float, high: float, count: int, kind: str) -> np.ndarray:
    """#points x count: how much each control point of a row counts."""
    result = np.zeros((len(at), count))
    if count == 1:
        result[:] = 1.0
        return result
    place = (at - low) * ((count - 1) / (high - low))
    cell = np.floor(place)
    rows = np.arange(len(at))
    for step, weight in zip((-1, 0, 1, 2), basis(place - cell, kind), strict=True):
        np.add.at(result, (rows, np.clip(cell + step, 0, count - 1).astype(int)), weight)
    return result


def basis(t: np.ndarray, kind: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Weights of the four control points around a cell, t in [0, 1] being the place in it."""
    if kind == 'KEY_LINEAR':
        return np.zeros_like(t), 1.0 - t, t, np.zeros_like(t)
    if kind == 'KEY_BSPLINE':
        return ((1.0 - t)**3 / 6.0, (3.0 * t**3 - 6.0 * t**2 + 4.0) / 6.0,
                (3.0 * (t**2 - t**3 + t) + 1.0) / 6.0, t**3 / 6.0)
    c = TENSION[kind]
    return (c * (2.0 * t**2 - t**3 - t), (2.0 - c) * t**3 + (c - 3.0) * t**2 + 1.0,
            (c - 2.0) * t**3 + (3.0 - 2.0 * c) * t**2 + c * t, c * (t**3 - t**2))
