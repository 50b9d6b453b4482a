"""The results of a panel's problem as arrays of its patch: positions, lines, residuals and verdicts; and the way back,
from values of the patch to those of the optimizer's vertices and triangles.
"""
import numpy as np

from .. import native
from ..model import mirror
from ..model.line_surface import LineState
from ..native_call import call
from ..targets import mirror_target
from .panel_problem import PanelProblem, spread


def read_own(problem: PanelProblem, positions: np.ndarray) -> np.ndarray:
    """Returns the patch's positions from those of all that is solved: #V x 3, world space."""
    patch = problem.patch
    if problem.is_cage:
        return patch.V + (positions - problem.V)[patch.index]
    return patch.V + (positions - problem.V)[:len(patch.V)] if problem.is_joined else positions


def read_positions(problem: PanelProblem, optimizer: "native.ShapeOptimizer") -> np.ndarray:
    """Reads the solved positions of the patch's vertices: #V x 3, world space."""
    return read_own(problem, optimizer.cage_positions if problem.is_cage else optimizer.positions)


async def read_lines(optimizer: "native.ShapeOptimizer") -> LineState:
    """Reads the lines at the vertices of the optimizer's triangles, see read_triangles."""
    return LineState(optimizer.positions, await call(native.reflines.vertex_theta, optimizer))


def read_triangles(problem: PanelProblem, optimizer: "native.ShapeOptimizer") -> np.ndarray:
    """Reads the triangles that lines are read on: #F x 3; of a patch joined with its image its own half."""
    return optimizer.triangles if problem.is_cage else problem.patch.F


def read_residual(problem: PanelProblem, optimizer: "native.ShapeOptimizer", residual: np.ndarray) -> np.ndarray:
    """Returns the residual of the patch's triangles (#F) from that of all that is solved: on a cage the root mean
    square over the surface of each face, for all triangles of that face.
    """
    if not problem.is_cage:
        return read_on_triangles(problem, residual)
    faces = len(problem.patch.cage.sizes)
    squared, area = (np.bincount(optimizer.parent, values, faces)
                     for values in (optimizer.area * residual**2, optimizer.area))
    return read_on_triangles(problem, np.sqrt(squared / np.maximum(area, 1e-300)))


def read_on_triangles(problem: PanelProblem, values: np.ndarray) -> np.ndarray:
    """Returns for the patch's triangles (#F) the values of all that are solved, or of the cage's faces (#faces)."""
    if not problem.is_cage:
        return values[:len(problem.patch.F)]
    own = np.flatnonzero(problem.patch.faces)
    return np.repeat(values[own], problem.patch.cage.sizes[own] - 2)


def measure_cage_move(problem: PanelProblem, optimizer: "native.ShapeOptimizer") -> float:
    """Measures the largest move of a cage's vertices, world units; 0 where vertices are those of the surface."""
    return float(np.linalg.norm(optimizer.cage_positions - problem.V, axis=1).max()) if problem.is_cage else 0.0


async def spread_weights(problem: PanelProblem, optimizer: "native.ShapeOptimizer", weights: np.ndarray) -> np.ndarray:
    """Returns weights of the patch's vertices (#V) for all vertices of the optimizer's triangles: on a cage subdivided
    as its positions are, and of two mirror images the smaller one for both.
    """
    own = spread(problem, weights, 1.0)
    if problem.is_cage:
        refined = await subdivide(problem, optimizer, np.repeat(own[:, None], 3, axis=1))
        return np.clip(refined[:, 0], 0.0, 1.0)
    return own if problem.image_sign is None else np.minimum(own, own[problem.partner])


async def spread_ranges(problem: PanelProblem, optimizer: "native.ShapeOptimizer") -> np.ndarray | None:
    """Returns PanelProblem.limit_range for each vertex of the optimizer's triangles, on a cage likewise."""
    own = problem.limit_range
    if own is None or not problem.is_cage:
        return own
    refined = await subdivide(problem, optimizer, np.column_stack([own, np.zeros(len(own))]))
    return np.clip(refined[:, :2], [-1.0, 0.0], [0.0, 1.0])


async def subdivide(problem: PanelProblem, optimizer: "native.CageOptimizer", values: np.ndarray) -> np.ndarray:
    """Returns three values of each vertex of the cage (#cage x 3) for the vertices of the optimizer's triangles."""
    subdivision = await call(native.reflines.Subdivision.create, **problem.patch.cage.build_topology_arguments(),
                             vertices=len(values))
    return subdivision.positions(values)[optimizer.refined]


def complete_target(problem: PanelProblem, wanted: "native.Target") -> "native.Target":
    """Returns the target for all that is solved, from one that was built for it: with the image of its own half where
    the patch is joined with its image. An eye of its own sees no half as the other: then there are both already.
    """
    if not problem.is_joined or problem.view.families is not None:
        return wanted
    sign = mirror.compute_theta_sign(problem.patch.mirror, problem.patch.matrix, problem.view.line_direction)
    return mirror_target.mirror_target(wanted, sign)
