"""Limit surfaces of cages with their limit normals, by OpenSubdiv."""
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..model.cage import Cage
from ..model.same import are_same
from ..model.surface import Surface, Topology

NOWHERE = np.zeros((0, 3))


@dataclass(frozen=True)
class LimitTopology:
    """A subdivided cage without its positions."""
    cage: Cage
    subdivision: "native.Subdivision"
    topology: Topology


def update_surface(kept: dict[str, LimitTopology], name: str, cage: Cage, selected: np.ndarray) -> Surface | None:
    """Returns the limit surface in the cage's space, subdividing anew where the topology of the object with this name
    is not the kept one; None where OpenSubdiv refuses it.
    """
    still = replace(cage, V=NOWHERE)
    if name not in kept or not are_same(kept[name].cage, still):
        try:
            kept[name] = build_limit_topology(still, len(cage.V))
        except native.InvalidInput:
            kept.pop(name, None)
            return None
    limit = kept[name]
    return Surface(limit.subdivision.positions(cage.V), limit.topology, selected[limit.topology.faces],
                   limit.subdivision.normals(cage.V))


def build_limit_topology(cage: Cage, vertices: int) -> LimitTopology:
    """Subdivides a cage without positions."""
    subdivision = native.reflines.Subdivision(**cage.build_topology_arguments(), vertices=vertices)
    quads, parent = subdivision.faces, subdivision.face_parent
    F = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3).astype(np.int32)
    seen = cage.region[parent]
    topology = Topology(quads.ravel(), np.full(len(quads), 4), seen, F[np.repeat(seen, 2)], np.repeat(parent[seen], 2))
    return LimitTopology(cage, subdivision, topology)
