"""What the last solve did, as arrays of a batch: its residual, the way it moved the panel, the panel before it."""
import numpy as np

Arrays = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]  # positions, triangles, normals, shares of full colour

STILL = 1e-4  # of the panel's diagonal: what is further from where the solve left it has been changed since


def left_at(solution: object) -> np.ndarray:
    """#V x 3, object space: where the solve left the panel's vertices."""
    panel = solution.panel
    return panel.local + np.linalg.solve(panel.matrix[:3, :3], (solution.positions - panel.V).T).T


def is_current(solution: object, V: np.ndarray, vertices: int) -> bool:
    """Whether the shown surface (V) is still as the solve left it; one of other vertices cannot say."""
    panel = solution.panel
    if len(V) != vertices:
        return True
    if panel.index[-1] >= len(V):
        return False
    size = np.ptp(panel.local, axis=0).max()
    return bool(np.abs(V[panel.index] - left_at(solution)).max() <= STILL * size)


def residual_map(solution: object, full: float) -> Arrays:
    """One value a triangle, so each has vertices of its own; none where the residual is not known."""
    F = solution.panel.F if len(solution.residual) == len(solution.panel.F) else solution.panel.F[:0]
    residual = solution.residual[:len(F)]
    V = left_at(solution)[F].reshape(-1, 3)
    return V, np.arange(len(V)).reshape(-1, 3), np.zeros_like(V), np.repeat(shares(residual, full), 3)


def deviation_map(solution: object, full: float) -> Arrays:
    V = left_at(solution)
    moved = np.linalg.norm(solution.positions - solution.panel.V, axis=1)
    return V, solution.panel.F, np.zeros_like(V), shares(moved, full)


def shares(values: np.ndarray, full: float) -> np.ndarray:
    return values / (full or values.max(initial=0.0) or 1.0)


def before(solution: object, V: np.ndarray, F: np.ndarray, vertices: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(where to draw, triangles, where the vertices were). Of a surface of other vertices: of the panel alone.

    Vertices move along the view, so seen from the view camera the old reflections lie on the present surface.
    """
    panel = solution.panel
    if len(V) != vertices:
        return left_at(solution), panel.F, panel.local
    old = V.copy()
    old[panel.index] = panel.local
    return V, F, old
