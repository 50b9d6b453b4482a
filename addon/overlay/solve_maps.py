"""The last solve as arrays to draw: its residual, its deviation, and the shape before it."""
import numpy as np

from ..model.solution import LastSolve
from ..model.triangulation import compute_area_normals

# Positions, triangles, normals, and fractions of the full colour.
Arrays = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]

# Relative to the patch's size: vertices further from where the solve left them have been changed since.
UNCHANGED_TOLERANCE = 1e-4


def compute_left_positions(solution: LastSolve) -> np.ndarray:
    """Returns where the solve left the patch's vertices: #V x 3, object space."""
    patch = solution.patch
    return patch.local + np.linalg.solve(patch.matrix[:3, :3], (solution.positions - patch.V).T).T


def is_current(solution: LastSolve, V: np.ndarray, fraction: float) -> bool:
    """Returns whether the mesh's vertices as they are shown (V) are as the solve left them, with a fraction of its
    move: nearer to that than to the shape before, which undo brings back, however little the solve moved.
    """
    patch = solution.patch
    if patch.index[-1] >= len(V):
        return False
    size = np.ptp(patch.local, axis=0).max()
    shown = patch.local + fraction * (compute_left_positions(solution) - patch.local)
    off, back = (np.abs(V[patch.index] - each).max() for each in (shown, patch.local))
    return bool(off <= UNCHANGED_TOLERANCE * size and off <= back)


def has_moved(solution: LastSolve) -> bool:
    """Returns whether the solve moved any vertex by as much as a mesh can store."""
    left, before = (each.astype(np.float32) for each in (compute_left_positions(solution), solution.patch.local))
    return not np.array_equal(left, before)


def build_flat_map(solution: LastSolve, mode: str) -> Arrays:
    """Builds the map of the residual, or of what a press healed and what it kept as design: constant on each triangle,
    so with own vertices; empty where it is not known.
    """
    values = compute_values(solution, mode)
    F = solution.patch.F if len(values) == len(solution.patch.F) else solution.patch.F[:0]
    V = compute_left_positions(solution)[F].reshape(-1, 3)
    shown = values[:len(F)] if mode == 'VERDICT' else scale_values(values[:len(F)])
    return V, np.arange(len(V)).reshape(-1, 3), np.zeros_like(V), np.repeat(shown, 3)


def build_deviation_map(solution: LastSolve, mode: str) -> Arrays:
    """Builds the map of the distances that the vertices moved, positive outwards."""
    V = compute_left_positions(solution)
    return V, solution.patch.F, np.zeros_like(V), scale_values(compute_values(solution, mode))


def compute_values(solution: LastSolve, mode: str) -> np.ndarray:
    """Computes what a map shows: the residual of each triangle, radians / length; its verdict, -1 to 1; or the distance
    that each vertex moved, positive to the side of the normals.
    """
    if mode == 'VERDICT':
        return np.zeros(0) if solution.verdict is None else solution.verdict
    if mode == 'RESIDUAL':
        return solution.residual
    move = solution.positions - solution.patch.V
    outwards = (move * compute_area_normals(solution.patch.V, solution.patch.F)).sum(axis=1)
    return np.copysign(np.linalg.norm(move, axis=1), outwards)


def scale_values(values: np.ndarray) -> np.ndarray:
    """Returns the values as fractions of the largest."""
    return values / (np.abs(values).max(initial=0.0) or 1.0)
