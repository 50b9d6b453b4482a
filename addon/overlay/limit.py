"""Limit surfaces of cages, with their limit normals: what a cage means, at once and however large it is."""
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..bridge.cage import Cage
from ..bridge.surface import Surface, Topology

NOWHERE = np.zeros((0, 3))


@dataclass(frozen=True)
class Limit:
    """A subdivided cage without its positions."""
    cage: Cage
    subdivision: object
    topology: Topology


class Limits:
    """By the name of the object; kept while the cage only moves."""

    def __init__(self) -> None:
        self.kept: dict[str, Limit] = {}

    def surface(self, name: str, cage: Cage, selected: np.ndarray) -> Surface | None:
        """In the cage's space; None for one that OpenSubdiv refuses."""
        still = replace(cage, V=NOWHERE)
        if name not in self.kept or not self.kept[name].cage.same(still):
            try:
                self.kept[name] = made(still, len(cage.V))
            except native.InvalidInput:
                self.kept.pop(name, None)
                return None
        limit = self.kept[name]
        return Surface(limit.subdivision.positions(cage.V), limit.topology, selected[limit.topology.faces],
                       limit.subdivision.normals(cage.V))

    def drop(self, name: str) -> None:
        self.kept.pop(name, None)

    def forget(self) -> None:
        self.kept.clear()


def made(cage: Cage, vertices: int) -> Limit:
    arguments = cage.arguments(True)
    names = ("face_offsets", "face_vertices", "creases", "crease_sharpness", "corners", "corner_sharpness",
             "level", "limit", "boundary")
    subdivision = native.reflines.Subdivision(**{name: arguments[name] for name in names}, vertices=vertices)
    quads, parent = subdivision.faces, subdivision.face_parent
    F = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3).astype(np.int32)
    seen = cage.region[parent]
    topology = Topology(quads.ravel(), np.full(len(quads), 4), seen, F[np.repeat(seen, 2)], np.repeat(parent[seen], 2))
    return Limit(cage, subdivision, topology)
