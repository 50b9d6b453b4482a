"""Decides whether faces are inside out, by the mesh around them."""
import numpy as np

from .triangulation import list_edges

# Flux relative to area times size below which an open surface is too flat to have an inside; a bonnet has 0.03.
FLAT = 0.01


def is_flipped(corners: np.ndarray, sizes: np.ndarray, region: np.ndarray) -> bool:
    """Returns whether most edges between region and rest are run through in one direction by the faces of both, which
    faces oriented alike do in opposite directions.

    `corners` are the vertices of all faces, `sizes` (#faces) their numbers, `region` (#faces, bool) those in question.
    """
    start, end = list_edges(corners, sizes).T.astype(np.int64)
    count, inside = int(corners.max(initial=0)) + 1, np.repeat(region, sizes)
    own, other = start[inside] * count + end[inside], start[~inside] * count + end[~inside]
    reverse = end[~inside] * count + start[~inside]
    return len(np.intersect1d(own, other)) > len(np.intersect1d(own, reverse))


def is_closed(corners: np.ndarray, sizes: np.ndarray) -> bool:
    """Returns whether every edge belongs to two faces."""
    low, high = np.sort(list_edges(corners, sizes).T, axis=0).astype(np.int64)
    _, uses = np.unique(low * (int(corners.max(initial=0)) + 1) + high, return_counts=True)
    return bool((uses == 2).all())


def compute_flux(areas: np.ndarray, normals: np.ndarray, centers: np.ndarray) -> float:
    """Returns the flux of the position vector from the surface's centroid through it, relative to its area times its
    size.

    By the divergence theorem that of a closed surface is three times its volume; an open one that is convex seen from
    the side of its normals has a positive one too.
    """
    total = areas.sum()
    if not total > 0.0:
        return 0.0
    away = centers - areas @ centers / total
    size = np.linalg.norm(np.ptp(centers, axis=0))
    return float(areas @ (normals * away).sum(axis=1) / (total * max(size, 1e-300)))


def is_inside_out(flux: float, *, closed: bool, flipped: bool) -> bool:
    """Returns whether a region is inside out. `flux` is that of the mesh with the region oriented as the rest is."""
    return (flux < (0.0 if closed else -FLAT)) != flipped
