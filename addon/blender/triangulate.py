"""Triangles between points of a plane, cut by Blender."""
import numpy as np
from mathutils.geometry import delaunay_2d_cdt


def triangulate_points(points: np.ndarray, edges: np.ndarray) -> np.ndarray | None:
    """Returns the Delaunay triangles (#F x 3) of points (#P x 2) that keep the edges (#E x 2), counter-clockwise; None
    where edges cross or points lie on each other.
    """
    size = float(np.ptp(points, axis=0).max())
    found, _, faces, sources, _, _ = delaunay_2d_cdt(points.tolist(), edges.tolist(), [], 0, 1e-7 * size)
    if len(found) != len(points) or any(len(source) != 1 for source in sources):
        return None
    source = np.array(sources)[:, 0]
    F = source[np.array(faces, dtype=np.int64).reshape(-1, 3)]
    a, b, c = (points[F[:, k]] for k in range(3))
    u, v = b - a, c - a
    turned = u[:, 0] * v[:, 1] < u[:, 1] * v[:, 0]
    F[turned] = F[turned][:, ::-1]
    return F
