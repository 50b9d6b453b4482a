"""Finds edges of a region's border that lie on other open edges without being joined to them: those of the same mesh,
as of two halves, or of another object. What is smooth on each side can still break between them.
"""
from collections.abc import Iterator
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils.kdtree import KDTree

from ..model.patch import Patch
from . import read_mesh

NEAR = 0.1    # of an edge's length: as far as Check Panel looks for another sheet
SMOOTH = 0.8660  # cosine of 30 degrees, by which faces bend at most that are meant to go on smoothly
MARGIN = 1.05  # factor of the distance to merge, against its rounding
SHORTEST = 0.5  # of the shortest edge of the region: merging further would join the region's own vertices
ROUNDING = 1e-6  # of coordinates, against that of the search in single precision
MOST_LOOPS = 3_000_000  # corners of another object's faces beyond which it is not looked at


@dataclass(frozen=True)
class OpenEdges:
    """The edges of a mesh with one face."""
    ends: np.ndarray     # #E x 2 x 3
    centers: np.ndarray  # #E x 3: of the faces
    faces: np.ndarray    # #E

    def choose(self, chosen: np.ndarray) -> "OpenEdges":
        return OpenEdges(self.ends[chosen], self.centers[chosen], self.faces[chosen])

    def transform(self, matrix: np.ndarray) -> "OpenEdges":
        """Returns the edges in world space."""
        ends, centers = (points @ matrix[:3, :3].T + matrix[:3, 3] for points in (self.ends, self.centers))
        return OpenEdges(ends, centers, self.faces)

    def find_ways(self) -> np.ndarray:
        """Returns the unit directions from the edges into their faces: #E x 3."""
        along = self.ends[:, 1] - self.ends[:, 0]
        inwards = self.centers - self.ends[:, 0]
        fraction = (inwards * along).sum(axis=1) / np.maximum((along * along).sum(axis=1), 1e-300)
        across = inwards - fraction[:, None] * along
        return across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)


@dataclass(frozen=True)
class UnjoinedBorder:
    """The edges of a region's border that lie on others."""
    own: int = 0           # edges that lie on such of the same mesh
    distance: float = 0.0  # that merges them, object space; 0 where that would merge more
    others: tuple[tuple[str, int], ...] = ()  # names of other objects, and how many edges lie on theirs

    def describe(self) -> tuple[str, ...]:
        """Says where lines can break, and what joins the faces."""
        own = [f"{count_edges(self.own)} faces that are not joined to it, where lines can break: merge by distance"
               ] if self.own else []
        return (*own, *(f"{count_edges(count)} {name}, where lines can break: press Smooth Lines with the border "
                        "Neighbours, or join the objects and merge by distance" for name, count in self.others))


def count_edges(count: int) -> str:
    return f"{count} edge{'s of the border lie' if count > 1 else ' of the border lies'} on"


def find_unjoined(scene: bpy.types.Scene, ob: bpy.types.Object, patch: Patch, *, within: bool) -> UnjoinedBorder:
    """Finds the edges of a region's border that lie on open edges of its mesh or of other visible objects; `within`
    also those that lie on the region's own.
    """
    if len(patch.faces) != len(ob.data.polygons):
        return UnjoinedBorder()
    every = read_open_edges(ob.data, read_mesh.read_coordinates(ob, patch.key))
    border = every.choose(patch.faces[every.faces])
    if not len(border.faces):
        return UnjoinedBorder()
    own = patch.faces[every.faces]
    pairs, distance = match_edges(border, every, np.flatnonzero(own)) if within else match_edges(border,
                                                                                                 every.choose(~own))
    world = border.transform(patch.matrix)
    others = [(other.name, len(match_edges(world, edges)[0])) for other, edges in read_others(scene, ob, world)]
    return UnjoinedBorder(len(pairs), choose_distance(patch, distance), tuple(each for each in others if each[1]))


def read_open_edges(mesh: bpy.types.Mesh, V: np.ndarray) -> OpenEdges:
    """Reads the open edges of a mesh with its vertices at V (#V x 3)."""
    edge_of_corner = read_mesh.read_integers(mesh.loops, "edge_index")
    sizes = read_mesh.read_corners(mesh)[1]
    once = np.bincount(edge_of_corner, minlength=len(mesh.edges))[edge_of_corner] == 1
    edges, faces = edge_of_corner[once], np.repeat(np.arange(len(sizes)), sizes)[once]
    vertices = read_mesh.read_integers(mesh.edges, "vertices", 2)[edges]
    centers = read_mesh.read_values(mesh.polygons, "center", np.float32, 3)
    return OpenEdges(V[vertices], centers[faces].astype(np.float64), faces)


def read_others(scene: bpy.types.Scene, ob: bpy.types.Object,
                border: OpenEdges) -> Iterator[tuple[bpy.types.Object, OpenEdges]]:
    """Reads the open edges of the other meshes whose boxes come near the border, world space."""
    lengths = np.linalg.norm(border.ends[:, 1] - border.ends[:, 0], axis=1)
    near = NEAR * lengths.max()
    low, high = border.ends.min(axis=(0, 1)) - near, border.ends.max(axis=(0, 1)) + near
    for other in scene.objects:
        if other.type != 'MESH' or other == ob or not other.visible_get() or len(other.data.loops) > MOST_LOOPS:
            continue
        matrix = np.array(other.matrix_world, dtype=np.float64)
        box = np.array(other.bound_box) @ matrix[:3, :3].T + matrix[:3, 3]
        if (box.min(axis=0) > high).any() or (box.max(axis=0) < low).any() or not len(other.data.polygons):
            continue
        edges = read_open_edges(other.data, read_mesh.read_coordinates(other)).transform(matrix)
        yield other, edges.choose(np.isfinite(edges.ends).all(axis=(1, 2)) & np.isfinite(edges.centers).all(axis=1))


def match_edges(border: OpenEdges, others: OpenEdges,
                same: np.ndarray | None = None) -> tuple[set[tuple[int, int]], float]:
    """Matches edges that lie on each other, with their faces on both sides; `same` (#border) says which of the others
    each edge of the border is. Returns the pairs, each once, and the largest distance of their ends.
    """
    near = NEAR * np.linalg.norm(border.ends[:, 1] - border.ends[:, 0], axis=1)
    first, second = find_close(border.ends.mean(axis=1), others.ends.mean(axis=1), near)
    one, other = border.choose(first), others.choose(second)
    apart = np.minimum(measure_ends(one.ends, other.ends), measure_ends(one.ends, other.ends[:, ::-1]))
    found = (apart <= near[first]) & ((one.find_ways() * other.find_ways()).sum(axis=1) <= -SMOOTH)
    if same is not None:
        own = same[first]
        found &= second != own
        first, second = np.minimum(own, second), np.maximum(own, second)
    pairs = set(zip(first[found].tolist(), second[found].tolist(), strict=True))
    return pairs, float(apart[found].max(initial=0.0))


def find_close(points: np.ndarray, others: np.ndarray, near: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Finds the pairs of a point and another one (#points x 3, #others x 3) that are no further apart than `near`
    (#points).
    """
    margin = near.max() + ROUNDING * np.abs(points).max()
    numbers = np.flatnonzero(((others >= points.min(axis=0) - margin) & (others <= points.max(axis=0) + margin))
                             .all(axis=1))
    tree = KDTree(len(numbers))
    for number, point in zip(numbers.tolist(), others[numbers].tolist(), strict=True):
        tree.insert(point, number)
    tree.balance()
    found = [(k, number) for k, (point, distance) in enumerate(zip(points.tolist(), near.tolist(), strict=True))
             for _, number, _ in tree.find_range(point, distance)] if len(numbers) else []
    return tuple(np.array(found, dtype=np.int64).reshape(-1, 2).T)


def measure_ends(some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Measures the larger distances of the ends of pairs of edges (#pairs x 2 x 3 each)."""
    return np.linalg.norm(some - others, axis=2).max(axis=1)


def choose_distance(patch: Patch, distance: float) -> float:
    """Returns the distance that merges vertices which are up to `distance` apart, 0 where it would merge more."""
    a, b, c = (patch.local.take(patch.F[:, k], axis=0) for k in range(3))
    shortest = float(np.sqrt(min(compute_squares(*ends).min() for ends in ((a, b), (b, c), (c, a)))))
    merged = max(MARGIN * distance, 1e-3 * shortest)
    return merged if merged < SHORTEST * shortest else 0.0


def compute_squares(some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Computes the squared distances of pairs of points (#pairs x 3 each)."""
    x, y, z = (some - others).T
    return x * x + y * y + z * z
